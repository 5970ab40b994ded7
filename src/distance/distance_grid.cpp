#include "distance_grid.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr int kCellsAlong = 192;   // the longer side
constexpr double kMargin = 0.125;  // around the boundary, of its larger extent

}  // namespace

DistanceGrid::DistanceGrid(const PlanarBoundary& boundary, const EdgeTree& tree) {
  const Point2 extent = boundary.extent().upper - boundary.extent().lower;
  const double margin = kMargin * std::max(extent.u, extent.v);
  const Point2 sides = {extent.u + 2.0 * margin, extent.v + 2.0 * margin};
  lower_ = boundary.extent().lower - Point2{margin, margin};
  cell_ = std::max(sides.u, sides.v) / kCellsAlong;
  cells_per_metre_ = 1.0 / cell_;
  columns_ = std::max(static_cast<int>(std::ceil(sides.u * cells_per_metre_)), 1);
  rows_ = std::max(static_cast<int>(std::ceil(sides.v * cells_per_metre_)), 1);
  cells_.reserve(columns_ * rows_);
  int edge = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Point2 middle = lower_ + cell_ * Point2{column + 0.5, row + 0.5};
      const NearestEdge nearest = tree.nearest(middle, edge);
      edge = nearest.edge;
      const double distance = std::sqrt(nearest.squared);
      const double rounded =
          (boundary.isInside(middle, edge) ? -distance : distance) - 1e-6 * distance - 1e-12 * margin;
      cells_.push_back({static_cast<float>(rounded), edge});
    }
  }
}

double DistanceGrid::boundOutside(const Point2& point) const {
  const Point2 place = cells_per_metre_ * (point - lower_), inside = clamped(place);
  // Seen from a box around the boundary, all of the boundary is on the other side of the box's nearest point.
  const double squared = cell_ * cell_ * squaredNorm(place - inside), bound = std::max(boundAt(inside), 0.0);
  return std::sqrt(squared + bound * bound) * (1.0 - 1e-9);
}

}  // namespace distance
}  // namespace deformable_manipulation
