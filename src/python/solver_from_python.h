#pragma once

#include <pybind11/pybind11.h>

#include "deformable_manipulation/control/safety_filter.h"

//! A Python function of P (n, n), q (n,), A (m, n), b (m,) that gives x (n,) or None, as a solver.
deformable_manipulation::control::QpSolver solverFromPython(const pybind11::object& solver);
