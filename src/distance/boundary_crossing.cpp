#include "boundary_crossing.h"

#include <sstream>

namespace deformable_manipulation {
namespace distance {
namespace {

bool separates(const Segment2& line, const Segment2& other) {
  const double start = line.across(other.start), end = line.across(other.end);
  return (start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0);
}

bool meet(const Segment2& one, const Segment2& other) {
  return (separates(one, other) && separates(other, one)) || one.squaredDistance(other.start) == 0.0 ||
         one.squaredDistance(other.end) == 0.0;
}

//! The first edge that another one meets, or folds back onto where it follows it; -1 if there is none.
int edgeMeeting(const PlanarBoundary& boundary, const EdgeTree& tree, int edge) {
  const Segment2& segment = boundary.edge(edge);
  const int next = boundary.next(edge);
  const Point2 after = boundary.edge(next).direction;
  if (cross(segment.direction, after) == 0.0 && dot(segment.direction, after) < 0.0) {
    return next;
  }
  int found = -1;
  tree.visitNear(SegmentBound(segment), tree.limitFor(0.0, segment.middle), [&](const EdgeGroup& group) {
    for (int other : group.index) {
      const bool adjacent = other == edge || other == next || other == boundary.previous(edge);
      if (!adjacent && meet(segment, boundary.edge(other))) {
        found = other;
      }
    }
  });
  return found;
}

}  // namespace

void checkCrossings(const PlanarBoundary& boundary, const EdgeTree& tree, std::vector<std::string>* problems) {
  for (int edge = 0; edge < boundary.size(); ++edge) {
    const int other = edgeMeeting(boundary, tree, edge);
    if (other >= 0) {
      const Point2 one = boundary.edge(edge).start + boundary.origin(),
                   two = boundary.edge(other).start + boundary.origin();
      std::ostringstream text;
      text << "the polygon crosses or touches itself: the edges that begin at (" << one.u << ", " << one.v << ") and ("
           << two.u << ", " << two.v << ") meet";
      problems->push_back(text.str());
      return;
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
