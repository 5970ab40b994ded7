#include "segment_depth.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kCornerTolerance = 1e-9;  // m, so that no crossing slips through between two edges
constexpr double kDepthRounding = 1e-13;   // m

//! The parameter between two at which a segment is equally far from two edges, as near to one as to the other.
//! @param first where edge a is nearer than edge b
//! @param last where it is the other way around
double equidistant(const Segment2& segment, const Segment2& a, const Segment2& b, double first, double last) {
  const auto difference = [&](double parameter) {
    const Point2 point = segment.at(parameter);
    return a.squaredDistance(point) - b.squaredDistance(point);
  };
  double at_first = difference(first), at_last = difference(last);
  for (int i = 0; i < 100 && last - first > 1e-16; ++i) {
    // False position with the older end's value halved (Illinois), which keeps the root between both.
    double parameter = first + (last - first) * (at_first / (at_first - at_last));
    if (!(parameter > first && parameter < last)) {
      parameter = 0.5 * (first + last);
      if (parameter <= first || parameter >= last) {
        break;
      }
    }
    const double here = difference(parameter);
    if (here == 0.0) {
      return parameter;
    }
    if (here < 0.0) {
      first = parameter;
      at_first = here;
      at_last *= 0.5;
    } else {
      last = parameter;
      at_last = here;
      at_first *= 0.5;
    }
  }
  return 0.5 * (first + last);
}

}  // namespace

const std::vector<InsidePart>& SegmentDepth::partsInside(const Segment2& segment, int guess) {
  cuts_.assign({0.0, 1.0});
  const double limit = tree_.limitFor(0.0, segment.middle);
  tree_.visitNear(SegmentBound(segment), limit, [&](const EdgeGroup& group) {
    for (int index : group.index) {
      const Segment2& edge = boundary_.edge(index);
      const double start = edge.across(segment.start), end = edge.across(segment.end);
      const double parameter = start / (start - end);  // not finite where parallel
      if (parameter > 0.0 && parameter < 1.0 &&
          std::fabs(edge.along(segment.at(parameter))) <= 0.5 * edge.length + kCornerTolerance) {
        cuts_.push_back(parameter);
      }
    }
  });
  std::sort(cuts_.begin(), cuts_.end());
  parts_.clear();
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    if (cuts_[i] < cuts_[i + 1] || segment.length == 0.0) {
      const Point2 middle = segment.at(0.5 * (cuts_[i] + cuts_[i + 1]));
      guess = tree_.nearest(middle, guess).edge;
      if (boundary_.isInside(middle, guess)) {
        parts_.push_back({cuts_[i], cuts_[i + 1]});
      }
    }
  }
  return parts_;
}

DeepPoint2 SegmentDepth::pointAt(const Segment2& segment, double parameter, int guess) const {
  const NearestEdge nearest = tree_.nearest(segment.at(parameter), guess);
  return {parameter, std::sqrt(nearest.squared), nearest.edge};
}

DeepPoint2 SegmentDepth::deepest(const Segment2& segment, const InsidePart& part, double floor, double level,
                                 Stretch* stretch) {
  const DeepPoint2 first = pointAt(segment, part.first, 0);
  const DeepPoint2 last = pointAt(segment, part.last, first.edge);
  evaluated_.assign({first, last});
  pieces_.assign(1, {first, last});
  DeepPoint2 best = {0.0, -INFINITY, -1};
  std::size_t compared = 0;
  for (;;) {
    for (; compared < evaluated_.size(); ++compared) {
      const DeepPoint2& point = evaluated_[compared];
      if (point.depth > best.depth || (point.depth == best.depth && point.parameter < best.parameter)) {
        best = point;
      }
    }
    if (pieces_.empty()) {
      break;
    }
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    divide(segment, piece, std::max(floor, best.depth - level));
  }
  if (best.depth < floor) {
    return {0.0, -INFINITY, -1};
  }
  for (std::size_t i = 0; stretch != nullptr && i < evaluated_.size(); ++i) {
    if (evaluated_[i].depth >= best.depth - level) {
      stretch->add(evaluated_[i].parameter);
    }
  }
  return best;
}

void SegmentDepth::divide(const Segment2& segment, const Piece& piece, double floor) {
  const DeepPoint2 &first = piece.first, &last = piece.last;
  const Segment2 &a = boundary_.edge(first.edge), &b = boundary_.edge(last.edge);
  const double a_at_last = a.distance(segment.at(last.parameter));
  const double b_at_first = b.distance(segment.at(first.parameter));
  const double ceiling = std::min(std::max(first.depth, a_at_last), std::max(last.depth, b_at_first));
  const bool one_edge_bounds = b_at_first - first.depth <= kDepthRounding || a_at_last - last.depth <= kDepthRounding;
  if (one_edge_bounds || ceiling < floor) {
    return;
  }
  const double parameter = equidistant(segment, a, b, first.parameter, last.parameter);
  if (parameter <= first.parameter || parameter >= last.parameter) {
    return;
  }
  const double distance = a.distance(segment.at(parameter));
  if (std::max({first.depth, distance, last.depth}) < floor) {
    return;
  }
  const DeepPoint2 middle = pointAt(segment, parameter, first.edge);
  evaluated_.push_back(middle);
  if (middle.depth < distance - kDepthRounding) {
    pieces_.push_back({middle, last});
    pieces_.push_back({first, middle});
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
