#pragma once

#include <cstdint>
#include <vector>

#include "deformable_manipulation/control/features.h"

namespace deformable_manipulation {
namespace control {

//! Features at a node of the horizon, with those that were the nearest there a moment ago.
//!
//! Only the nearest feature of a shape is computed. Where two points of the object take turns in being the nearest, a
//! plan that knows one of them moves the other one nearer, from cycle to cycle. So each is kept for a short time as it
//! was found, moved to first order with the held points, like the planes of a bundle method. Meanwhile it counts as
//! farther and farther away.
class FeatureMemory {
 public:
  //! Forgets everything.
  void reset() { kept_.clear(); }

  //! Adds what is remembered to the features of a node, and remembers these.
  //! @param time [s] of the cycle
  //! @param held [A] m, where the agents hold the object at the node
  //! @param features those found now
  void recall(double time, const Vector3* held, Features& features);

 private:
  struct Kept {
    double time;  // [s]
    std::int64_t identity;
    double distance;                 // [m]
    Vector3 normal;                  // of length 1
    std::vector<Vector3> gradients;  // [A]
    std::vector<Vector3> held;       // [A] m
  };

  static bool isFoundAgain(const Kept& kept, const Features& features);

  std::vector<Kept> kept_;
};

}  // namespace control
}  // namespace deformable_manipulation
