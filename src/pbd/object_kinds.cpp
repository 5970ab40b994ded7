#include "deformable_manipulation/pbd/object_kinds.h"

#include <utility>
#include <vector>

#include "deformable_manipulation/pbd/fabric.h"
#include "deformable_manipulation/pbd/rod.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

//! A maker of a kind with parameters of its own, all of whose mistakes are told at once.
template <typename Object, typename Parameters>
BodyMaker maker() {
  return [](const ParameterSection& object, const ParameterSection& simulation) {
    const Parameters parameters = Parameters::read(object, simulation);
    object.check().throwIfAny();
    return std::make_unique<Object>(parameters);
  };
}

}  // namespace

const std::map<std::string, BodyMaker>& bodyMakers() {
  static const std::map<std::string, BodyMaker> makers = {
      {"fabric", maker<Fabric, FabricParameters>()},
      {"rod", maker<Rod, RodParameters>()},
  };
  return makers;
}

std::unique_ptr<Body> makeBody(const ParameterSection& object, const ParameterSection& simulation) {
  std::vector<std::pair<std::string, const BodyMaker*>> choices;
  for (const auto& [kind, maker] : bodyMakers()) {
    choices.emplace_back(kind, &maker);
  }
  const BodyMaker* maker = object.choice<const BodyMaker*>("type", choices);
  object.check().throwIfAny();
  return (*maker)(object, simulation);
}

}  // namespace pbd
}  // namespace deformable_manipulation
