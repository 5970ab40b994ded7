#pragma once

#include <memory>
#include <variant>

#include "deformable_manipulation/pbd/body.h"
#include "deformable_manipulation/pbd/fabric_parameters.h"
#include "deformable_manipulation/pbd/rod_parameters.h"
#include "object_shape.h"
#include "scenario_section.h"

namespace deformable_manipulation {

//! What an object of any kind is made of.
using ObjectParameters = std::variant<pbd::RodParameters, pbd::FabricParameters>;

//! Reads the section `object`, of the kind that its type says.
ObjectParameters readObject(const ScenarioSection& object, const ScenarioSection& simulation);

//! @throw pbd::ParameterError
std::unique_ptr<pbd::Body> makeBody(const ObjectParameters& parameters);

ObjectShape shapeOf(const ObjectParameters& parameters);

}  // namespace deformable_manipulation
