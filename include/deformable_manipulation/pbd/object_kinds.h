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

//! The functions that make an object of each kind, by its `type`.
const std::map<std::string, BodyMaker>& bodyMakers();

//! Notes in the section's check what is missing or has a wrong type for the section's kind.
void noteMistakes(const ParameterSection& object, const ParameterSection& simulation);

//! Makes an object of its section's kind.
//! @throw ParameterError with every key that is missing, of another type or out of range
std::unique_ptr<Body> makeBody(const ParameterSection& object, const ParameterSection& simulation);

}  // namespace pbd
}  // namespace deformable_manipulation
