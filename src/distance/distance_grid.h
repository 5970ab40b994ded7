#pragma once

#include <vector>

#include "edge_tree.h"

namespace deformable_manipulation {
namespace distance {

//! Signed distances at the middles of a grid's cells, which bound those of all points from below.
class DistanceGrid {
 public:
  DistanceGrid(const PlanarBoundary& boundary, const EdgeTree& tree);

  //! Not more than the signed distance [m] of a point, wherever it is.
  double lowerBound(const Point2& point) const {
    const Point2 place = cells_per_metre_ * (point - lower_);
    return covers(place) ? boundAt(place) : boundOutside(point);
  }

  //! The edge nearest to the middle of a point's cell.
  int guess(const Point2& point) const {
    const Point2 place = cells_per_metre_ * (point - lower_);
    return cells_[cellOf(covers(place) ? place : clamped(place))].edge;
  }

 private:
  struct Cell {
    float distance;  // m, of the middle, rounded down
    int edge;        // nearest to the middle
  };

  // Places count in cells from the grid's lower corner.
  bool covers(const Point2& place) const {
    return place.u >= 0.0 && place.v >= 0.0 && place.u < columns_ && place.v < rows_;
  }
  Point2 clamped(const Point2& place) const {
    return {std::min(std::max(place.u, 0.0), columns_ - 0.5), std::min(std::max(place.v, 0.0), rows_ - 0.5)};
  }
  int cellOf(const Point2& place) const { return static_cast<int>(place.v) * columns_ + static_cast<int>(place.u); }
  double boundAt(const Point2& place) const {
    const int column = static_cast<int>(place.u), row = static_cast<int>(place.v);
    const Point2 arm = {place.u - (column + 0.5), place.v - (row + 0.5)};
    return cells_[row * columns_ + column].distance - cell_ * normBound(arm);
  }
  double boundOutside(const Point2& point) const;

  Point2 lower_;  // m, corner of the grid
  double cell_;   // m, side of a cell
  double cells_per_metre_;
  int columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace distance
}  // namespace deformable_manipulation
