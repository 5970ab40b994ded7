#include "boundary_search.h"

namespace deformable_manipulation {
namespace distance {
namespace {

//! Squared distances [m^2] between a segment and some edges, end by end.
struct GroupDistances {
  GroupDistances(const Segment2& s, const EdgeGroup& g) {
    const Four su = s.start.u - g.middle.u, sv = s.start.v - g.middle.v;
    const Four eu = s.end.u - g.middle.u, ev = s.end.v - g.middle.v;
    start_across = g.direction.u * sv - g.direction.v * su;
    end_across = g.direction.u * ev - g.direction.v * eu;
    const Four start_beyond = larger(absolute(g.direction.u * su + g.direction.v * sv) - g.half, Four{});
    const Four end_beyond = larger(absolute(g.direction.u * eu + g.direction.v * ev) - g.half, Four{});
    from_start = start_beyond * start_beyond + start_across * start_across;
    from_end = end_beyond * end_beyond + end_across * end_across;

    const Four cu = g.start.u - s.middle.u, cv = g.start.v - s.middle.v;
    const Four nu = g.end.u - s.middle.u, nv = g.end.v - s.middle.v;
    along = s.direction.u * cu + s.direction.v * cv;
    corner_across = s.direction.u * cv - s.direction.v * cu;
    next_across = s.direction.u * nv - s.direction.v * nu;
    const Four corner_beyond = larger(absolute(along) - 0.5 * s.length, Four{});
    from_corner = corner_beyond * corner_beyond + corner_across * corner_across;
  }

  //! Whether the segment crosses an edge.
  bool crosses(int k) const {
    return (start_across[k] > 0.0) != (end_across[k] > 0.0) && (corner_across[k] > 0.0) != (next_across[k] > 0.0);
  }

  //! False only if it crosses none.
  bool mayCross() const {
    const Four edge_sides = start_across * end_across, segment_sides = corner_across * next_across;
    return least(larger(edge_sides, segment_sides)) <= 0.0;
  }

  //! The segment's parameter where it crosses an edge.
  double crossingParameter(int k) const { return start_across[k] / (start_across[k] - end_across[k]); }

  Four start_across;   // m, of the segment's start to the left of the edge
  Four end_across;     // m, of its end
  Four from_start;     // m^2, of the segment's start to the edge
  Four from_end;       // m^2, of its end
  Four from_corner;    // m^2, of the edge's first corner to the segment
  Four along;          // m, of that corner along the segment from its middle
  Four next_across;    // m, of the next corner to the left of the segment
  Four corner_across;  // m, of that corner
};

}  // namespace

BoundaryApproach approachBoundary(const EdgeTree& tree, const Segment2& segment, double limit) {
  BoundaryApproach start, end, corner, crossed;
  double nearest = limit;
  limit = tree.limitFor(nearest, segment.middle);
  tree.visitNear(SegmentBound(segment), limit, [&](const EdgeGroup& group) {
    const GroupDistances distances(segment, group);
    const Four ends = smaller(distances.from_start, distances.from_end);
    if (!distances.mayCross() && least(smaller(ends, distances.from_corner)) > nearest) {
      return;
    }
    for (int k = 0; k < kGroup; ++k) {
      const int index = group.index[k];
      if (distances.from_start[k] < start.squared) {
        start = {distances.from_start[k], 0.0, index};
      }
      if (distances.from_end[k] < end.squared) {
        end = {distances.from_end[k], 1.0, index};
      }
      const double squared = distances.from_corner[k];
      if (squared < corner.squared || (squared == corner.squared && index < corner.edge)) {
        corner = {squared, distances.along[k], index};
      }
      if (distances.crosses(k) && (crossed.edge < 0 || index < crossed.edge)) {
        crossed = {0.0, distances.crossingParameter(k), index};
      }
    }
    const double now = crossed.edge >= 0 ? 0.0 : std::min({start.squared, end.squared, corner.squared});
    if (now < nearest) {
      nearest = now;
      limit = tree.limitFor(nearest, segment.middle);
    }
  });
  if (crossed.edge >= 0) {
    return crossed;
  }
  corner.parameter = segment.parameter(corner.parameter);
  const BoundaryApproach& nearer_end = end.squared < start.squared ? end : start;
  return corner.squared <= nearer_end.squared ? corner : nearer_end;
}

Stretch levelStretch(const EdgeTree& tree, const Segment2& segment, double distance) {
  const double level = distance * distance;
  const double limit = tree.limitFor(level, segment.middle);
  Stretch stretch;
  tree.visitNear(SegmentBound(segment), limit, [&](const EdgeGroup& group) {
    const GroupDistances distances(segment, group);
    for (int k = 0; k < kGroup; ++k) {
      if (distances.from_start[k] <= level) {
        stretch.add(0.0);
      }
      if (distances.from_end[k] <= level) {
        stretch.add(1.0);
      }
      if (distances.from_corner[k] <= level) {
        stretch.add(segment.parameter(distances.along[k]));
      }
    }
  });
  return stretch;
}

}  // namespace distance
}  // namespace deformable_manipulation
