#pragma once

#include <utility>
#include <vector>

#include "deformable_manipulation/control/detour_search.h"

namespace deformable_manipulation {
namespace control {

//! Where an assistant stands with a detour.
enum class DetourState {
  NONE,       //!< it goes straight to its place
  SEARCHING,  //!< it is held off, and another way is being looked for
  FOLLOWING,  //!< it is on such a way
  NO_WAY      //!< none was found
};

//! How an assistant gets on.
struct Traveller {
  int agent;
  Vector3 place;            //!< [m] relative to the leader
  Vector3 command;          //!< [m/s] the last one
  bool follows;             //!< false: it is to stand still
  Vector3 leader;           //!< [m] held point
  Vector3 leader_velocity;  //!< [m/s]
};

//! Brings an assistant that is held off its place, behind a leader at rest, to it by another way than the straight one.
//!
//! It only chooses where the nominal law goes to: the filter keeps the limits whatever the search says.
class Detour {
 public:
  explicit Detour(DetourSearch search) : search_(std::move(search)) {}

  //! Takes in a state of the run, and goes on with a search by one place.
  //! @param limits see DetourSearch
  void update(const ObservationView& observation, const Traveller& traveller, const DetourSearch::Limits& limits);

  //! [m] Where the assistant is to go, relative to the leader.
  const Vector3& aim() const { return aim_; }

  DetourState state() const { return state_; }

  //! Goes straight again.
  void reset();

 private:
  bool isHeldOff(const ObservationView& observation, const Traveller& traveller);
  void search(double time);
  void follow(const Vector3& position, double time);

  DetourSearch search_;
  DetourState state_ = DetourState::NONE;
  Vector3 aim_ = Vector3::Zero();
  Vector3 leader_ = Vector3::Zero();  // [m] where it rests
  bool rests_ = false;                // it does
  bool waits_ = false;                // the assistant is off its place and does not get on
  double since_ = 0.0;                // [s] when that began, the last place on the way was reached, or no way was found
  int attempts_ = 0;                  // since the leader rests
  std::vector<Vector3> way_;          // [m] left to go
  Vector3 carrot_ = Vector3::Zero();  // [m] on the way, ahead of the assistant
};

}  // namespace control
}  // namespace deformable_manipulation
