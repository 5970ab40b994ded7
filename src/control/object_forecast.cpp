#include "deformable_manipulation/control/object_forecast.h"

#include <utility>

#include "deformable_manipulation/control/response_gradients.h"

namespace deformable_manipulation {
namespace control {
ObjectForecast::ObjectForecast(std::shared_ptr<pbd::RestShapes> shapes,
                               std::shared_ptr<distance::MinimumDistance> standing,
                               std::vector<ObstacleForecast> moving, std::vector<MeasuredObstacle> measured,
                               std::vector<std::array<int, 3>> triangles)
    : shapes_(std::move(shapes)),
      standing_(std::move(standing)),
      moving_(std::move(moving)),
      measured_(std::move(measured)),
      triangles_(std::move(triangles)) {}

void ObjectForecast::look(const ObservationView& observation, const std::vector<Vector3>& held,
                          const std::vector<double>& times) {
  pbd::RestShapes& shapes = shapes_ != nullptr ? *shapes_ : linear_;
  agents_ = observation.agents;
  const int nodes = static_cast<int>(held.size()) / agents_;
  place_.assign(static_cast<std::size_t>(nodes), -1);
  points_of_shape_ = shapes.pointCount();
  if (observation.points != points_of_shape_) {  // it is another object
    return;
  }
  const std::size_t numbers = 3 * static_cast<std::size_t>(points_of_shape_);
  observe(observation);
  shapes.setPresent(observation.coordinates, observation.correction);
  if (observation.orientations != nullptr) {  // grips turn, and are expected to keep them now
    shapes.setOrientations(orientationsOf(observation));
  }
  shapes.find(held);
  points_.resize(numbers * nodes);
  responses_.resize(3 * numbers * agents_ * nodes);
  times_.resize(times.size());
  int known = 0;
  for (int node = 0; node < nodes; ++node) {
    if (shapes.known(node)) {
      shapes.points(node, &points_[numbers * known]);
      shapes.response(node, &responses_[3 * numbers * agents_ * known]);
      times_[known] = times[node];
      place_[node] = known++;
    }
  }
  if (known > 0) {
    findNearest(known);
  }
}

void ObjectForecast::reset() {
  if (shapes_ != nullptr) {
    shapes_->forget();
  }
  for (MeasuredObstacle& obstacle : measured_) {
    obstacle.reset();
  }
}

void ObjectForecast::observe(const ObservationView& observation) {
  now_ = observation.time;
  told_ = observation.obstacle_poses != nullptr;
  for (MeasuredObstacle& obstacle : measured_) {
    told_ = told_ && obstacle.index() < observation.obstacles;
    if (told_) {
      const double* numbers = observation.obstacle_poses + 7 * obstacle.index();
      const Eigen::Map<const pbd::Quaternion> orientation(numbers + 3);
      obstacle.observe(observation.time, {Eigen::Map<const Vector3>(numbers), orientation.normalized()});
    }
  }
}

//! One feature of each shape: what is farther away at a node is nearest at another one, or does not act.
void ObjectForecast::findNearest(int known) {
  distance::ObjectView object;
  object.points = points_.data();
  object.copies = known;
  object.point_count = points_of_shape_;
  object.triangles = triangles_.empty() ? nullptr : triangles_.data();
  object.triangle_count = static_cast<int>(triangles_.size());
  nearest_.features.clear();
  const distance::Distances& standing = standing_->compute(object);
  for (int shape = 0; shape < known && !standing.features.empty(); ++shape) {
    nearest_.features.push_back(standing.features[standing.offsets[shape]]);
  }
  times_.resize(known);
  for (ObstacleForecast& obstacle : moving_) {
    take(obstacle.compute(object, times_, now_));
  }
  for (MeasuredObstacle& obstacle : measured_) {
    if (told_) {
      take(obstacle.compute(object, times_, obstacle_doubt_));
    }
  }
  nearest_.offsets.assign(1, 0);
  for (int shape = 0; shape < known; ++shape) {
    nearest_.offsets.push_back(nearest_.features.empty() ? 0 : shape + 1);
  }
}

//! Keeps the nearer feature of each shape.
void ObjectForecast::take(const std::vector<distance::Feature>& features) {
  if (nearest_.features.empty()) {
    nearest_.features = features;
    return;
  }
  for (std::size_t shape = 0; shape < nearest_.features.size(); ++shape) {
    if (features[shape].distance < nearest_.features[shape].distance) {
      nearest_.features[shape] = features[shape];
    }
  }
}

void ObjectForecast::takeFeatures(int node, int leader, Features& features) const {
  const int place = place_[node];
  if (place < 0) {
    features.clear();
    return;
  }
  const std::size_t numbers = 9 * static_cast<std::size_t>(points_of_shape_) * agents_;
  takeResponseGradients({nearest_, place}, {&responses_[numbers * place], agents_, points_of_shape_}, leader, features);
}

ObjectShape ObjectForecast::shape(int node) const {
  ObjectShape shape;
  shape.agents = agents_;
  shape.points = points_of_shape_;
  if (place_[node] >= 0) {
    const std::size_t numbers = 3 * static_cast<std::size_t>(points_of_shape_);
    shape.coordinates = &points_[numbers * place_[node]];
    shape.response = &responses_[3 * numbers * agents_ * place_[node]];
  }
  return shape;
}

}  // namespace control
}  // namespace deformable_manipulation
