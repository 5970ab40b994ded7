#pragma once

#include <array>

#include "convex_shape.h"
#include "matrix_game.h"
#include "triangle_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! A point of a segment or triangle with its signed distance to a convex solid.
struct ConvexPlace {
  double distance = INFINITY;  //!< [m] signed
  Weights weights = {0.0, 0.0, 0.0};
};

//! A corner of an element with its signed distance to a convex solid.
struct ConvexSample {
  Vector3 point;
  double distance;
  Vector3 gradient;
};

//! The least signed distance of a segment or triangle to a convex solid.
//!
//! That distance is convex, so every tangent bounds it from below. On an edge the tangents of both ends of a bracket
//! close in on its minimum. A triangle's minimum is on an edge or, where the solid is on one side of its plane, at the
//! solid's farthest point towards it. Elsewhere the solid comes through the plane: then the least maximum of all
//! tangents so far (MatrixGame) is sampled next (Kelley, The cutting-plane method for solving convex programs, 1960).
class ConvexSearch {
 public:
  explicit ConvexSearch(const ConvexShape& shape) : shape_(shape) {}

  ConvexSample sample(const Vector3& point) const;

  //! A lower bound [m] of an element's least distance, by its corners' tangents.
  //! @param corners [count] 2 or 3
  static double lowerBound(const std::array<const ConvexSample*, 3>& corners, int count);

  //! The point with the least distance; of several, the middle of their edges and corners.
  //! @param corners [count] 2 or 3
  ConvexPlace minimum(const std::array<const ConvexSample*, 3>& corners, int count);

 private:
  struct Place {
    ConvexSample at;
    Weights weights;
  };
  static constexpr int kMostCuts = MatrixGame::kMostFunctions;

  Place placeAt(const Weights& weights) const;
  Place between(int from, int to, double parameter) const;
  Place edgeMinimum(int from, int to) const;
  double levelEnd(int from, int to, double inside, double end, double level) const;
  void consider(const Place& place);
  bool certain() const;
  void overFace();
  void cutPlanes();
  double nextCut(Weights* weights);
  void addCut(const Place& place, const Weights& last);
  ConvexPlace middle() const;

  const ConvexShape& shape_;
  std::array<const ConvexSample*, 3> corners_;
  int count_ = 0;
  Place best_;
  std::array<Place, 8> found_;  // minima of edges and what is over the face
  int found_count_ = 0;
  std::array<std::array<double, 3>, kMostCuts> cuts_;  // values of tangents at the corners
  int cut_count_ = 0;
};

}  // namespace distance
}  // namespace deformable_manipulation
