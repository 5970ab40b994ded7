#include "deformable_manipulation/control/object_forecast.h"

#include <utility>

#include "deformable_manipulation/control/response_gradients.h"

namespace deformable_manipulation {
namespace control {
namespace {

// What is farther away at a node is nearest at another one, or does not act.
constexpr int kFeatures = 1;

}  // namespace

ObjectForecast::ObjectForecast(std::shared_ptr<pbd::RestShapes> shapes,
                               std::shared_ptr<distance::MinimumDistance> distance,
                               std::vector<std::array<int, 3>> triangles)
    : shapes_(std::move(shapes)),
      distance_(std::move(distance)),
      triangles_(std::move(triangles)),
      distances_(nullptr) {}

void ObjectForecast::look(const ObservationView& observation, const std::vector<Vector3>& held) {
  pbd::RestShapes& shapes = shapes_ != nullptr ? *shapes_ : linear_;
  agents_ = observation.agents;
  const int nodes = static_cast<int>(held.size()) / agents_;
  place_.assign(static_cast<std::size_t>(nodes), -1);
  points_of_shape_ = shapes.pointCount();
  if (observation.points != points_of_shape_) {  // it is another object
    return;
  }
  const std::size_t numbers = 3 * static_cast<std::size_t>(points_of_shape_);
  shapes.setPresent(observation.coordinates);
  shapes.find(held);
  points_.resize(numbers * nodes);
  responses_.resize(3 * numbers * agents_ * nodes);
  int known = 0;
  for (int node = 0; node < nodes; ++node) {
    if (shapes.known(node)) {
      shapes.points(node, &points_[numbers * known]);
      shapes.response(node, &responses_[3 * numbers * agents_ * known]);
      place_[node] = known++;
    }
  }
  if (known > 0) {
    distance::ObjectView object;
    object.points = points_.data();
    object.copies = known;
    object.point_count = points_of_shape_;
    object.triangles = triangles_.empty() ? nullptr : triangles_.data();
    object.triangle_count = static_cast<int>(triangles_.size());
    distances_ = &distance_->compute(object);
  }
}

void ObjectForecast::takeFeatures(int node, int leader, Features& features) const {
  const int place = place_[node];
  if (place < 0) {
    features.clear();
    return;
  }
  const std::size_t numbers = 9 * static_cast<std::size_t>(points_of_shape_) * agents_;
  takeResponseGradients({*distances_, place, kFeatures}, {&responses_[numbers * place], agents_, points_of_shape_},
                        leader, features);
}

}  // namespace control
}  // namespace deformable_manipulation
