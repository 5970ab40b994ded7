#pragma once

#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "deformable_manipulation/pbd/rod_parameters.h"
#include "natural_shape.h"
#include "rod_pieces.h"

namespace deformable_manipulation {
namespace pbd {

//! A first guess of a held rod's shape, to be settled: catenaries between the held segments, or the natural shape where
//! it leads from one to the next, and the natural shape beyond the first and the last of them.
//! @return the poses of the segments, the held ones at their own
std::vector<Pose> layOutRod(const RodParameters& rod, const RodPieces& pieces, const NaturalJoints& natural,
                            const std::vector<HeldPoint>& holds);

}  // namespace pbd
}  // namespace deformable_manipulation
