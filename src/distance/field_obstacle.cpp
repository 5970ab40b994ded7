#include "deformable_manipulation/distance/field_obstacle.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "coordinate_limit.h"
#include "field_search.h"
#include "local_copies.h"
#include "moving_bounds.h"
#include "obstacle_frame.h"
#include "pose_checks.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kFinest = 1e-6;  // m

std::vector<std::string> problemsOf(const std::vector<float>& values, const std::array<int, 3>& size,
                                    const Vector3& origin, const Vector3& spacing) {
  std::vector<std::string> problems;
  const bool is_grid = *std::min_element(size.begin(), size.end()) >= 2;
  if (!is_grid) {
    problems.push_back("the grid must have two values at least along each axis");
  } else if (values.size() != static_cast<std::size_t>(size[0]) * size[1] * size[2]) {
    problems.push_back("there are " + std::to_string(values.size()) + " values, not as many as the size says");
  }
  const auto wrong = std::find_if(values.begin(), values.end(),
                                  [](float value) { return !(std::fabs(value) <= float(kLargestCoordinate)); });
  if (wrong != values.end()) {
    problems.push_back("value " + std::to_string(wrong - values.begin()) + " is not finite, or beyond 1e6 m");
  }
  if (!(origin.cwiseAbs().maxCoeff() <= kLargestCoordinate)) {
    problems.push_back("the origin must be finite and at most 1e6 m away");
  }
  if (!(spacing.minCoeff() >= kFinest && spacing.maxCoeff() <= kLargestCoordinate)) {
    problems.push_back("the spacing must be 1e-6 to 1e6 m");
  }
  return problems;
}

}  // namespace

//! A field with the object in its frame.
class FieldObstacle::Search {
 public:
  Search(std::shared_ptr<const DistanceField> field, const Vector3& origin, bool is_free_outside)
      : field_(std::move(field)),
        origin_(origin),
        is_free_outside_(is_free_outside),
        search_(*field_, is_free_outside) {}

  //! In the same field, at the same place.
  Search(const Search& other) : Search(other.field_, other.origin_, other.is_free_outside_) { frame = other.frame; }

  ObstacleFrame frame;

  void minima(const ObjectView& object, Feature* nearest) {
    prepare(object);
    for (int copy = 0; copy < object.copies; ++copy) {
      bring(object, copy);
      const double upper = lowestCorner(copy);
      FieldPlace least;
      int& least_element = nearest_[copy];
      for (int element = 0; element < object.elements(); ++element) {
        const FieldPlace found = placeOf(copy, element, std::min(upper + FieldSearch::kTolerance, least.distance));
        if (found.distance < least.distance) {
          least = found;
          least_element = element;
        }
      }
      nearest[copy] = featureAt(object, copy, least_element, least);
    }
  }

  void features(const ObjectView& object, double limit, std::vector<Feature>* found) {
    prepare(object);
    bring(object, 0);
    for (int element = 0; element < object.elements(); ++element) {
      const FieldPlace place = placeOf(0, element, limit);
      if (place.distance <= limit) {
        found->push_back(featureAt(object, 0, element, place));
      }
    }
  }

 private:
  Vector3 toLocal(const Vector3& point) const { return frame.toLocal(point) - origin_; }

  void prepare(const ObjectView& object) {
    if (copies_.prepare(object)) {
      bounds_.clear();
      nearest_.clear();
    }
    nearest_.resize(copies_.count(), 0);
    while (static_cast<int>(bounds_.size()) < copies_.count()) {
      bounds_.emplace_back();
      bounds_.back().reset(copies_.object().size());
    }
  }

  void bring(const ObjectView& object, int copy) {
    const double step = copies_.bring(object, copy, [this](const Vector3& point) { return toLocal(point); });
    bounds_[copy].move(search_.steepness() * step);
  }

  //! The least distance [m] of all corners. Elements that are known to be farther away are not looked at.
  double lowestCorner(int copy) {
    double lowest = lowestCornerOf(nearest_[copy], INFINITY);
    for (int element = 0; element < copies_.object().size(); ++element) {
      if (bounds_[copy].of(element) <= lowest) {
        lowest = lowestCornerOf(element, lowest);
      }
    }
    return lowest;
  }

  double lowestCornerOf(int element, double lowest) {
    for (const Vector3& corner : copies_.object().corners<3>(element)) {
      lowest = std::min(lowest, search_.distanceAt(corner));
    }
    return lowest;
  }

  //! The nearest point of an element; its distance is infinite, or above the limit [m], where it need not be known.
  FieldPlace placeOf(int copy, int element, double limit) {
    MovingBounds& bounds = bounds_[copy];
    if (bounds.of(element) > limit) {
      return {};
    }
    // What is a little farther need not be searched for some time, if that is known now.
    const double reach = limit + bounds.reserve();
    const Corners<3> corners = copies_.object().corners<3>(element);
    const double bound = search_.lowerBound(corners);
    FieldPlace place;
    if (bound <= reach) {
      place = search_.minimum(corners, copies_.object().cornerCount(), reach);
    }
    bounds.set(element, std::max(bound, std::min(place.distance, reach) - FieldSearch::kTolerance));
    return place;
  }

  Feature featureAt(const ObjectView& object, int copy, int element, const FieldPlace& place) const {
    Feature feature;
    feature.vertices = object.element(element);
    feature.weights = place.weights;
    for (int k = 0; k < 3; ++k) {
      feature.object_point += place.weights[k] * object.point(copy, feature.vertices[k]);
    }
    const FieldSample there = search_.sample(toLocal(feature.object_point));
    const double length = there.gradient.norm();
    feature.distance = there.distance;
    feature.normal = frame.toFixed(length > 0.0 ? Vector3(there.gradient / length) : Vector3(Vector3::UnitZ()));
    feature.obstacle_point = feature.object_point - there.distance * feature.normal;
    feature.obstacle_velocity = frame.velocityAt(feature.obstacle_point);
    return feature;
  }

  std::shared_ptr<const DistanceField> field_;
  Vector3 origin_;  // m
  bool is_free_outside_;
  FieldSearch search_;
  LocalCopies copies_;
  std::vector<MovingBounds> bounds_;  // [copies] of their elements
  std::vector<int> nearest_;          // [copies] element that was the nearest
};

FieldObstacle::FieldObstacle(std::vector<float> values, const std::array<int, 3>& size, const Vector3& origin,
                             const Vector3& spacing, bool is_free_outside) {
  throwIfAny(problemsOf(values, size, origin, spacing));
  search_ = std::make_unique<Search>(std::make_shared<const DistanceField>(std::move(values), size, spacing), origin,
                                     is_free_outside);
}

FieldObstacle::FieldObstacle(std::unique_ptr<Search> search) : search_(std::move(search)) {}

std::shared_ptr<FieldObstacle> FieldObstacle::another() const {
  return std::shared_ptr<FieldObstacle>(new FieldObstacle(std::make_unique<Search>(*search_)));
}

FieldObstacle::~FieldObstacle() = default;

void FieldObstacle::place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
  search_->frame.set(translation, rotation, velocity);
}

void FieldObstacle::minima(const ObjectView& object, Feature* nearest) { search_->minima(object, nearest); }

void FieldObstacle::features(const ObjectView& object, double limit, std::vector<Feature>* found) {
  search_->features(object, limit, found);
}

}  // namespace distance
}  // namespace deformable_manipulation
