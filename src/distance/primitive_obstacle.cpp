#include "deformable_manipulation/distance/primitive_obstacle.h"

#include <cmath>
#include <sstream>
#include <utility>

#include "convex_search.h"
#include "coordinate_limit.h"
#include "obstacle_frame.h"
#include "pose_checks.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kSlack = 1e-9;       // m, of lower bounds: far more than rounding
constexpr double kNotBetter = 1e-12;  // m, what an element must promise to be searched when others have been

void checkLength(const char* name, double value, std::vector<std::string>* problems) {
  if (!(value > 0.0 && value <= kLargestCoordinate)) {
    std::ostringstream text;
    text << name << " is " << value << "; it must be above 0 and at most 1e6 m";
    problems->push_back(text.str());
  }
}

}  // namespace

//! A solid with the object in its frame.
class PrimitiveObstacle::Search {
 public:
  explicit Search(std::unique_ptr<const ConvexShape> shape) : shape_(std::move(shape)), search_(*shape_) {}

  ObstacleFrame frame;

  void minima(const ObjectView& object, Feature* nearest) {
    for (int copy = 0; copy < object.copies; ++copy) {
      bring(object, copy);
      double upper = INFINITY;
      for (const ConvexSample& sample : samples_) {
        upper = std::min(upper, sample.distance);
      }
      ConvexPlace least;
      std::array<int, 3> least_element = {0, 0, 0};
      for (int e = 0; e < object.elements(); ++e) {
        const std::array<int, 3> element = object.element(e);
        const double bound = ConvexSearch::lowerBound(cornersOf(element), object.cornersOfElement());
        if (bound <= upper + kSlack && bound < least.distance - kNotBetter) {
          const ConvexPlace found = search_.minimum(cornersOf(element), object.cornersOfElement());
          if (found.distance < least.distance) {
            least = found;
            least_element = element;
            upper = std::min(upper, found.distance);
          }
        }
      }
      nearest[copy] = featureAt(object, copy, least_element, least);
    }
  }

  void features(const ObjectView& object, double limit, std::vector<Feature>* found) {
    bring(object, 0);
    for (int e = 0; e < object.elements(); ++e) {
      const std::array<int, 3> element = object.element(e);
      if (ConvexSearch::lowerBound(cornersOf(element), object.cornersOfElement()) <= limit + kSlack) {
        const ConvexPlace place = search_.minimum(cornersOf(element), object.cornersOfElement());
        if (place.distance <= limit) {
          found->push_back(featureAt(object, 0, element, place));
        }
      }
    }
  }

 private:
  std::array<const ConvexSample*, 3> cornersOf(const std::array<int, 3>& element) const {
    return {&samples_[element[0]], &samples_[element[1]], &samples_[element[2]]};
  }

  void bring(const ObjectView& object, int copy) {
    samples_.resize(object.point_count);
    for (int i = 0; i < object.point_count; ++i) {
      samples_[i] = search_.sample(frame.toLocal(object.point(copy, i)));
    }
  }

  Feature featureAt(const ObjectView& object, int copy, const std::array<int, 3>& element,
                    const ConvexPlace& place) const {
    Feature feature;
    feature.vertices = element;
    feature.weights = place.weights;
    for (int k = 0; k < 3; ++k) {
      feature.object_point += place.weights[k] * object.point(copy, element[k]);
    }
    const ConvexSample there = search_.sample(frame.toLocal(feature.object_point));
    feature.distance = there.distance;
    feature.normal = frame.toFixed(there.gradient);
    feature.obstacle_point = feature.object_point - there.distance * feature.normal;
    feature.obstacle_velocity = frame.velocityAt(feature.obstacle_point);
    return feature;
  }

  std::unique_ptr<const ConvexShape> shape_;
  ConvexSearch search_;
  std::vector<ConvexSample> samples_;  // of the object's points, in the frame of the solid
};

PrimitiveObstacle::PrimitiveObstacle(std::unique_ptr<const ConvexShape> shape)
    : search_(std::make_unique<Search>(std::move(shape))) {}

PrimitiveObstacle::~PrimitiveObstacle() = default;

std::shared_ptr<PrimitiveObstacle> PrimitiveObstacle::halfSpace(const Vector3& normal) {
  std::vector<std::string> problems;
  if (!normal.allFinite() || !(normal.norm() > 1e-6)) {
    std::ostringstream text;
    text << "normal is " << normal.transpose() << "; it must be three finite numbers, longer than 1e-6";
    problems.push_back(text.str());
  }
  throwIfAny(problems);
  return std::shared_ptr<PrimitiveObstacle>(new PrimitiveObstacle(std::make_unique<HalfSpace>(normal)));
}

std::shared_ptr<PrimitiveObstacle> PrimitiveObstacle::sphere(double radius) {
  std::vector<std::string> problems;
  checkLength("radius", radius, &problems);
  throwIfAny(problems);
  return std::shared_ptr<PrimitiveObstacle>(new PrimitiveObstacle(std::make_unique<CapsuleShape>(radius, 0.0)));
}

std::shared_ptr<PrimitiveObstacle> PrimitiveObstacle::box(const Vector3& size) {
  std::vector<std::string> problems;
  for (int k = 0; k < 3; ++k) {
    checkLength("a side", size[k], &problems);
  }
  throwIfAny(problems);
  return std::shared_ptr<PrimitiveObstacle>(new PrimitiveObstacle(std::make_unique<BoxShape>(size)));
}

std::shared_ptr<PrimitiveObstacle> PrimitiveObstacle::cylinder(double radius, double length) {
  std::vector<std::string> problems;
  checkLength("radius", radius, &problems);
  checkLength("length", length, &problems);
  throwIfAny(problems);
  return std::shared_ptr<PrimitiveObstacle>(new PrimitiveObstacle(std::make_unique<CylinderShape>(radius, length)));
}

std::shared_ptr<PrimitiveObstacle> PrimitiveObstacle::capsule(double radius, double length) {
  std::vector<std::string> problems;
  checkLength("radius", radius, &problems);
  checkLength("length", length, &problems);
  throwIfAny(problems);
  return std::shared_ptr<PrimitiveObstacle>(new PrimitiveObstacle(std::make_unique<CapsuleShape>(radius, length)));
}

void PrimitiveObstacle::place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
  search_->frame.set(translation, rotation, velocity);
}

void PrimitiveObstacle::minima(const ObjectView& object, Feature* nearest) { search_->minima(object, nearest); }

void PrimitiveObstacle::features(const ObjectView& object, double limit, std::vector<Feature>* found) {
  search_->features(object, limit, found);
}

}  // namespace distance
}  // namespace deformable_manipulation
