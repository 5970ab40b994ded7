#include "deformable_manipulation/distance/mesh_obstacle.h"

#include "mesh_cleaning.h"
#include "mesh_search.h"
#include "pose_checks.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kOnSurface = 1e-9;  // m, distance below which the direction to the surface is rounding

//! Moves the middle of all parts to the origin, where single precision is finest.
Vector3 centre(std::vector<MeshPart>* parts) {
  Box box;
  for (const MeshPart& part : *parts) {
    for (const Vector3& vertex : part.vertices) {
      box.include(vertex);
    }
  }
  const Vector3 middle = box.middle();
  for (MeshPart& part : *parts) {
    for (Vector3& vertex : part.vertices) {
      vertex -= middle;
    }
  }
  return middle;
}

}  // namespace

//! The parts of a mesh, the object in their frame, and what was nearest last.
class MeshObstacle::Search {
 public:
  explicit Search(std::vector<MeshPart> parts) : middle_(centre(&parts)) {
    for (const MeshPart& part : parts) {
      parts_.push_back({std::make_unique<MeshSearch>(part), {}});
    }
  }

  void setPose(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
    rotation_ = rotation.normalized().toRotationMatrix();
    translation_ = translation;
    velocity_ = velocity;
  }

  void minima(const ObjectView& object, Feature* nearest) {
    prepare(object);
    for (int copy = 0; copy < object.copies; ++copy) {
      bring(object, copy);
      MeshPlace least;
      const Part* nearest_part = nullptr;
      for (Part& part : parts_) {
        Known& known = part.known[copy];
        const MeshPlace found = part.search->minimum(object_, least.distance, guess(part, copy), &known.bounds);
        if (found.known()) {
          known.nearest = found;
        }
        if (found.distance < least.distance) {
          least = found;
          nearest_part = &part;
        }
      }
      nearest[copy] = featureAt(object, copy, *nearest_part->search, least);
    }
  }

  void features(const ObjectView& object, double limit, std::vector<Feature>* found) {
    prepare(object);
    bring(object, 0);
    for (Part& part : parts_) {
      part.search->elements(object_, limit, guess(part, 0), &part.known[0].bounds, &places_);
      for (const MeshPlace& place : places_) {
        if (place.known()) {
          found->push_back(featureAt(object, 0, *part.search, place));
        }
      }
    }
  }

 private:
  //! What is known of a copy and a part from the calls before.
  struct Known {
    MeshPlace nearest;
    MovingBounds bounds;
  };
  struct Part {
    std::unique_ptr<MeshSearch> search;
    std::vector<Known> known;  // [copies]
  };

  //! What was nearest to this copy, or else to the one before.
  MeshPlace guess(const Part& part, int copy) const {
    for (int c = copy; c >= std::max(copy - 1, 0); --c) {
      if (part.known[c].nearest.known()) {
        return part.known[c].nearest;
      }
    }
    return {};
  }

  //! Takes the object's elements and makes room for its copies.
  void prepare(const ObjectView& object) {
    if (object_.setElements(object)) {
      points_.clear();
      for (Part& part : parts_) {
        part.known.clear();
      }
    }
    for (int copy = static_cast<int>(points_.size()); copy < object.copies; ++copy) {
      points_.emplace_back(object.point_count, Vector3::Zero());
      for (Part& part : parts_) {
        part.known.emplace_back();
        part.known.back().bounds.reset(object_.size());
      }
    }
  }

  //! Takes a copy into the frame of the parts.
  void bring(const ObjectView& object, int copy) {
    double squared_step = 0.0;
    for (int i = 0; i < object.point_count; ++i) {
      Vector3& point = points_[copy][i];
      const Vector3 before = point;
      point = toLocal(object.point(copy, i));
      squared_step = std::max(squared_step, (point - before).squaredNorm());
    }
    for (Part& part : parts_) {
      part.known[copy].bounds.move(std::sqrt(squared_step));
    }
    object_.setPoints(points_[copy]);
  }

  Vector3 toLocal(const Vector3& point) const { return rotation_.transpose() * (point - translation_) - middle_; }

  Feature featureAt(const ObjectView& object, int copy, const MeshSearch& search, const MeshPlace& place) const {
    Feature feature;
    feature.vertices = place.vertices;
    feature.weights = place.weights;
    for (int k = 0; k < 3; ++k) {
      feature.object_point += place.weights[k] * object.point(copy, place.vertices[k]);
    }
    const Vector3 local = toLocal(feature.object_point);
    const SurfacePoint nearest =
        place.there.triangle >= 0 ? place.there : search.surface().nearest(local, place.triangle);
    const Vector3 arm = rotation_ * (local - search.surface().position(nearest));
    feature.distance = nearest.distance;
    feature.obstacle_point = feature.object_point - arm;
    feature.normal = std::fabs(nearest.distance) > kOnSurface
                         ? Vector3(arm / nearest.distance)
                         : Vector3(rotation_ * search.surface().pseudonormal(nearest).normalized());
    feature.obstacle_velocity = velocity_.linear + velocity_.angular.cross(feature.obstacle_point - translation_);
    return feature;
  }

  Vector3 middle_;  // m, of the parts' frame in the obstacle's
  std::vector<Part> parts_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Vector3 translation_ = Vector3::Zero();
  pbd::Twist velocity_;
  ObjectTree object_;
  std::vector<std::vector<Vector3>> points_;  // m, of the copies, in the frame of the parts
  std::vector<MeshPlace> places_;
};

MeshObstacle::MeshObstacle(const std::vector<Vector3>& vertices, const std::vector<std::array<int, 3>>& triangles,
                           const Vector3& translation, const pbd::Quaternion& rotation) {
  std::vector<std::string> problems;
  std::vector<MeshPart> parts = cleanMesh(vertices, triangles, &problems, &warnings_);
  checkPose(translation, rotation, &problems);
  throwIfAny(problems);
  search_ = std::make_unique<Search>(std::move(parts));
  search_->setPose(translation, rotation, {});
}

MeshObstacle::~MeshObstacle() = default;

void MeshObstacle::place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
  search_->setPose(translation, rotation, velocity);
}

void MeshObstacle::minima(const ObjectView& object, Feature* nearest) { search_->minima(object, nearest); }

void MeshObstacle::features(const ObjectView& object, double limit, std::vector<Feature>* found) {
  search_->features(object, limit, found);
}

}  // namespace distance
}  // namespace deformable_manipulation
