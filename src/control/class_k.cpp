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
    text << "slopes: (" << above << ", " << below << "); they must be two positive finite numbers [1/s]";
    throw std::invalid_argument(text.str());
  }
}

PiecewiseLinearClassK PiecewiseLinearClassK::read(const ParameterSection& section, const std::string& key) {
  const Eigen::Vector2d slopes = section.vector<2>(key);
  if (!isSlope(slopes[0]) || !isSlope(slopes[1])) {
    section.check().require(false, section.pathOf(key), slopes.minCoeff(), "two positive finite numbers [1/s]");
    return {1.0, 1.0};
  }
  return {slopes[0], slopes[1]};
}

}  // namespace control
}  // namespace deformable_manipulation
