#pragma once

#include <array>
#include <string>
#include <vector>

#include "distance_grid.h"
#include "segment_depth.h"

namespace deformable_manipulation {
namespace distance {

constexpr double kLevel = 1e-11;         // m, distances that count as the same on a stretch parallel to an edge
constexpr double kProbe = 1e-5;          // m, a stretch shorter than this is a point
constexpr double kBoundSlack = 1e-9;     // m, by which bounds are wider, so that rounding shuts nothing out
constexpr double kUnbounded = INFINITY;  // m, any distance

//! A point of the plane: how far from the boundary, and the nearest edge.
struct SignedPoint {
  double distance;  //!< [m] negative inside
  int edge;
};

//! The point of a segment with the least signed distance.
struct SegmentNearest {
  double distance = INFINITY;  //!< [m] negative inside
  double parameter = 0.0;
  int edge = 0;  //!< an edge near there
};

//! The region in a boundary: signed distances of points and segments to its boundary.
class PlanarRegion {
 public:
  explicit PlanarRegion(PlanarBoundary boundary)
      : boundary_(std::move(boundary)), tree_(boundary_), grid_(boundary_, tree_), depth_(boundary_, tree_) {}
  PlanarRegion(const PlanarRegion&) = delete;
  PlanarRegion& operator=(const PlanarRegion&) = delete;

  const PlanarBoundary& boundary() const { return boundary_; }
  const EdgeTree& tree() const { return tree_; }

  //! Not more than the signed distance [m] of a point.
  double lowerBound(const Point2& point) const { return grid_.lowerBound(point); }

  SignedPoint signedPoint(const Point2& point, int guess) const;
  SignedPoint signedPoint(const Point2& point) const { return signedPoint(point, grid_.guess(point)); }

  //! A segment's point with the least signed distance; not any point if that is beyond `bound` [m].
  SegmentNearest nearest(const Segment2& segment, double bound) { return search(segment, bound, nullptr); }

  //! The same, but where the segment is level with the boundary the middle of the nearest stretch.
  SegmentNearest nearestMiddle(const Segment2& segment, double bound);

  //! The parts of a segment that are inside. Valid until the next call.
  const std::vector<InsidePart>& partsInside(const Segment2& segment) {
    return depth_.partsInside(segment, grid_.guess(segment.middle));
  }

 private:
  SegmentNearest search(const Segment2& segment, double bound, Stretch* level);
  SegmentNearest deepest(const Segment2& segment, const std::vector<InsidePart>& parts, double bound, Stretch* level);

  const PlanarBoundary boundary_;
  const EdgeTree tree_;
  const DistanceGrid grid_;
  SegmentDepth depth_;
  const std::vector<InsidePart> whole_ = {{0.0, 1.0}};
};

}  // namespace distance
}  // namespace deformable_manipulation
