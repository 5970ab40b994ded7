#include "boundary_search.h"

namespace deformable_manipulation {
namespace distance {
namespace {

//! Squared distances [m^2] between a segment and some edges, end by end.
struct GroupDistances {
  GroupDistances(const Segment2& s, const EdgeGroup& g) {
    const double half_length = 0.5 * s.length;
    for (int k = 0; k < kGroup; ++k) {
      const double du = g.direction_u[k], dv = g.direction_v[k];
      const double su = s.start.u - g.middle_u[k], sv = s.start.v - g.middle_v[k];
      const double eu = s.end.u - g.middle_u[k], ev = s.end.v - g.middle_v[k];
      start_across[k] = du * sv - dv * su;
      end_across[k] = du * ev - dv * eu;
      const double start_beyond = std::max(std::fabs(du * su + dv * sv) - g.half[k], 0.0);
      const double end_beyond = std::max(std::fabs(du * eu + dv * ev) - g.half[k], 0.0);
      from_start[k] = start_beyond * start_beyond + start_across[k] * start_across[k];
      from_end[k] = end_beyond * end_beyond + end_across[k] * end_across[k];

      const double cu = g.start_u[k] - s.middle.u, cv = g.start_v[k] - s.middle.v;
      const double nu = g.end_u[k] - s.middle.u, nv = g.end_v[k] - s.middle.v;
      along[k] = s.direction.u * cu + s.direction.v * cv;
      const double corner_across = s.direction.u * cv - s.direction.v * cu;
      const double next_across = s.direction.u * nv - s.direction.v * nu;
      const double corner_beyond = std::max(std::fabs(along[k]) - half_length, 0.0);
      from_corner[k] = corner_beyond * corner_beyond + corner_across * corner_across;
      crossing[k] = ((start_across[k] > 0.0) != (end_across[k] > 0.0)) & ((corner_across > 0.0) != (next_across > 0.0));
    }
  }

  //! The segment's parameter where it crosses an edge.
  double crossingParameter(int k) const { return start_across[k] / (start_across[k] - end_across[k]); }

  double start_across[kGroup];  // m, of the segment's start to the left of the edge
  double end_across[kGroup];    // m, of its end
  double from_start[kGroup];    // m^2, of the segment's start to the edge
  double from_end[kGroup];      // m^2, of its end
  double from_corner[kGroup];   // m^2, of the edge's first corner to the segment
  double along[kGroup];         // m, of that corner along the segment from its middle
  bool crossing[kGroup];        // whether segment and edge cross
};

}  // namespace

BoundaryApproach approachBoundary(const EdgeTree& tree, const Segment2& segment, double limit) {
  BoundaryApproach start, end, corner, crossed;
  double nearest = limit;
  limit = tree.limitFor(nearest, segment.middle);
  tree.visitNear(SegmentBound(segment), limit, [&](const EdgeGroup& group) {
    const GroupDistances distances(segment, group);
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
      if (distances.crossing[k] && (crossed.edge < 0 || index < crossed.edge)) {
        crossed = {0.0, distances.crossingParameter(k), index};
      }
    }
    const double least = crossed.edge >= 0 ? 0.0 : std::min({start.squared, end.squared, corner.squared});
    if (least < nearest) {
      nearest = least;
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
