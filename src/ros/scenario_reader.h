#pragma once

#include <XmlRpcValue.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent_link.h"
#include "deformable_manipulation/parameters/parameter_value.h"
#include "deformable_manipulation/pbd/shape_correction.h"
#include "deformable_manipulation/pbd/simulation.h"

namespace deformable_manipulation {

//! What the simulator node takes from a checked scenario.
struct SimulatorScenario {
  std::string name;
  std::string frame;
  ParameterValue object;  // the sections of these names, for what is made of them
  ParameterValue simulation;
  std::vector<pbd::Agent> agents;
  std::vector<bool> is_assistant;                       // one per agent
  std::vector<DrivenBy> driven_by;                      // one per agent
  pbd::Vector3 perturbation;                            // [m] displacement of the assistants' copies per axis
  bool central;                                         // copies on both sides
  bool exact_response;                                  // the controllers want the exact response of the object
  bool turns;                                           // grips turn
  bool wrenches;                                        // and what it exerts on the agents
  std::optional<pbd::CorrectionParameters> correction;  // of the object by measured points
  pbd::Clock clock;
  double duration;         // s
  double command_timeout;  // s
  double pose_smoothing;   // s

  //! The leader's name.
  const std::string& leader() const;
};

//! Per assistant and axis a copy on one side, or one on each. @param size [m] of the displacement along each axis
std::vector<pbd::Perturbation> perturbationsOf(const SimulatorScenario& scenario, const pbd::Vector3& size);

//! The object that it describes. @throw pbd::ParameterError
std::unique_ptr<pbd::Body> makeBody(const SimulatorScenario& scenario);

//! Reads the parameter `scenario` as check_scenario --resolved writes it.
//! @throw pbd::ParameterError with every key that is missing or of the wrong type
SimulatorScenario readScenario(const XmlRpc::XmlRpcValue& scenario);

}  // namespace deformable_manipulation
