#pragma once

#include <vector>

#include "deformable_manipulation/pbd/rod_parameters.h"

namespace deformable_manipulation {
namespace pbd {

//! How the segments of a rod lie to each other without load, joint by joint; everything is empty for a straight rod.
//! See docs/mathematics.md, "Natural shape".
struct NaturalJoints {
  std::vector<Quaternion> turns;  //!< [N - 1] orientation of the second segment in the frame of the first one
  std::vector<double> ahead;      //!< [(N - 1) x 3] tangent of the second segment in the frame of the first one
  std::vector<double> behind;     //!< [(N - 1) x 3] tangent of the first segment in the frame of the second one
  std::vector<double> twist;      //!< [N - 1] rad

  bool empty() const { return turns.empty(); }
};

//! @pre the parameters have been checked
NaturalJoints naturalJoints(const RodParameters& rod);

}  // namespace pbd
}  // namespace deformable_manipulation
