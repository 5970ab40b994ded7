#pragma once

#include "deformable_manipulation/control/features.h"

namespace deformable_manipulation {
namespace control {

//! How an object's points follow its held points.
struct Response {
  const double* derivatives;  //!< [A x P x 3 x 3] d point / d held point
  int agents;
  int points;
  const double* turns = nullptr;  //!< [A x P x 3 x 3] d point / d turn about the held point; null: not wanted
};

//! Features of a copy with the gradients of its quasi-static equilibrium.
//!
//! The distance of a locally nearest pair changes with its material point's motion along the normal:
//! g[m, a, j] = normal . dX_m / dp_aj, X_m = sum_k weights_k points_k.
//!
//! @param chosen the features
//! @param leader index of the leader
//! @param features the result
void takeResponseGradients(const ChosenFeatures& chosen, const Response& response, int leader, Features& features);

}  // namespace control
}  // namespace deformable_manipulation
