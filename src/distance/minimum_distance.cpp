#include "deformable_manipulation/distance/minimum_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "coordinate_limit.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kRounding = 1e-12;  // m

void requireLength(const char* name, double value) {
  if (!std::isfinite(value) || value < 0.0) {
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                "; it must be a finite number of metres, 0 or more");
  }
}

void requireGeometry(const ObjectView& object) {
  if (object.copies < 1 || object.point_count < 2) {
    throw std::invalid_argument("an object must have at least one copy and two points");
  }
  if (object.triangles != nullptr && object.triangle_count < 1) {
    throw std::invalid_argument("a surface must have at least one triangle");
  }
  const long numbers = 3L * object.copies * object.point_count;
  const double* end = object.points + numbers;
  const double* found =
      std::find_if(object.points, end, [](double value) { return !(std::abs(value) <= kLargestCoordinate); });
  if (found != end) {
    const long point = (found - object.points) / 3;
    throw std::invalid_argument("point " + std::to_string(point % object.point_count) + " of copy " +
                                std::to_string(point / object.point_count) + " is not finite, or beyond 1e6 m");
  }
  for (int t = 0; t < object.triangle_count; ++t) {
    for (int vertex : object.triangles[t]) {
      if (vertex < 0 || vertex >= object.point_count) {
        throw std::invalid_argument("triangle " + std::to_string(t) + " refers to point " + std::to_string(vertex) +
                                    "; there are points 0 to " + std::to_string(object.point_count - 1));
      }
    }
  }
}

std::int64_t identityOf(const Feature& feature, const ObjectView& object) {
  std::int64_t identity = feature.obstacle;
  for (int k = 0; k < (object.triangles == nullptr ? 1 : 3); ++k) {
    identity = identity * object.point_count + feature.vertices[k];
  }
  return identity;
}

bool nearer(const Feature& a, const Feature& b) { return a.distance < b.distance; }

//! The nearest first; of equally near ones the order is always the same.
bool before(const Feature& a, const Feature& b) {
  return std::tie(a.distance, a.obstacle, a.vertices) < std::tie(b.distance, b.obstacle, b.vertices);
}

}  // namespace

MinimumDistance::MinimumDistance(std::vector<std::shared_ptr<Obstacle>> obstacles, double margin, double band)
    : obstacles_(std::move(obstacles)), margin_(margin), band_(band) {
  requireLength("margin", margin);
  requireLength("band", band);
}

void MinimumDistance::replace(std::size_t index, std::shared_ptr<Obstacle> obstacle) {
  if (index >= obstacles_.size() || obstacle == nullptr) {
    throw std::invalid_argument("obstacle " + std::to_string(index) + " cannot be replaced: there are " +
                                std::to_string(obstacles_.size()) + ", and another one is needed in its place");
  }
  obstacles_[index] = std::move(obstacle);
}

const Distances& MinimumDistance::compute(const ObjectView& object) {
  requireGeometry(object);
  nearest_.assign(object.copies, Feature());
  of_one_.resize(object.copies);
  for (Feature& feature : nearest_) {
    feature.distance = std::numeric_limits<double>::infinity();
  }
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    obstacles_[i]->minima(object, of_one_.data());
    for (int copy = 0; copy < object.copies; ++copy) {
      of_one_[copy].obstacle = static_cast<int>(i);
      if (nearer(of_one_[copy], nearest_[copy])) {
        nearest_[copy] = of_one_[copy];
      }
    }
  }

  result_.features.clear();
  result_.offsets.assign(1, 0);
  result_.minimum.clear();
  for (int copy = 0; copy < object.copies; ++copy) {
    if (copy == 0) {
      addFeatures(object);
    } else if (nearest_[copy].distance < INFINITY) {
      result_.features.push_back(nearest_[copy]);
    }
    result_.minimum.push_back(nearest_[copy].distance - margin_);
    result_.offsets.push_back(static_cast<int>(result_.features.size()));
  }
  for (Feature& feature : result_.features) {
    feature.distance -= margin_;
    feature.identity = identityOf(feature, object);
  }
  return result_;
}

void MinimumDistance::addFeatures(const ObjectView& object) {
  std::vector<Feature>& features = result_.features;
  if (!(nearest_[0].distance < INFINITY)) {
    return;  // there is nothing to keep off
  }
  const double limit = nearest_[0].distance + band_ + kRounding;
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const std::size_t first = features.size();
    obstacles_[i]->features(object, limit, &features);
    for (std::size_t k = first; k < features.size(); ++k) {
      features[k].obstacle = static_cast<int>(i);
    }
  }
  if (features.empty()) {  // rounding, far from the origin
    features.push_back(nearest_[0]);
  }
  std::sort(features.begin(), features.end(), before);  // a stable sort would allocate
  nearest_[0].distance = features[0].distance;
}

}  // namespace distance
}  // namespace deformable_manipulation
