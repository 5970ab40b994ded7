#include "planar_polyline.h"

namespace deformable_manipulation {
namespace distance {

MaterialPoint onSegment(int segment, const SegmentNearest& nearest) {
  return {nearest.distance,
          nearest.edge,
          {segment, segment + 1, segment + 1},
          {1.0 - nearest.parameter, nearest.parameter, 0.0}};
}

//! Whether the signed distance may be at most `limit` [m] somewhere from one point to another one: by how far the
//! line is around a point in the middle.
bool PlanarPolyline::blockMayReach(const PlanarCopy& line, int first, int last, double limit) const {
  const Point2 middle = line.points[(first + last) / 2];
  const double spare = region_.lowerBound(middle) - limit;
  double squared = 0.0;
  for (int i = first; i <= last; ++i) {
    squared = std::max(squared, squaredNorm(line.points[i] - middle));
  }
  return spare <= 0.0 || spare * spare <= squared * (1.0 + 1e-12);
}

MaterialPoint PlanarPolyline::minimum(const PlanarCopy& line, double bound) {
  SegmentNearest best;
  int best_segment = 0;
  bound += kBoundSlack;
  visitNear(line, bound, [&](int i) {
    const SegmentNearest nearest = region_.nearest({line.points[i], line.points[i + 1]}, bound);
    if (nearest.distance < best.distance) {
      best = nearest;
      best_segment = i;
      bound = std::min(bound, best.distance);
    }
  });
  return onSegment(best_segment, best);
}

void PlanarPolyline::elements(const PlanarCopy& line, double limit, std::vector<MaterialPoint>* found) {
  visitNear(line, limit + kBoundSlack, [&](int i) {
    const SegmentNearest nearest = region_.nearestMiddle({line.points[i], line.points[i + 1]}, limit);
    if (nearest.distance <= limit) {
      found->push_back(onSegment(i, nearest));
    }
  });
}

}  // namespace distance
}  // namespace deformable_manipulation
