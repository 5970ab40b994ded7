#pragma once

#include <vector>

#include "planar_object.h"

namespace deformable_manipulation {
namespace distance {

//! Nearest points of polylines to a region.
class PlanarPolyline {
 public:
  explicit PlanarPolyline(PlanarRegion& region) : region_(region) {}

  //! The point with the least signed distance, which is not more than `bound` [m].
  MaterialPoint minimum(const PlanarCopy& line, double bound);

  //! Appends the nearest point of each segment whose signed distance is at most `limit` [m]. Where a segment is level
  //! with the boundary, the middle of the nearest stretch.
  void elements(const PlanarCopy& line, double limit, std::vector<MaterialPoint>* found);

  //! Calls visit(segment) for each segment, in order, whose signed distance may be at most a limit [m], which visit
  //! may lower.
  template <typename Visit>
  void visitNear(const PlanarCopy& line, const double& limit, Visit&& visit) const;

 private:
  static constexpr int kBlock = 6;  // segments that are passed over together

  bool blockMayReach(const PlanarCopy& line, int first, int last, double limit) const;

  PlanarRegion& region_;
};

//! A point of a polyline.
MaterialPoint onSegment(int segment, const SegmentNearest& nearest);

template <typename Visit>
void PlanarPolyline::visitNear(const PlanarCopy& line, const double& limit, Visit&& visit) const {
  for (int first = 0, last; first + 1 < line.count; first = last) {
    last = std::min(first + kBlock, line.count - 1);
    if (!blockMayReach(line, first, last, limit)) {
      continue;
    }
    double before = region_.lowerBound(line.points[first]);
    for (int i = first; i < last; ++i) {
      const double after = region_.lowerBound(line.points[i + 1]);
      // A signed distance changes by no more than the way along the segment.
      if (0.5 * (before + after - normBound(line.points[i + 1] - line.points[i])) <= limit) {
        visit(i);
      }
      before = after;
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
