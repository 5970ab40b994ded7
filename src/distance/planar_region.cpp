#include "planar_region.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kTouching = 1e-9;  // m, distance below which a segment may enter between two edges, by rounding

}  // namespace

SignedPoint PlanarRegion::signedPoint(const Point2& point, int guess) const {
  const NearestEdge nearest = tree_.nearest(point, guess);
  const double distance = std::sqrt(nearest.squared);
  return {boundary_.isInside(point, nearest.edge) ? -distance : distance, nearest.edge};
}

SegmentNearest PlanarRegion::nearestMiddle(const Segment2& segment, double bound) {
  Stretch level;
  SegmentNearest found = search(segment, bound, &level);
  if ((level.high - level.low) * segment.length > kProbe) {
    const double middle = 0.5 * (level.low + level.high);
    const SignedPoint there = signedPoint(segment.at(middle), found.edge);
    if (there.distance <= found.distance + kLevel) {  // else these are two separate minima
      found = {there.distance, middle, there.edge};
    }
  }
  return found;
}

SegmentNearest PlanarRegion::search(const Segment2& segment, double bound, Stretch* level) {
  bound += kBoundSlack;
  if (bound < 0.0) {
    const SignedPoint middle = signedPoint(segment.middle);
    if (middle.distance - 0.5 * segment.length > bound) {
      return {};
    }
    const bool inside = -middle.distance > 0.5 * segment.length + kTouching;
    return deepest(segment, inside ? whole_ : partsInside(segment), bound, level);
  }
  const BoundaryApproach near = approachBoundary(tree_, segment, bound * bound);
  const double distance = std::sqrt(near.squared);
  if (!(distance <= bound)) {
    const bool inside = lowerBound(segment.start) <= 0.0 && signedPoint(segment.start).distance < 0.0;
    return inside ? deepest(segment, whole_, bound, level) : SegmentNearest();
  }
  const Point2 place = segment.at(near.parameter);
  const bool touches = distance <= kTouching;
  if (touches || boundary_.isInside(place, near.edge)) {
    const SegmentNearest deep = deepest(segment, touches ? partsInside(segment) : whole_, bound, level);
    if (deep.distance <= 0.0) {
      return deep;
    }
  }
  if (level != nullptr) {
    *level = levelStretch(tree_, segment, distance + kLevel);
  }
  return {distance, near.parameter, near.edge};
}

SegmentNearest PlanarRegion::deepest(const Segment2& segment, const std::vector<InsidePart>& parts, double bound,
                                     Stretch* level) {
  SegmentNearest best;
  for (const InsidePart& part : parts) {
    const double tolerance = level == nullptr ? 0.0 : kLevel;
    const double limit = std::min(bound, best.distance + tolerance);
    Stretch stretch;
    const DeepPoint2 point = depth_.deepest(segment, part, -limit, tolerance, level == nullptr ? nullptr : &stretch);
    if (level != nullptr && point.depth >= 0.0) {
      if (-point.depth < best.distance - kLevel) {
        *level = stretch;
      } else {
        level->add(stretch.low);
        level->add(stretch.high);
      }
    }
    if (-point.depth < best.distance) {
      best = {-point.depth, point.parameter, point.edge};
    }
  }
  return best;
}

}  // namespace distance
}  // namespace deformable_manipulation
