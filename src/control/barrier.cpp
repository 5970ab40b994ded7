#include "deformable_manipulation/control/barrier.h"

#include <stdexcept>

namespace deformable_manipulation {
namespace control {

std::vector<std::unique_ptr<Barrier>> makeBarriers(const std::vector<std::string>& names,
                                                   const ParameterValue& controller, const Team& team) {
  pbd::ParameterCheck check;
  const ParameterSection section(controller, "controller", check);
  std::vector<std::unique_ptr<Barrier>> barriers;
  for (const std::string& name : names) {
    const auto maker = barrierMakers().find(name);
    if (maker == barrierMakers().end()) {
      throw std::invalid_argument("controller." + name + ": there is no barrier of this name");
    }
    barriers.push_back(maker->second(section.section(name), team));
  }
  check.throwIfAny();
  return barriers;
}

}  // namespace control
}  // namespace deformable_manipulation
