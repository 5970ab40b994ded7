#pragma once

#include <array>
#include <memory>
#include <vector>

#include "deformable_manipulation/control/features.h"
#include "deformable_manipulation/control/linear_shapes.h"
#include "deformable_manipulation/control/measured_obstacle.h"
#include "deformable_manipulation/control/object_shape.h"
#include "deformable_manipulation/control/obstacle_forecast.h"
#include "deformable_manipulation/distance/minimum_distance.h"
#include "deformable_manipulation/pbd/rest_shapes.h"

namespace deformable_manipulation {
namespace control {

//! The object as it will rest when its agents have moved on: its shapes at several times ahead, and their distances.
//!
//! Obstacles stand, are where their paths lead until then, or go on with their measured velocities.
class ObjectForecast {
 public:
  //! @param shapes null: shapes are told to first order, see needsResponse()
  //! @param standing distance from the obstacles that stand
  //! @param moving obstacles on paths
  //! @param measured the others; they are left out while an observation does not tell their poses
  //! @param triangles of the object's points; empty: a polyline
  ObjectForecast(std::shared_ptr<pbd::RestShapes> shapes, std::shared_ptr<distance::MinimumDistance> standing,
                 std::vector<ObstacleForecast> moving, std::vector<MeasuredObstacle> measured,
                 std::vector<std::array<int, 3>> triangles);

  //! Part of the way of a measured obstacle by which it may come nearer than expected.
  void setObstacleDoubt(double doubt) { obstacle_doubt_ = doubt; }

  //! Forgets how obstacles have moved, and the shapes found.
  void reset();

  //! Whether it has to be told how the object follows its held points before it looks ahead.
  bool needsResponse() const { return shapes_ == nullptr; }

  //! See LinearShapes.
  void setResponse(std::vector<Vector3> held, const std::vector<double>& response) {
    linear_.setResponse(std::move(held), response);
  }

  //! Looks ahead from an observed state.
  //! @param held [nodes x agents] m, where the agents will hold the object
  //! @param times [nodes] s, at which the obstacles are where their paths lead
  void look(const ObservationView& observation, const std::vector<Vector3>& held, const std::vector<double>& times);

  //! The near features of the object at a node with their gradients; none where its shape is not known.
  void takeFeatures(int node, int leader, Features& features) const;

  //! The object's shape at a node, without its reactions; nothing where it is not known.
  ObjectShape shape(int node) const;

 private:
  void observe(const ObservationView& observation);
  void findNearest(int known);
  void take(const std::vector<distance::Feature>& features);

  std::shared_ptr<pbd::RestShapes> shapes_;
  LinearShapes linear_;
  std::shared_ptr<distance::MinimumDistance> standing_;
  std::vector<ObstacleForecast> moving_;
  std::vector<MeasuredObstacle> measured_;
  double obstacle_doubt_ = 0.0;
  double now_ = 0.0;   // [s]
  bool told_ = false;  // where the measured ones are
  std::vector<std::array<int, 3>> triangles_;
  int agents_ = 0;
  int points_of_shape_ = 0;        // P
  std::vector<int> place_;         // [nodes] among those known, or -1
  std::vector<double> points_;     // [known x P x 3] m
  std::vector<double> times_;      // [known] s
  std::vector<double> responses_;  // [known x A x P x 3 x 3]
  distance::Distances nearest_;    // of those known, over all obstacles
};

}  // namespace control
}  // namespace deformable_manipulation
