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
using BodyMaker =
    std::function<std::unique_ptr<Body>(const ParameterSection& object, const ParameterSection& simulation)>;

//! How to make an object of each kind, by the word that stands at its `type`.
const std::map<std::string, BodyMaker>& bodyMakers();

//! Makes an object of the kind that its section says.
//! @throw ParameterError with every key that is missing, of another type or out of range
std::unique_ptr<Body> makeBody(const ParameterSection& object, const ParameterSection& simulation);

}  // namespace pbd
}  // namespace deformable_manipulation
