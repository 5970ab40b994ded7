#pragma once

#include <vector>

#include "segment_depth.h"

namespace deformable_manipulation {
namespace distance {

//! Every place where the depth of segments inside a boundary can have a local maximum.
//!
//! These are where a piece of a segment is equally far from two edges that can be the nearest there, or nearest to
//! one. An edge counts as its line and its first corner: squared distances to both are quadratic in the parameter.
//! Pieces with many such edges are halved.
class SegmentExtrema {
 public:
  SegmentExtrema(const PlanarBoundary& boundary, const EdgeTree& tree) : boundary_(boundary), tree_(tree) {}

  //! Appends parameters on a part of a segment inside. Between two neighbouring ones the depth is monotonic where it
  //! is more than `floor` [m], to 1e-10 m.
  void find(const Segment2& segment, const InsidePart& part, double floor, std::vector<double>* parameters);

 private:
  //! A squared distance, (a t + b) t + c, at the fraction t of a piece.
  struct Parabola {
    double at(double t) const { return (a * t + b) * t + c; }
    double a, b, c;
  };

  double highestDepth(const Segment2& piece) const;
  void addSites(const Segment2& piece, const Segment2& edge);
  void addEquidistant(const Segment2& piece, double ceiling, double first, double scale,
                      std::vector<double>* parameters) const;

  const PlanarBoundary& boundary_;
  const EdgeTree& tree_;
  std::vector<InsidePart> pieces_;
  std::vector<int> near_;
  std::vector<Parabola> sites_;
};

}  // namespace distance
}  // namespace deformable_manipulation
