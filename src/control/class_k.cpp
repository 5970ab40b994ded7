#include "deformable_manipulation/control/class_k.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace deformable_manipulation {
namespace control {

namespace {

bool isSlope(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

PiecewiseLinearClassK::PiecewiseLinearClassK(double above, double below) : above_(above), below_(below) {
  if (!isSlope(above) || !isSlope(below)) {
    std::ostringstream text;
    text << "slopes: (" << above << ", " << below << "), allowed are two positive finite numbers [1/s]";
    throw std::invalid_argument(text.str());
  }
}

}  // namespace control
}  // namespace deformable_manipulation
