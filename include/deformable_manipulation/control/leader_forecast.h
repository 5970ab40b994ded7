#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "deformable_manipulation/control/controller_parameters.h"
#include "deformable_manipulation/control/observation.h"
#include "deformable_manipulation/control/predicted_state.h"

namespace deformable_manipulation {
namespace control {

//! Where the leader is expected at the nodes of the horizon (docs/mathematics.md, "Horizon").
//!
//! Its present velocity fades. Where it announces its way, the expected displacement from now to node n is
//!
//!   f_n + w_n (a_n - f_n),
//!
//! with f_n by the fading velocity, a_n as announced, and the trust w_n between 0 and 1 that would have told the
//! leader's motion best lately: the least squares of what became true at the node's time ahead. An announcement has to
//! earn its trust, so that a wrong one counts as none.
class LeaderForecast {
 public:
  explicit LeaderForecast(const HorizonParameters& parameters) { setParameters(parameters); }

  //! Other parameters; what is known of the announcements stays while the nodes do.
  void setParameters(const HorizonParameters& parameters);

  //! Forgets the leader's motion, and how well announcements have told it.
  void reset();

  //! Looks ahead from an observed state, to times that count from when the command begins to act.
  void look(const ObservationView& observation, const PredictedState& predicted);

  //! [N + 1] m, the held point now and at each node; valid after look().
  const std::vector<Vector3>& positions() const { return positions_; }

  //! [m/s] By how much faster the leader may come near something than expected, in the mean until a node.
  double doubt(int node) const;

  //! [m/s] The highest speed from now to the last node; of what is not announced, also the highest one lately.
  double fastest() const;

  //! Part of what is announced for a node that is expected, 0 to 1.
  double trust(int node) const { return trust_[node]; }

 private:
  //! What was expected at some time.
  struct Record {
    double time;                     // [s] from which the nodes count
    Vector3 position;                // [m] then
    std::vector<Vector3> fading;     // [N] m, displacement by the fading velocity
    std::vector<Vector3> announced;  // [N] m, displacement as announced
  };

  //! How what was announced for a node has become true.
  struct Evidence {
    double agreement = 0.0;  // [m^2 s] of what was announced beyond the fading velocity with what the leader did
    double claim = 0.0;      // [m^2 s] what was announced beyond the fading velocity
    long next = 0;           // record that comes next, counted from the first one ever
  };

  double timeOf(int node) const { return (node + 1) * interval_; }
  void remember(double time, double speed);
  void fade(const Vector3& velocity);
  bool read(const AnnouncementView& announcement, double start);
  void judge(double time, const Vector3& position, const Vector3& velocity);
  void learn(const Record& record, int node, const Vector3& moved);
  void dropJudged();
  void findTrust(bool announced);
  void keep(double start, const Vector3& position);

  HorizonParameters parameters_{};
  double interval_ = 0.0;           // [s]
  double speed_ = 0.0;              // [m/s] now
  double recent_ = 0.0;             // [m/s] the highest speed lately, which fades
  std::optional<double> seen_;      // [s] time of the last look
  std::vector<Vector3> fading_;     // [N] m, displacements
  std::vector<Vector3> announced_;  // [N] m, displacements; those of fading_ where nothing is announced
  std::vector<double> ways_;        // [N] m, as announced
  std::vector<Vector3> positions_;
  std::vector<Evidence> evidence_;  // [N]
  std::vector<double> trust_;       // [N]
  std::deque<Record> records_;
  long dropped_ = 0;  // records before the first of them
};

}  // namespace control
}  // namespace deformable_manipulation
