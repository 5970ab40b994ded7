#pragma once

#include <vector>

#include "edge_tree.h"

namespace deformable_manipulation {
namespace distance {

//! Signed distances at the middles of a grid's cells, which bound those of all points from below.
class DistanceGrid {
 public:
  DistanceGrid(const PlanarRing& ring, const EdgeTree& tree);

  //! Not more than the signed distance [m] of a point, wherever it is.
  double lowerBound(const Point2& point) const {
    const Point2 inside = clamped(point);
    const int column = columnOf(inside), row = rowOf(inside);
    const double bound = cells_[row * columns_ + column].distance - normBound(inside - middleOf(column, row));
    const Point2 beyond = point - inside;
    if (beyond.u == 0.0 && beyond.v == 0.0) {
      return bound;
    }
    // Seen from a box around the ring, all of the ring is on the other side of the nearest point.
    const double positive = std::max(bound, 0.0);
    return std::sqrt(squaredNorm(beyond) + positive * positive) * (1.0 - 1e-12);
  }

  //! The edge nearest to the middle of a point's cell.
  int guess(const Point2& point) const {
    const Point2 inside = clamped(point);
    return cells_[rowOf(inside) * columns_ + columnOf(inside)].edge;
  }

 private:
  struct Cell {
    float distance;  // m, of the middle, rounded down
    int edge;        // nearest to the middle
  };

  Point2 clamped(const Point2& point) const {
    return {std::min(std::max(point.u, box_.lower.u), box_.upper.u),
            std::min(std::max(point.v, box_.lower.v), box_.upper.v)};
  }
  int columnOf(const Point2& inside) const {
    return std::min(static_cast<int>((inside.u - box_.lower.u) * cells_per_metre_), columns_ - 1);
  }
  int rowOf(const Point2& inside) const {
    return std::min(static_cast<int>((inside.v - box_.lower.v) * cells_per_metre_), rows_ - 1);
  }
  Point2 middleOf(int column, int row) const {
    return {box_.lower.u + (column + 0.5) * cell_, box_.lower.v + (row + 0.5) * cell_};
  }

  Box2 box_;
  double cell_;  // m, side of a cell
  double cells_per_metre_;
  int columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace distance
}  // namespace deformable_manipulation
