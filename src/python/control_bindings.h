#pragma once

#include <pybind11/pybind11.h>

void bindQuadraticProgram(pybind11::module_& module);
void bindBarriers(pybind11::module_& module);
void bindGradients(pybind11::module_& module);
void bindController(pybind11::module_& module);
