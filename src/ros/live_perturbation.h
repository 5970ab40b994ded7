#pragma once

#include <deformable_manipulation/SimulatorConfig.h>
#include <dynamic_reconfigure/server.h>

#include "deformable_manipulation/pbd/simulation.h"
#include "scenario_reader.h"

namespace deformable_manipulation {

//! The parameters as they are asked for: the server does not clamp them to their ranges, so that they can be refused.
struct UnclampedSimulatorConfig : SimulatorConfig {
  UnclampedSimulatorConfig() = default;
  UnclampedSimulatorConfig(const SimulatorConfig& config) : SimulatorConfig(config) {}  // NOLINT(*-explicit-*)
  void __clamp__() {}  // NOLINT(bugprone-reserved-identifier): what the server calls
};

//! The sizes of the assistants' perturbations, changed while the simulation runs (dynamic_reconfigure).
class LivePerturbation {
 public:
  //! Begins with the scenario's sizes; keeps references to both.
  LivePerturbation(const SimulatorScenario& scenario, pbd::Simulation& simulation);

 private:
  void change(UnclampedSimulatorConfig& config, std::uint32_t level);
  void apply(const pbd::Vector3& size);
  void checkRanges(const pbd::Vector3& size) const;
  void showRanges();

  const SimulatorScenario& scenario_;
  pbd::Simulation& simulation_;
  pbd::Vector3 size_;          // m
  pbd::Vector3 least_, most_;  // m; the ends of the sliders
  dynamic_reconfigure::Server<UnclampedSimulatorConfig> server_;
};

}  // namespace deformable_manipulation
