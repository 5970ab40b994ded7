#include "deformable_manipulation/distance/mesh_obstacle.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "cell_surface.h"
#include "coordinate_limit.h"
#include "local_copies.h"
#include "mesh_cleaning.h"
#include "mesh_search.h"
#include "obstacle_frame.h"
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
      parts_.push_back({std::make_unique<MeshSearch>(std::make_shared<const MeshSurface>(part)), {}});
    }
  }

  //! Of the same surfaces, at the same place.
  Search(const Search& other) : frame(other.frame), middle_(other.middle_) {
    for (const Part& part : other.parts_) {
      parts_.push_back({std::make_unique<MeshSearch>(part.search->sharedSurface()), {}});
    }
  }

  ObstacleFrame frame;

  void minima(const ObjectView& object, Feature* nearest) {
    prepare(object);
    for (int copy = 0; copy < object.copies; ++copy) {
      bring(object, copy);
      MeshPlace least;
      const Part* nearest_part = nullptr;
      for (Part& part : parts_) {
        Known& known = part.known[copy];
        const MeshPlace found =
            part.search->minimum(copies_.object(), least.distance, guess(part, copy), &known.bounds);
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
      part.search->elements(copies_.object(), limit, guess(part, 0), &part.known[0].bounds, &places_);
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

  void prepare(const ObjectView& object) {
    const bool others = copies_.prepare(object);
    for (Part& part : parts_) {
      if (others) {
        part.known.clear();
      }
      while (static_cast<int>(part.known.size()) < copies_.count()) {
        part.known.emplace_back();
        part.known.back().bounds.reset(copies_.object().size());
      }
    }
  }

  //! Takes a copy into the frame of the parts.
  void bring(const ObjectView& object, int copy) {
    const double step = copies_.bring(object, copy, [this](const Vector3& point) { return toLocal(point); });
    for (Part& part : parts_) {
      part.known[copy].bounds.move(step);
    }
  }

  Vector3 toLocal(const Vector3& point) const { return frame.toLocal(point) - middle_; }

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
    const Vector3 arm = frame.toFixed(local - search.surface().position(nearest));
    feature.distance = nearest.distance;
    feature.obstacle_point = feature.object_point - arm;
    feature.normal = std::fabs(nearest.distance) > kOnSurface
                         ? Vector3(arm / nearest.distance)
                         : Vector3(frame.toFixed(search.surface().pseudonormal(nearest).normalized()));
    feature.obstacle_velocity = frame.velocityAt(feature.obstacle_point);
    return feature;
  }

  Vector3 middle_;  // m, of the parts' frame in the obstacle's
  std::vector<Part> parts_;
  LocalCopies copies_;
  std::vector<MeshPlace> places_;
};

MeshObstacle::MeshObstacle(const std::vector<Vector3>& vertices, const std::vector<std::array<int, 3>>& triangles,
                           const Vector3& translation, const pbd::Quaternion& rotation) {
  std::vector<std::string> problems;
  std::vector<MeshPart> parts = cleanMesh(vertices, triangles, &problems, &warnings_);
  checkPose(translation, rotation, &problems);
  throwIfAny(problems);
  search_ = std::make_unique<Search>(std::move(parts));
  search_->frame.set(translation, rotation, {});
}

MeshObstacle::MeshObstacle(std::unique_ptr<Search> search) : search_(std::move(search)) {}

std::shared_ptr<MeshObstacle> MeshObstacle::ofCells(const std::vector<std::array<int, 3>>& cells, double size,
                                                    bool endless) {
  std::vector<std::string> problems;
  if (!(size > 0.0 && size * kLargestCell <= kLargestCoordinate * 1e3)) {
    problems.push_back("size is " + std::to_string(size) + "; it must be above 0 and at most 1000 m");
  }
  if (cells.empty()) {
    problems.push_back("there is no cube");
  }
  const auto is_far = [](const Cell& cell) {
    return std::any_of(cell.begin(), cell.end(), [](int index) { return std::abs(index) > kLargestCell; });
  };
  const auto far = std::find_if(cells.begin(), cells.end(), is_far);
  if (far != cells.end()) {
    problems.push_back("cube " + std::to_string(far - cells.begin()) + " is too far away; indices are at most " +
                       std::to_string(kLargestCell));
  }
  throwIfAny(problems);
  std::vector<MeshPart> parts = {surfaceOfCells(cells, size, endless)};
  return std::shared_ptr<MeshObstacle>(new MeshObstacle(std::make_unique<Search>(std::move(parts))));
}

std::shared_ptr<MeshObstacle> MeshObstacle::another() const {
  return std::shared_ptr<MeshObstacle>(new MeshObstacle(std::make_unique<Search>(*search_)));
}

MeshObstacle::~MeshObstacle() = default;

void MeshObstacle::place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
  search_->frame.set(translation, rotation, velocity);
}

void MeshObstacle::minima(const ObjectView& object, Feature* nearest) { search_->minima(object, nearest); }

void MeshObstacle::features(const ObjectView& object, double limit, std::vector<Feature>* found) {
  search_->features(object, limit, found);
}

}  // namespace distance
}  // namespace deformable_manipulation
