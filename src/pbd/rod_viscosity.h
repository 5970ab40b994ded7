#pragma once

#include "rod_pieces.h"

namespace deformable_manipulation {
namespace pbd {

//! Retardation times of the joints, in substeps.
struct JointViscosity {
  double bending;
  double torsion;
};

//! As in the material.
JointViscosity jointViscosity(const RodParameters& rod, double h);

//! What a joint of the Gauss-Seidel solver takes of it. A joint that resists a rotation in a substep more than the
//! inertia of a segment has less viscosity: one sweep does not carry it from joint to joint, and would become unstable.
JointViscosity sweptViscosity(const RodParameters& rod, const RodPieces& pieces, int joint, double h);

}  // namespace pbd
}  // namespace deformable_manipulation
