#pragma once

#include <vector>

#include "element_depth.h"
#include "element_distance.h"
#include "mesh_surface.h"
#include "moving_bounds.h"
#include "object_tree.h"
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
class MeshSearch {
 public:
  explicit MeshSearch(const MeshPart& part) : surface_(part), depth_(surface_) {}

  const MeshSurface& surface() const { return surface_; }

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
  struct Nearest {
    int element = -1, triangle = -1;
    ElementNearest at{INFINITY};
    Vector3 direction = Vector3::Zero();  // about from the triangle to the element, at most 1 long; for speed only
  };
  struct Candidate {
    double depth;
    int child;
  };

  void start(ObjectTree& object, MovingBounds* bounds);
  const SurfacePoint& cornerSample(int point, int hint);
  MeshPlace placeAt(int element, const Weights& weights, double distance, int triangle) const;
  MeshPlace placeAt(int element, const Weights& weights, const SurfacePoint& there) const;

  Nearest nearestPair(double bound);
  Nearest nearestOf(int element, double reach, const Nearest& known);
  Vector3 towards(const Nearest& pair) const;
  MovingBounds::Plane separate(const Nearest& nearest);
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
  Nearest nearestWithin(int element, double bound);
  MeshPlace outsidePlace(int element, double limit);
  MeshPlace elementPlace(int element, double limit);
  double lowestPossible(int element, double* least);
  MeshPlace middleOfLevel(const MeshPlace& place);

  MeshSurface surface_;
  ElementDepth depth_;
  ObjectTree* object_ = nullptr;
  MovingBounds* bounds_ = nullptr;
  SearchStack<int> stack_;             // nodes, or leaves as ~index
  std::vector<SurfacePoint> samples_;  // of the object's points
  std::vector<int> sampled_;           // in which round
  int round_ = 0;
  std::vector<int> last_triangles_;  // that was the nearest to each element; a guess only
};

}  // namespace distance
}  // namespace deformable_manipulation
