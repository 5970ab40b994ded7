#include "rod_viscosity.h"

#include <algorithm>

namespace deformable_manipulation {
namespace pbd {
namespace {

//! @param stiffness  of a joint, times h^2
double swept(double viscosity, double stiffness, double inertia) {
  return std::max(0.0, std::min(viscosity, inertia / stiffness - 1.0));
}

}  // namespace

JointViscosity jointViscosity(const RodParameters& rod, double h) {
  return {rod.bending_retardation_time / h, rod.torsion_retardation_time / h};
}

JointViscosity sweptViscosity(const RodParameters& rod, const RodPieces& pieces, int joint, double h) {
  const JointViscosity own = jointViscosity(rod, h);
  const double h2_per_length = h * h / pieces.joint_lengths[joint];
  const double shorter = pieces.shorterAt(joint);
  const double axial = rod.axialInertia() * (shorter / pieces.usual);
  return {swept(own.bending, rod.bendingStiffness() * h2_per_length, rod.transverseInertia(shorter)),
          swept(own.torsion, rod.torsionStiffness() * h2_per_length, axial)};
}

}  // namespace pbd
}  // namespace deformable_manipulation
