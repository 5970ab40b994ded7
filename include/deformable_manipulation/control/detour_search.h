#pragma once

#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "deformable_manipulation/control/barrier.h"
#include "deformable_manipulation/control/observation.h"
#include "deformable_manipulation/distance/minimum_distance.h"
#include "deformable_manipulation/pbd/rest_shapes.h"

namespace deformable_manipulation {
namespace control {

//! Looks for a way of one held point to a goal, while all others stay where they are.
//!
//! A rapidly-exploring random tree (LaValle, Kuffner: Randomized Kinodynamic Planning, 2001) of places of the held
//! point, always with the same random numbers. The model of the object is its equilibrium: from place to place it rests
//! in the shape that continues the one before, so that a place reached on two sides of an obstacle is not taken for the
//! same. A step is possible if the object keeps its limits at its end, and no point of it moves farther than its
//! distances before and after allow, so that it cannot have passed through anything. A way that is found is shortened
//! before it is offered.
class DetourSearch {
 public:
  //! The lowest h [m] of all limits in a state.
  using Limits = std::function<double(const PresentState&)>;

  enum class Outcome { SEARCHING, FOUND, NO_WAY };

  //! @param shapes of its own
  //! @param distance whose obstacles are where they are at present
  DetourSearch(std::shared_ptr<pbd::RestShapes> shapes, std::shared_ptr<distance::MinimumDistance> distance);

  //! Whether an observed object has as many points as the shapes. Others cannot be searched for.
  bool fits(const ObservationView& observation) const { return observation.points == shapes_->pointCount(); }

  //! Starts a search in an observed state, in which the object should be at rest.
  //! @param observation that fits
  //! @param agent whose held point moves
  //! @param goal [m] of it
  void start(const ObservationView& observation, int agent, const Vector3& goal, Limits limits);

  //! Goes on with the search by a few steps in one direction; costs about half a millisecond.
  Outcome advance();

  //! [m] Where the held point is to go, one place after the other, if FOUND.
  std::vector<Vector3> way() const;

  //! [m] Distance of neighbouring places at most.
  double step() const { return step_; }

 private:
  struct Place {
    Vector3 position;
    int from;                    // place before it; -1: the start
    double distance;             // [m] of the object
    std::vector<double> points;  // [P x 3] m
  };

  Outcome explore();
  Outcome shorten();
  int nearestTo(const Vector3& position) const;
  Vector3 draw();
  int go(int from, const Vector3& to);
  void findShapes(const Place& from, const std::vector<Vector3>& positions);
  bool isPossible(const Place& before, const Place& after) const;
  std::vector<int> placesTo(int last) const;

  std::shared_ptr<pbd::RestShapes> shapes_;
  std::shared_ptr<distance::MinimumDistance> distance_;
  Limits limits_;
  std::vector<Vector3> held_;  // [A] m
  int agent_ = 0;
  Vector3 goal_ = Vector3::Zero();
  double step_ = 0.0;   // [m]
  double range_ = 0.0;  // [m] that places are drawn beyond the start and the goal
  std::mt19937 random_;
  int looks_ = 0;  // so far
  std::vector<Place> places_;
  std::vector<int> way_;      // places from the start to the goal, once it is reached
  std::vector<Place> found_;  // shapes that were found last, up to the first that is not known
};

}  // namespace control
}  // namespace deformable_manipulation
