#pragma once

#include <vector>

#include "rod_pieces.h"

namespace deformable_manipulation {
namespace pbd {

//! The masses of a rod's segments with the point masses that they carry, each where it is in its segment
//! (docs/mathematics.md, "Mass at points").
struct SegmentMasses {
  std::vector<double> relative;  //!< [N] mass over that of a usual segment alone
  std::vector<double> before;    //!< [N + 1] sums of them, from the first segment: before[i] without that of segment i
  std::vector<double> moment;    //!< [N] kg m, of masses off the centre, along the tangent
  std::vector<double> inertia;   //!< [N] kg m^2 across the axis, about the centre, beyond that of a usual segment alone
};

SegmentMasses segmentMasses(const RodParameters& rod, const RodPieces& pieces);

}  // namespace pbd
}  // namespace deformable_manipulation
