#pragma once

#include <cstddef>
#include <vector>

#include "deformable_manipulation/pbd/rod_parameters.h"

namespace deformable_manipulation {
namespace pbd {

//! How a rod is divided into segments, see docs/mathematics.md, "Grips of a length".
struct RodPieces {
  double usual;                       //!< [m] the rod's length over the number of segments
  bool equal;                         //!< whether all segments are as long as that
  std::vector<double> lengths;        //!< [N] m
  std::vector<double> ends;           //!< [N + 1] m, arc lengths from the first end of the rod
  std::vector<double> joint_lengths;  //!< [N - 1] m, of the rod that bends and twists in each joint

  //! [m] Arc length of a segment's centre.
  double centre(int i) const { return equal ? (i + 0.5) * usual : 0.5 * (ends[i] + ends[i + 1]); }

  //! [m] Length of rod from the centre of one segment to that of another, negative if that comes before it.
  double between(int from, int to) const { return equal ? (to - from) * usual : centre(to) - centre(from); }

  //! A segment's length over the usual one.
  double share(int i) const { return equal ? 1.0 : lengths[i] / usual; }

  //! [m] The shorter one of a joint's two segments.
  double shorterAt(int joint) const;

  //! The segment at an arc length [m].
  int at(double place) const;
};

//! @pre there are segments, and the grips are in the order of their segments
RodPieces rodPieces(const RodParameters& rod);

//! [m] What a segment must have left between two grips, or beyond one.
double shortestPiece(const RodParameters& rod);

}  // namespace pbd
}  // namespace deformable_manipulation
