#include "deformable_manipulation/pbd/rest.h"

namespace deformable_manipulation {
namespace pbd {

const char* name(Rest rest) {
  switch (rest) {
    case Rest::STABLE:
      return "stable";
    case Rest::MOVING:
      return "moving";
    case Rest::BALANCED:
      return "balanced";
  }
  return "unknown";
}

const char* describe(Rest rest) {
  switch (rest) {
    case Rest::STABLE:
      return "";
    case Rest::MOVING:
      return "The object still moved after a minute of settling. It starts as it is. More simulation.substeps "
             "help.";
    case Rest::BALANCED:
      return "The object leaves every shape that it settles in when it is pushed a little. It may fall over or snap "
             "without warning. Let it hang, hold it at more points or give it more slack.";
  }
  return "unknown";
}

}  // namespace pbd
}  // namespace deformable_manipulation
