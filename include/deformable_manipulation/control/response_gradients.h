#pragma once

#include "deformable_manipulation/control/features.h"

namespace deformable_manipulation {
namespace control {

//! How an object's points follow its held points.
struct Response {
  const double* derivatives;  //!< [A x P x 3 x 3] d point / d held point
  int agents;
  int points;
};

//! Features of a copy with the gradients of its quasi-static equilibrium.
//!
//! The distance of a locally nearest pair changes with its material point's motion along the normal:
//! g[m, a, j] = normal . dX_m / dp_aj, X_m = sum_k weights_k points_k.
//!
//! @param chosen the features
//! @param leader index of the leader
<<<<<<< HEAD
//! @param features what is filled
void takeResponseGradients(const ChosenFeatures& chosen, const Response& response, int leader, Features& features);
=======
//! @param nearest_only the feature of the minimum alone, if there is one
//! @param features the result
void takeResponseGradients(const ObservationView& observation, int leader, bool nearest_only, Features& features);
>>>>>>> c75c69061654980d65981bb05228244ef398b8e5

}  // namespace control
}  // namespace deformable_manipulation
