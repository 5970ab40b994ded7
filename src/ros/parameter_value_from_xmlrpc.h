#pragma once

#include <XmlRpcValue.h>

#include "deformable_manipulation/parameters/parameter_value.h"

namespace deformable_manipulation {

//! A value of the parameter server; what has no counterpart counts as missing.
ParameterValue toParameterValue(const XmlRpc::XmlRpcValue& value);

}  // namespace deformable_manipulation
