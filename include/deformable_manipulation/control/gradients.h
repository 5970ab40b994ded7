#pragma once

#include <vector>

#include "deformable_manipulation/control/controller_parameters.h"
#include "deformable_manipulation/control/differences.h"
#include "deformable_manipulation/control/disturbance_observer.h"
#include "deformable_manipulation/control/response_gradients.h"

namespace deformable_manipulation {
namespace control {

//! The near features of an observation with their gradients, from wherever these are to come: from the perturbed
//! copies, or from the exact response where the observation has it.
class Gradients {
 public:
  explicit Gradients(const ControllerParameters& parameters);

  void setParameters(const ControllerParameters& parameters);

  //! Forgets all observations.
  void reset();

  //! Takes in the copies of an observation.
  void update(const ObservationView& observation) { differences_.update(observation); }

  //! Finds the features of the observation that was taken in last, with gradients and disturbances.
  //! @param velocities [A] m/s, measured ones of the held points
  void find(const ObservationView& observation, const std::vector<Vector3>& velocities);

  const Features& features() const { return features_; }

  //! They are from the exact response; false: from copies.
  bool exact() const { return exact_; }

  //! Whether those of an agent are known.
  bool known(int agent) const { return exact_ || differences_.known(agent); }

  //! How the object's points follow its held points, as far as the observation tells.
  //! @return [A x P x 3 x 3] valid until the next call
  const std::vector<double>& response(const ObservationView& observation);

 private:
  void take(const ObservationView& observation);

  Team team_;
  bool prefers_exact_;
  bool exact_ = false;
  Differences differences_;
  DisturbanceObserver disturbances_;
  Features features_;
  std::vector<double> response_;
};

}  // namespace control
}  // namespace deformable_manipulation
