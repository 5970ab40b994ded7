#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "deformable_manipulation/parameters/parameter_section.h"
#include "deformable_manipulation/pbd/body.h"

namespace deformable_manipulation {
namespace pbd {

//! Makes an object from the sections `object` and `simulation` of the scenario.
struct BodyMaker {
  std::function<void(const ParameterSection& object, const ParameterSection& simulation)> note_mistakes;
  std::function<std::unique_ptr<Body>(const ParameterSection& object, const ParameterSection& simulation)> make;
};

//! How to make an object of each kind, by the word that stands at its `type`.
const std::map<std::string, BodyMaker>& bodyMakers();

//! Notes in the section's check what is missing or of another type for the kind that it says.
void noteMistakes(const ParameterSection& object, const ParameterSection& simulation);

//! Makes an object of the kind that its section says.
//! @throw ParameterError with every key that is missing, of another type or out of range
std::unique_ptr<Body> makeBody(const ParameterSection& object, const ParameterSection& simulation);

}  // namespace pbd
}  // namespace deformable_manipulation
