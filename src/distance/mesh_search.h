#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "element_depth.h"
#include "element_distance.h"
#include "mesh_surface.h"
#include "nearest_pairs.h"
#include "search_stack.h"

namespace deformable_manipulation {
namespace distance {

//! A material point of the object with its signed distance to a surface.
struct MeshPlace {
  double distance = INFINITY;  //!< [m] signed
  int triangle = -1;           //!< of the surface, near there
  int element = -1;            //!< of the object
  Triangle vertices = {0, 0, 0};
  Weights weights = {0.0, 0.0, 0.0};
  SurfacePoint there;  //!< the surface's nearest point, or without a triangle: not searched yet

  bool known() const { return element >= 0; }
};

//! Searches the points of an object that are nearest to, or deepest in, one surface.
//!
//! Outside, the surface's tree is searched for each element that can be near enough, as far as is known of it from
//! calls before. An object is inside if it crosses the surface, or if one of its pieces does not but has a point
//! inside; then its deepest point is searched, triangle by triangle (ElementDepth).
class MeshSearch : private NearestPairs<MeshSearch> {
 public:
  explicit MeshSearch(std::shared_ptr<const MeshSurface> surface)
      : shared_(std::move(surface)), surface_(*shared_), depth_(surface_) {}

  const MeshSurface& surface() const { return surface_; }
  const std::shared_ptr<const MeshSurface>& sharedSurface() const { return shared_; }

  //! The point with the least signed distance.
  //! @param object with the points of one copy
  //! @param bound [m] if the least is above it, the result is not known()
  //! @param guess a place that was the nearest before, or unknown; for speed only
  //! @param bounds of this copy's elements
  MeshPlace minimum(ObjectTree& object, double bound, const MeshPlace& guess, MovingBounds* bounds);

  //! The point of each element with its least signed distance, where that is at most `limit` [m].
  //! @param guess a place that was the nearest before, or unknown; for speed only
  //! @param places [elements] of the object, not known() elsewhere
  //! @param bounds of this copy's elements
  void elements(ObjectTree& object, double limit, const MeshPlace& guess, MovingBounds* bounds,
                std::vector<MeshPlace>* places);

 private:
  friend class NearestPairs<MeshSearch>;
  struct Candidate {
    double depth;
    int child;
  };

  void start(ObjectTree& object, MovingBounds* bounds);
  const SurfacePoint& cornerSample(int point, int hint);
  MeshPlace placeAt(int element, const Weights& weights, double distance, int triangle) const;
  MeshPlace placeAt(int element, const Weights& weights, const SurfacePoint& there) const;

  Vector3 towards(const Nearest& pair) const;
  double heightAlong(const Vector3& normal, const HeightRange& range, const Box& box, double squared_reach) const {
    return surface_.heightAlong(normal, range, box, squared_reach);
  }
  template <int K>
  double search(int element, const Nearest& known, Nearest* nearest);
  template <int K>
  static FourFloats closerBounds(const Corners<K>& corners, const BoxNode& node, const DiscNode& discs,
                                 FourFloats bounds, double limit);

  bool pieceInside(int certified_piece);
  MeshPlace deepest(double known_depth);
  void descend(int child, MeshPlace* best);
  double depthBound(int child, const Box& box, MeshPlace* best);
  MeshPlace placeOfPoint(int point, const SurfacePoint& there) const;
  MeshPlace deepestOf(int element, double threshold);
  void improve(Nearest* pair) const;
  bool touchesBox(int element, double reach) const;
  MeshPlace outsidePlace(int element, double limit);
  MeshPlace elementPlace(int element, double limit);
  double lowestPossible(int element, double* least);
  MeshPlace middleOfLevel(const MeshPlace& place);

  std::shared_ptr<const MeshSurface> shared_;
  const MeshSurface& surface_;  // that
  ElementDepth depth_;
  SearchStack<int> stack_;             // nodes, or leaves as ~index
  std::vector<SurfacePoint> samples_;  // of the object's points
  std::vector<int> sampled_;           // in which round
  int round_ = 0;
};

}  // namespace distance
}  // namespace deformable_manipulation
