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
  return {
      [](const ParameterSection& object, const ParameterSection& simulation) { Parameters::read(object, simulation); },
      [](const ParameterSection& object, const ParameterSection& simulation) {
        const Parameters parameters = Parameters::read(object, simulation);
        object.check().throwIfAny();
        return std::make_unique<Object>(parameters);
      }};
}

//! The maker of the kind that a section says; of another one, and a problem noted, where it says none.
const BodyMaker& makerOf(const ParameterSection& object) {
  std::vector<std::pair<std::string, const BodyMaker*>> choices;
  for (const auto& [kind, maker] : bodyMakers()) {
    choices.emplace_back(kind, &maker);
  }
  return *object.choice<const BodyMaker*>("type", choices);
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
  const BodyMaker& maker = makerOf(object);
  object.check().throwIfAny();
  return maker.make(object, simulation);
}

void noteMistakes(const ParameterSection& object, const ParameterSection& simulation) {
  makerOf(object).note_mistakes(object, simulation);
}

}  // namespace pbd
}  // namespace deformable_manipulation
