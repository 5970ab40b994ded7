#include "distance_grid.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr int kCellsAlong = 192;   // the longer side
constexpr double kMargin = 0.125;  // around the ring, of its larger extent

}  // namespace

DistanceGrid::DistanceGrid(const PlanarRing& ring, const EdgeTree& tree) {
  const Point2 extent = ring.extent().upper - ring.extent().lower;
  const double margin = kMargin * std::max(extent.u, extent.v);
  const Point2 around = {margin, margin};
  box_.add(ring.extent().lower - around);
  box_.add(ring.extent().upper + around);
  const Point2 sides = box_.upper - box_.lower;
  cell_ = std::max(sides.u, sides.v) / kCellsAlong;
  cells_per_metre_ = 1.0 / cell_;
  columns_ = std::max(static_cast<int>(std::ceil(sides.u * cells_per_metre_)), 1);
  rows_ = std::max(static_cast<int>(std::ceil(sides.v * cells_per_metre_)), 1);
  cells_.reserve(columns_ * rows_);
  int edge = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Point2 middle = middleOf(column, row);
      const NearestEdge nearest = tree.nearest(middle, edge);
      edge = nearest.edge;
      const double distance = std::sqrt(nearest.squared);
      const double rounded = (ring.isInside(middle, edge) ? -distance : distance) - 1e-6 * distance - 1e-12 * margin;
      cells_.push_back({static_cast<float>(rounded), edge});
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
