#include "planar_polyline.h"

namespace deformable_manipulation {
namespace distance {

MaterialPoint onSegment(int segment, const SegmentNearest& nearest) {
  return {nearest.distance,
          nearest.edge,
          {segment, segment + 1, segment + 1},
          {1.0 - nearest.parameter, nearest.parameter, 0.0}};
}

const std::vector<double>& PlanarPolyline::lowerBounds(const PlanarCopy& line) {
  of_points_.resize(line.count);
  of_segments_.resize(line.count - 1);
  for (int i = 0; i < line.count; ++i) {
    of_points_[i] = region_.lowerBound(line.points[i]);
  }
  // A signed distance changes by no more than the way along the segment.
  for (int i = 0; i + 1 < line.count; ++i) {
    const double length = normBound(line.points[i + 1] - line.points[i]);
    of_segments_[i] = 0.5 * (of_points_[i] + of_points_[i + 1] - length);
  }
  return of_segments_;
}

MaterialPoint PlanarPolyline::minimum(const PlanarCopy& line, double bound) {
  const std::vector<double>& lower = lowerBounds(line);
  SegmentNearest best;
  int best_segment = 0;
  bound += kBoundSlack;
  for (int i = 0; i + 1 < line.count; ++i) {
    if (lower[i] <= bound) {
      const SegmentNearest nearest = region_.nearest({line.points[i], line.points[i + 1]}, bound);
      if (nearest.distance < best.distance) {
        best = nearest;
        best_segment = i;
        bound = std::min(bound, best.distance);
      }
    }
  }
  return onSegment(best_segment, best);
}

void PlanarPolyline::elements(const PlanarCopy& line, double limit, std::vector<MaterialPoint>* found) {
  const std::vector<double>& lower = lowerBounds(line);
  for (int i = 0; i + 1 < line.count; ++i) {
    if (lower[i] <= limit + kBoundSlack) {
      const SegmentNearest nearest = region_.nearestMiddle({line.points[i], line.points[i + 1]}, limit);
      if (nearest.distance <= limit) {
        found->push_back(onSegment(i, nearest));
      }
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
