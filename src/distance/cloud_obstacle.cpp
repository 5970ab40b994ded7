#include "deformable_manipulation/distance/cloud_obstacle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <tuple>
#include <utility>

#include "coordinate_limit.h"
#include "local_copies.h"
#include "obstacle_frame.h"
#include "point_search.h"
#include "pose_checks.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kAtPoint = 1e-9;  // m, distance below which the direction to a point is rounding

}  // namespace

PointCloud::PointCloud(const float* xyz, std::size_t count) { build(xyz, count); }
PointCloud::PointCloud(const double* xyz, std::size_t count) { build(xyz, count); }

template <typename Number>
void PointCloud::build(const Number* xyz, std::size_t count) {
  constexpr auto kLargest = static_cast<Number>(kLargestCoordinate);
  const auto usable = [](const Number* p) {  // no number is not
    return std::fabs(p[0]) <= kLargest && std::fabs(p[1]) <= kLargest && std::fabs(p[2]) <= kLargest;
  };
  std::array<Number, 3> low = {kLargest, kLargest, kLargest}, high = {-kLargest, -kLargest, -kLargest};
  std::size_t used = 0;
  for (const Number* p = xyz; p != xyz + 3 * count; p += 3) {
    if (usable(p)) {
      ++used;
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
  }
  left_out_ = count - used;
  if (used == 0) {
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    middle_[axis] = 0.5 * (double(low[axis]) + high[axis]);
  }
  std::vector<FloatPoint> points;
  points.reserve(used);
  for (const Number* p = xyz; p != xyz + 3 * count; p += 3) {
    if (usable(p)) {
      points.push_back({static_cast<float>(p[0] - middle_[0]), static_cast<float>(p[1] - middle_[1]),
                        static_cast<float>(p[2] - middle_[2])});
    }
  }
  tree_ = std::make_shared<const PointTree>(points);
}

PointCloud::~PointCloud() = default;

std::size_t PointCloud::size() const { return tree_ == nullptr ? 0 : tree_->size(); }

std::size_t PointCloud::bytes() const { return tree_ == nullptr ? 0 : tree_->bytes(); }

//! A cloud with points, the object in its frame, and what was nearest last.
class CloudObstacle::Search {
 public:
  Search(const PointCloud& cloud, double radius)
      : radius_(radius), middle_(cloud.middle()), tree_(cloud.tree()), search_(tree_) {}

  ObstacleFrame frame;

  void minima(const ObjectView& object, Feature* nearest) {
    prepare(object);
    for (int copy = 0; copy < object.copies; ++copy) {
      bring(object, copy);
      known_[copy].nearest = search_.minimum(copies_.object(), guess(copy), &known_[copy].bounds);
      nearest[copy] = featureAt(object, copy, known_[copy].nearest);
    }
  }

  void features(const ObjectView& object, double limit, std::vector<Feature>* found) {
    if (!(limit + radius_ >= 0.0)) {
      return;
    }
    prepare(object);
    bring(object, 0);
    places_.clear();
    search_.elements(copies_.object(), limit + radius_, &known_[0].bounds, &places_);
    for (const PointPlace& place : places_) {
      found->push_back(featureAt(object, 0, place));
    }
  }

 private:
  //! What is known of a copy from the calls before.
  struct Known {
    PointPlace nearest;
    MovingBounds bounds;
  };

  //! What was nearest to this copy, or else is to the one before.
  PointPlace guess(int copy) const {
    return known_[copy].nearest.known() || copy == 0 ? known_[copy].nearest : known_[copy - 1].nearest;
  }

  void prepare(const ObjectView& object) {
    if (copies_.prepare(object)) {
      known_.clear();
    }
    for (int copy = static_cast<int>(known_.size()); copy < copies_.count(); ++copy) {
      known_.emplace_back();
      known_.back().bounds.reset(copies_.object().size());
    }
  }

  void bring(const ObjectView& object, int copy) {
    known_[copy].bounds.move(
        copies_.bring(object, copy, [this](const Vector3& point) { return Vector3(frame.toLocal(point) - middle_); }));
  }

  Feature featureAt(const ObjectView& object, int copy, const PointPlace& place) {
    Feature feature;
    feature.vertices = copies_.object().element(place.element);
    feature.weights = place.weights;
    for (int k = 0; k < 3; ++k) {
      feature.object_point += place.weights[k] * object.point(copy, feature.vertices[k]);
    }
    const Vector3 arm = frame.toFixed(frame.toLocal(feature.object_point) - middle_ - tree_->point(place.piece));
    const double length = arm.norm();
    feature.distance = length - radius_;
    feature.normal = length > kAtPoint ? Vector3(arm / length) : frame.toFixed(Vector3::UnitZ());
    feature.obstacle_point = feature.object_point - feature.distance * feature.normal;
    feature.obstacle_velocity = frame.velocityAt(feature.obstacle_point);
    return feature;
  }

  double radius_;   // m
  Vector3 middle_;  // m
  std::shared_ptr<const PointTree> tree_;
  PointSearch search_;
  LocalCopies copies_;
  std::vector<Known> known_;  // [copies]
  std::vector<PointPlace> places_;
};

CloudObstacle::CloudObstacle(const std::vector<std::shared_ptr<const PointCloud>>& clouds, double radius) {
  std::vector<std::string> problems;
  if (!(radius >= 0.0 && radius <= kLargestCoordinate)) {
    std::ostringstream text;
    text << "radius is " << radius << "; it must be 0 or more, at most 1e6 m";
    problems.push_back(text.str());
  }
  if (std::find(clouds.begin(), clouds.end(), nullptr) != clouds.end()) {
    problems.push_back("there is no cloud; without points, give one that is empty");
  }
  throwIfAny(problems);
  for (const std::shared_ptr<const PointCloud>& cloud : clouds) {
    if (cloud->size() > 0) {
      searches_.push_back(std::make_unique<Search>(*cloud, radius));
    }
  }
}

CloudObstacle::~CloudObstacle() = default;

void CloudObstacle::place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
  for (const std::unique_ptr<Search>& search : searches_) {
    search->frame.set(translation, rotation, velocity);
  }
}

void CloudObstacle::minima(const ObjectView& object, Feature* nearest) {
  Feature nothing;
  nothing.distance = INFINITY;
  std::fill_n(nearest, object.copies, nothing);
  of_one_.resize(object.copies);
  for (const std::unique_ptr<Search>& search : searches_) {
    search->minima(object, of_one_.data());
    for (int copy = 0; copy < object.copies; ++copy) {
      if (of_one_[copy].distance < nearest[copy].distance) {
        nearest[copy] = of_one_[copy];
      }
    }
  }
}

void CloudObstacle::features(const ObjectView& object, double limit, std::vector<Feature>* found) {
  const auto first = static_cast<std::ptrdiff_t>(found->size());
  for (const std::unique_ptr<Search>& search : searches_) {
    search->features(object, limit, found);
  }
  if (searches_.size() > 1) {  // of the same element, only the nearest
    const auto begin = found->begin() + first;
    std::sort(begin, found->end(), [](const Feature& a, const Feature& b) {
      return std::tie(a.vertices, a.distance) < std::tie(b.vertices, b.distance);
    });
    const auto same = [](const Feature& a, const Feature& b) { return a.vertices == b.vertices; };
    found->erase(std::unique(begin, found->end(), same), found->end());
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
