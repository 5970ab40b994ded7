// What substeps of a length cannot keep of a rod's material, in words.

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "deformable_manipulation/pbd/rod.h"
#include "rod_viscosity.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// The direct solver linearises bending in the rotations of the segments, which hinders them from spinning about their
// own axes: twist runs along the rod slower by about h sqrt(E I / G J). A driven rod of 1 m is off by 2 to 50 mm where
// that is more, by less than 1 mm where it is less.
constexpr double kTwistDelay = 0.08;  // s

constexpr double kTrueViscosity = 0.9;  // of that of the material

void describeTwist(const RodParameters& rod, double time_step, int substeps, std::ostream& text) {
  const double delay = time_step * std::sqrt(rod.bendingStiffness() / rod.torsionStiffness());
  if (rod.solver != RodSolver::DIRECT || delay <= kTwistDelay * substeps) {
    return;
  }
  text << "object.torsion_modulus: with " << substeps
       << " substeps a rod that twists so easily, E I / (G J) = " << rod.bendingStiffness() / rod.torsionStiffness()
       << ", turns in itself too slowly, and motions in space are wrong. simulation.substeps: "
       << static_cast<int>(std::ceil(delay / kTwistDelay)) << " suffices.";
}

void describeViscosity(const char* key, double own, double swept, double h, std::ostream& text) {
  if (swept >= kTrueViscosity * own) {
    return;
  }
  text << (text.tellp() > 0 ? "\n" : "") << "object." << key << ": the Gauss-Seidel solver damps like " << swept * h
       << " s instead of " << own * h
       << " s with these substeps. More simulation.substeps or simulation.solver: direct keep the true viscosity.";
}

}  // namespace

std::string Rod::softness(double time_step, int substeps) const {
  std::ostringstream text;
  text << std::setprecision(3);
  describeTwist(parameters_, time_step, substeps, text);
  if (parameters_.solver == RodSolver::GAUSS_SEIDEL) {
    const double h = time_step / substeps;
    const JointViscosity own = jointViscosity(parameters_, h);
    JointViscosity swept = own;  // where it is least
    for (int j = 0; j + 1 < parameters_.segments; ++j) {
      const JointViscosity here = sweptViscosity(parameters_, *pieces_, j, h);
      swept = {std::min(swept.bending, here.bending), std::min(swept.torsion, here.torsion)};
    }
    describeViscosity("bending_retardation_time", own.bending, swept.bending, h, text);
    describeViscosity("torsion_retardation_time", own.torsion, swept.torsion, h, text);
  }
  return text.str();
}

}  // namespace pbd
}  // namespace deformable_manipulation
