#pragma once

#include <vector>

#include "deformable_manipulation/pbd/rod_parameters.h"

namespace deformable_manipulation {
namespace pbd {

//! The masses of a rod's segments with the point masses that they carry, each where it is in its segment
//! (docs/mathematics.md, "Mass at points").
struct SegmentMasses {
  std::vector<double> relative;  //!< [N] mass over that of the segment alone
  std::vector<double> before;    //!< [N + 1] sums of them, from the first segment: before[i] without that of segment i
  std::vector<double> moment;    //!< [N] kg m, of masses off the centre, along the tangent
  std::vector<double> inertia;   //!< [N] kg m^2, what these add across the axis, about the centre
};

SegmentMasses segmentMasses(const RodParameters& rod);

}  // namespace pbd
}  // namespace deformable_manipulation
