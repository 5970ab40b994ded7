#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformable_manipulation/control/features.h"

namespace deformable_manipulation {
namespace control {

//! Displacement rates of the object by differences over its copies, kept over the cycles (paper, section V-B).
//!
//! For each agent with copies, the rates dX / dp_j of all points X and of the minimum distance with respect to
//! the three components of its held point p are (X_c - X_0) / d for a copy c displaced by d along one axis.
//! Displacements in any other directions are solved for together: opposite ones give central differences,
//! oblique ones the least-squares solution. Only ready copies count; in directions that
//! no ready copy spans, the last rates stay.
//!
//! The leader needs no copies: its gradients are the normals minus the others (see Features). This saves copies, and
//! it makes the predicted rate exact for a formation that moves as one. Differences over 0.1 m for each agent
//! separately would have a bias that does not cancel. An assistant without usable copies counts as moving with the
//! leader, whose gradients then include its part.
//!
//! What the rates leave over of the copies' displacements, X_c - X_0 - D_c dX / dp, is their parting. It is small, of
//! second order, while the object follows its grips smoothly, and large where a fold snaps: one copy has the new
//! shape already, or all of them still have the one that the object is about to leave.
class Differences {
 public:
  Differences(int agents, int leader);

  //! Forgets all rates.
  void reset();

  //! Whether all copies of an agent have been ready at once since the start or reset.
  bool known(int agent) const { return agents_[agent].known; }

  //! Takes in the copies of an observation.
  void update(const ObservationView& observation);

  //! How the object's points follow the held points, as far as the copies show.
  //! @param to [A x P x 3 x 3] d point / d held point; the sum over all agents is the identity
  void takeResponse(std::vector<double>& to) const;

  //! Whether the copies tell what they exert on the agents.
  bool tellWrenches() const { return agents_.front().rates.cols() > 3L * points_ + 1; }

  //! The same of the wrenches at the grips, if they tell them.
  //! @param to [A x 6 x A x 6] d wrench / d held point, turn; zero for turns
  void takeWrenchResponse(std::vector<double>& to) const;

  //! All features of copy 0, each with the rates of its own material point. The distance of a locally nearest pair
  //! changes with the points' motion along the normal: g[m, a, j] = normal . dX_m / dp_aj.
  //! @param observation the one that was taken in last
  void takeGradients(const ObservationView& observation, Features& features) const;

  //! The nearest feature of copy 0 with the rates of the minimum distance (paper, eq. 6).
  void takeMinimum(const distance::Distances& distances, Features& features) const;

 private:
  using Rates = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Directions = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  struct Agent {
    bool known = false;
    Rates rates;              // [3, K] of the coordinates of the points, the wrenches if told, and the minimum
    Directions directions;    // [ready copies, 3] m, that the inverse is of
    Eigen::MatrixXd inverse;  // [3, ready copies]
  };

  void updateAgent(int index, const ObservationView& observation);
  void fill(Agent& agent, const ObservationView& observation);
  bool isUsable(const ObservationView& observation, int copy) const;
  void takePartings(const ObservationView& observation, Features& features) const;

  int leader_;
  int points_ = 0;  // P
  std::vector<Agent> agents_;
  std::vector<int> usable_;  // copies of the agent at hand
  Directions directions_;    // [usable, 3] m
  Rows change_;              // [usable, K]
};

}  // namespace control
}  // namespace deformable_manipulation
