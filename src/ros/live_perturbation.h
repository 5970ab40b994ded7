#pragma once

#include <deformable_manipulation/SimulatorConfig.h>
#include <dynamic_reconfigure/server.h>

#include "deformable_manipulation/pbd/simulation.h"
#include "scenario_reader.h"

namespace deformable_manipulation {

//! The sizes of the assistants' perturbations, changed while the simulation runs (dynamic_reconfigure).
class LivePerturbation {
 public:
  //! Begins with the scenario's sizes; keeps references to both.
  LivePerturbation(const SimulatorScenario& scenario, pbd::Simulation& simulation);

 private:
  void change(SimulatorConfig& config, std::uint32_t level);
  void apply(const pbd::Vector3& size);

  const SimulatorScenario& scenario_;
  pbd::Simulation& simulation_;
  pbd::Vector3 size_;  // m
  dynamic_reconfigure::Server<SimulatorConfig> server_;
};

}  // namespace deformable_manipulation
