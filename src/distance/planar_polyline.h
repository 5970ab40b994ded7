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

  //! Lower bounds [m] of the signed distances of the segments.
  const std::vector<double>& lowerBounds(const PlanarCopy& line);

 private:
  PlanarRegion& region_;
  std::vector<double> of_points_, of_segments_;
};

//! A point of a polyline.
MaterialPoint onSegment(int segment, const SegmentNearest& nearest);

}  // namespace distance
}  // namespace deformable_manipulation
