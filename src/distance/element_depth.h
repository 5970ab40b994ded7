#pragma once

#include <vector>

#include "matrix_game.h"
#include "mesh_surface.h"

namespace deformable_manipulation {
namespace distance {

//! A point of a segment or triangle with its depth in a solid.
struct DeepPoint {
  double depth = -INFINITY;  //!< [m] minus the signed distance
  int triangle = -1;         //!< of the solid, the nearest
  Weights weights = {0.0, 0.0, 0.0};
};

//! The deepest point of a segment or triangle in a closed surface, by branch and bound.
//!
//! At a sampled point p the depth D(p) and the nearest triangle F are known. Everywhere else the depth is at most the
//! distance to F, which is convex, where p is inside; where it is outside, at most D(p) + |x - p|, which is convex,
//! too. On a piece of the element all these functions together give a bound and the point where it is reached
//! (MatrixGame). That point is sampled next; where the bound does not fall enough the piece is halved.
class ElementDepth {
 public:
  //! [m] Accuracy of a depth [m]: a thousandth of it and 1e-7 m, at most 1e-5 m.
  static double tolerance(double depth) { return std::min(1e-7 + 1e-3 * std::max(depth, 0.0), 1e-5); }

  static constexpr int kMostSamples = 400;  // of one element

  explicit ElementDepth(const MeshSurface& surface) : surface_(surface) {}

  //! @param count of corners: 2 or 3
  //! @param samples [count] of the surface, for the corners
  //! @param threshold [m] what is not deeper than this need not be found
  //! @return its depth is at most tolerance() less than the greatest one; -infinity if that is not above the threshold.
  //! Whether the search ends below the threshold has no influence on what is found otherwise.
  DeepPoint find(const Corners<3>& corners, int count, const std::array<SurfacePoint, 3>& samples, double threshold);

  //! Highest bound [m] less the depth that was found last: above tolerance() only where kMostSamples were not enough.
  double gap() const { return gap_; }

 private:
  struct Cut {
    Vector3 point;
    double depth;
    int triangle;  // -1: a cone
  };
  struct Piece {
    Corners<3> corners;
    std::array<Weights, 3> weights;  // of the corners in the element
    MatrixGame::Solution solution;
    std::size_t cuts;  // that are in the solution
  };

  void cut(const Vector3& point, double depth, int triangle);
  void sample(const Vector3& point, const Weights& weights, const SurfacePoint& at);
  double value(const Cut& cut, const Vector3& point) const;
  void solve(Piece* piece) const;
  void push(const Piece& piece);
  Piece pop();
  void refine(Piece piece);
  void halve(const Piece& piece);

  const MeshSurface& surface_;
  int count_ = 3;
  int samples_ = 0;
  double threshold_ = 0.0;
  DeepPoint best_;
  std::vector<Cut> cuts_;
  std::vector<Piece> pieces_;  // a heap, the highest bound first
  double gap_ = 0.0;
};

}  // namespace distance
}  // namespace deformable_manipulation
