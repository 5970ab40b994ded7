#include "deformable_manipulation/pbd/response.h"

namespace deformable_manipulation {
namespace pbd {

const char* describe(ResponseStatus status) {
  switch (status) {
    case ResponseStatus::VALID:
      return "valid";
    case ResponseStatus::NOT_AVAILABLE:
      return "this kind of object has no exact response";
    case ResponseStatus::NOT_HELD:
      return "nothing holds the object";
    case ResponseStatus::OUT_OF_REACH:
      return "two holds are farther apart than the object reaches";
    case ResponseStatus::NOT_CONVERGED:
      return "no equilibrium was found near the present shape";
    case ResponseStatus::UNSTABLE:
      return "the equilibrium is not stable";
    case ResponseStatus::OTHER_SHAPE:
      return "the object is far from its equilibrium";
  }
  return "unknown";
}

}  // namespace pbd
}  // namespace deformable_manipulation
