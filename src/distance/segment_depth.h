#pragma once

#include <vector>

#include "boundary_search.h"

namespace deformable_manipulation {
namespace distance {

//! A part of a segment inside the boundary, between two of its parameters.
struct InsidePart {
  double first, last;
};

//! A segment's point inside the boundary.
struct DeepPoint2 {
  double parameter;
  double depth;  //!< [m] distance to the boundary
  int edge;      //!< the nearest
};

//! How deep segments are inside a boundary.
//!
//! The depth of a point inside is its distance to the boundary, the smallest of its distances to the edges. Each of
//! these is convex along a segment. Hence, if edge a is the nearest at the one end of a piece and edge b at the
//! other, nowhere on it is the depth greater than at its ends and at a point that is equally far from a and b. If
//! the depth there is that distance, the piece is done; otherwise a third edge is nearer, and the two halves are
//! searched in the same way.
class SegmentDepth {
 public:
  SegmentDepth(const PlanarBoundary& boundary, const EdgeTree& tree) : boundary_(boundary), tree_(tree) {}

  //! The parts of a segment inside, in order. Valid until the next call.
  const std::vector<InsidePart>& partsInside(const Segment2& segment, int guess);

  //! The deepest point of a part, exactly, if its depth is at least `floor` [m]; depth -infinity otherwise.
  //! @param level points that are less deep by at most this [m] ...
  //! @param stretch ... are added here, or null
  DeepPoint2 deepest(const Segment2& segment, const InsidePart& part, double floor, double level = 0.0,
                     Stretch* stretch = nullptr);

 private:
  struct Piece {
    DeepPoint2 first, last;
  };

  DeepPoint2 pointAt(const Segment2& segment, double parameter, int guess) const;
  void divide(const Segment2& segment, const Piece& piece, double floor);

  const PlanarBoundary& boundary_;
  const EdgeTree& tree_;
  std::vector<double> cuts_;
  std::vector<InsidePart> parts_;
  std::vector<Piece> pieces_;
  std::vector<DeepPoint2> evaluated_;
};

}  // namespace distance
}  // namespace deformable_manipulation
