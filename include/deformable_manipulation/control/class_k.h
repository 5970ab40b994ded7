#pragma once

#include <string>

#include "deformable_manipulation/parameters/parameter_section.h"

namespace deformable_manipulation {
namespace control {

//! Extended class K-infinity function of two slopes (paper, section VI): how fast a barrier may be approached.
//!
//! The first slope says how fast h may shrink while safe, the second how fast a violation is corrected.
class PiecewiseLinearClassK {
 public:
  //! @param above, below [1/s] slopes for h >= 0 and for h < 0
  //! @throw std::invalid_argument if a slope is not a positive finite number
  PiecewiseLinearClassK(double above, double below);

  //! Reads [slope for h >= 0, slope for h < 0] at a key.
  static PiecewiseLinearClassK read(const ParameterSection& section, const std::string& key);

  //! alpha(h) [unit of h per second].
  double operator()(double h) const { return (h >= 0.0 ? above_ : below_) * h; }

 private:
  double above_;
  double below_;
};

}  // namespace control
}  // namespace deformable_manipulation
