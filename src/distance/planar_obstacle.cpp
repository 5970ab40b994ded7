#include "deformable_manipulation/distance/planar_obstacle.h"

#include <utility>

#include "boundary_crossing.h"
#include "planar_frame.h"
#include "planar_polyline.h"
#include "planar_surface.h"
#include "pose_checks.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kOnBoundary = 1e-9;  // m, distance below which the direction to the boundary is rounding
constexpr const char* kAxisNames = "xyz";

//! The axes of a plane, two different letters in their order.
std::array<int, 2> axesOf(const std::string& plane, std::vector<std::string>* problems) {
  if (plane != "xy" && plane != "yz" && plane != "xz") {
    problems->push_back("plane is '" + plane + "'; it must be 'xy', 'yz' or 'xz'");
    return {0, 1};
  }
  const std::string names = kAxisNames;
  return {static_cast<int>(names.find(plane[0])), static_cast<int>(names.find(plane[1]))};
}

}  // namespace

//! A region in its plane, the copies in it, and what was nearest last.
class PlanarObstacle::Search {
 public:
  Search(PlanarBoundary boundary, const PlanarFrame& frame)
      : region_(std::move(boundary)), frame_(frame), polyline_(region_) {}

  const PlanarRegion& region() const { return region_; }

  void setPose(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
    frame_.setPose(translation, rotation);
    translation_ = translation;
    velocity_ = velocity;
  }

  void minima(const ObjectView& object, Feature* nearest) {
    remembered_.resize(object.copies);
    for (int c = 0; c < object.copies; ++c) {
      const PlanarCopy copy = projected(object, c);
      const double bound = boundFor(copy, remembered_[c]);
      remembered_[c] = object.triangles == nullptr
                           ? polyline_.minimum(copy, bound)
                           : surface().minimum(copy, object.triangles, object.triangle_count, bound);
      nearest[c] = featureAt(object, c, remembered_[c]);
    }
  }

  void features(const ObjectView& object, double limit, std::vector<Feature>* found) {
    const PlanarCopy copy = projected(object, 0);
    places_.clear();
    if (object.triangles == nullptr) {
      polyline_.elements(copy, limit, &places_);
    } else {
      surface().elements(copy, object.triangles, object.triangle_count, limit, &places_);
    }
    for (const MaterialPoint& place : places_) {
      found->push_back(featureAt(object, 0, place));
    }
  }

 private:
  PlanarCopy projected(const ObjectView& object, int copy) {
    flat_.resize(object.point_count);
    frame_.project(object.points + 3L * copy * object.point_count, object.point_count, flat_.data());
    return {flat_.data(), object.point_count};
  }

  //! Not less than the signed distance [m] of the material point that was the nearest of this copy last.
  double boundFor(const PlanarCopy& copy, const MaterialPoint& last) const {
    const std::array<int, 3>& vertices = last.vertices;
    if (!(last.distance < INFINITY) || *std::max_element(vertices.begin(), vertices.end()) >= copy.count) {
      return kUnbounded;
    }
    const Point2 point = copy.at(last);
    return last.distance > 0.0 ? region_.boundary().edge(last.edge).distance(point)
                               : region_.signedPoint(point, last.edge).distance;
  }

  PlanarSurface& surface() {
    if (surface_ == nullptr) {
      surface_ = std::make_unique<PlanarSurface>(region_);
    }
    return *surface_;
  }

  Feature featureAt(const ObjectView& object, int copy, const MaterialPoint& place) const {
    Feature feature;
    feature.vertices = place.vertices;
    feature.weights = place.weights;
    for (int k = 0; k < 3; ++k) {
      feature.object_point += place.weights[k] * object.point(copy, place.vertices[k]);
    }
    const Point2 point = frame_.project(feature.object_point);
    const SignedPoint nearest = region_.signedPoint(point, place.edge);
    const Segment2& edge = region_.boundary().edge(nearest.edge);
    const Point2 arm = point - edge.foot(edge.along(point));
    feature.distance = std::copysign(norm(arm), nearest.distance);
    feature.obstacle_point = feature.object_point - frame_.lift(arm);
    feature.normal =
        frame_.lift(std::fabs(feature.distance) > kOnBoundary ? (1.0 / feature.distance) * arm
                                                              : region_.boundary().outwardNormal(nearest.edge));
    feature.obstacle_velocity = velocity_.linear + velocity_.angular.cross(feature.obstacle_point - translation_);
    return feature;
  }

  PlanarRegion region_;
  PlanarFrame frame_;
  Vector3 translation_ = Vector3::Zero();  // m
  pbd::Twist velocity_;
  PlanarPolyline polyline_;
  std::unique_ptr<PlanarSurface> surface_;  // made when the first surface comes
  std::vector<Point2> flat_;
  std::vector<MaterialPoint> places_;
  std::vector<MaterialPoint> remembered_;  // of each copy, the nearest
};

PlanarObstacle::PlanarObstacle(const std::vector<std::array<double, 2>>& points, const std::string& plane,
                               const Vector3& translation, const pbd::Quaternion& rotation)
    : PlanarObstacle(std::vector<Corners2>{points}, plane, translation, rotation) {}

PlanarObstacle::PlanarObstacle(const std::vector<std::vector<std::array<double, 2>>>& rings, const std::string& plane,
                               const Vector3& translation, const pbd::Quaternion& rotation) {
  std::vector<std::string> problems;
  PlanarBoundary boundary(rings, &problems);
  const PlanarFrame frame(axesOf(plane, &problems), boundary.origin());
  checkPose(translation, rotation, &problems);
  if (boundary.size() > 0) {
    search_ = std::make_unique<Search>(std::move(boundary), frame);
    checkCrossings(search_->region().boundary(), search_->region().tree(), &problems);
  }
  throwIfAny(problems);
  search_->setPose(translation, rotation, {});
}

PlanarObstacle::~PlanarObstacle() = default;

void PlanarObstacle::place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
  search_->setPose(translation, rotation, velocity);
}

void PlanarObstacle::minima(const ObjectView& object, Feature* nearest) { search_->minima(object, nearest); }

void PlanarObstacle::features(const ObjectView& object, double limit, std::vector<Feature>* found) {
  search_->features(object, limit, found);
}

}  // namespace distance
}  // namespace deformable_manipulation
