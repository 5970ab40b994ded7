#pragma once

#include "deformable_manipulation/control/features.h"

namespace deformable_manipulation {
namespace control {

//! Features of the object itself with the gradients of its quasi-static equilibrium.
//!
//! The distance of a locally nearest pair changes with its material point's motion along the normal:
//! g[m, a, j] = normal . dX_m / dp_aj, X_m = sum_k weights_k points_k.
//!
//! @param observation with sensitivities
//! @param leader index of the leader
//! @param nearest_only the feature of the minimum alone, if there is one
//! @param features the result
void takeResponseGradients(const ObservationView& observation, int leader, bool nearest_only, Features& features);

}  // namespace control
}  // namespace deformable_manipulation
