#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "deformable_manipulation/parameters/parameter_section.h"
#include "object_drawing.h"

namespace deformable_manipulation {

//! What ROS has to know of a kind of object.
struct ObjectKind {
  std::uint8_t type;  //!< the constant of ObjectState
  std::function<std::unique_ptr<ObjectDrawing>(const ParameterSection& object)> make_drawing;
};

//! Of the kind that a section or a body says.
//! @throw std::out_of_range if there is none
const ObjectKind& objectKind(const std::string& kind);

//! How the object of a section `object` looks.
//! @throw pbd::ParameterError
std::unique_ptr<ObjectDrawing> makeDrawing(const ParameterValue& object);

}  // namespace deformable_manipulation
