#pragma once

#include <vector>

#include "deformable_manipulation/control/differences.h"
#include "deformable_manipulation/control/object_shape.h"
#include "deformable_manipulation/control/observation.h"

namespace deformable_manipulation {
namespace control {

//! Shape and reactions of the object in an observation, without their derivatives.
ObjectShape presentShape(const ObservationView& observation);

//! The same with the derivatives.
class ShapeObserver {
 public:
  //! @param exact from the response that the observation tells, else from its copies. The copies also stand in for a
  //! response of the wrenches that it does not tell
  //! @return valid until the next call, and as long as the observation is
  ObjectShape observe(const ObservationView& observation, const Differences& differences, bool exact);

 private:
  std::vector<double> response_;         // [A x P x 3 x 3]
  std::vector<double> wrench_response_;  // [A x 6 x A x 6]
};

}  // namespace control
}  // namespace deformable_manipulation
