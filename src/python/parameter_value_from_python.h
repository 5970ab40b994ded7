#pragma once

#include <pybind11/pybind11.h>

#include "deformable_manipulation/parameters/parameter_value.h"

//! Flags, numbers, strings, lists, tuples, numpy's arrays and dicts of them. Raises TypeError for anything else.
deformable_manipulation::ParameterValue toParameterValue(const pybind11::handle& value);
