#include "scenario_reader.h"

#include <algorithm>
#include <cmath>

#include "deformable_manipulation/parameters/parameter_section.h"
#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/object_kinds.h"
#include "parameter_value_from_xmlrpc.h"

namespace deformable_manipulation {
namespace {

void readAgents(const ParameterSection& section, SimulatorScenario& scenario) {
  const ParameterSection agents = section.section("agents");
  for (const std::string& name : agents.keys()) {
    const ParameterSection agent = agents.section(name);
    const bool assistant = agent.choice<bool>("role", {{"leader", false}, {"assistant", true}});
    scenario.agents.push_back(
        {name, agent.integer("particle"),
         agent.choice<pbd::Hold>("hold", {{"clamped", pbd::Hold::CLAMPED}, {"pinned", pbd::Hold::PINNED}}),
         agent.pose("start", "orientation"), agent.integers("further_particles")});
    scenario.is_assistant.push_back(assistant);
    scenario.driven_by.push_back(
        agent.choice<DrivenBy>("driven_by", {{"command", DrivenBy::COMMAND}, {"pose", DrivenBy::POSE}}));
  }
}

}  // namespace

const std::string& SimulatorScenario::leader() const {
  return agents[std::find(is_assistant.begin(), is_assistant.end(), false) - is_assistant.begin()].name;
}

std::vector<pbd::Perturbation> perturbationsOf(const SimulatorScenario& scenario, const pbd::Vector3& size) {
  std::vector<pbd::Perturbation> perturbations;
  for (std::size_t agent = 0; agent < scenario.agents.size(); ++agent) {
    for (int axis = 0; scenario.is_assistant[agent] && axis < 3; ++axis) {
      const pbd::Vector3 displacement = size[axis] * pbd::Vector3::Unit(axis);
      perturbations.push_back({static_cast<int>(agent), displacement});
      if (scenario.central) {
        perturbations.push_back({static_cast<int>(agent), -displacement});
      }
    }
  }
  return perturbations;
}

std::unique_ptr<pbd::Body> makeBody(const SimulatorScenario& scenario) {
  pbd::ParameterCheck check;
  return pbd::makeBody({scenario.object, "object", check}, {scenario.simulation, "simulation", check});
}

SimulatorScenario readScenario(const XmlRpc::XmlRpcValue& value) {
  pbd::ParameterCheck check;
  SimulatorScenario scenario;
  const ParameterValue plain = toParameterValue(value);
  const ParameterSection root(plain, "", check);
  const ParameterSection simulation = root.section("simulation");
  const ParameterSection controller = root.section("controller");
  scenario.name = root.text("name");
  scenario.frame = root.text("frame");
  pbd::noteMistakes(root.section("object"), simulation);
  scenario.object = plain["object"];
  scenario.simulation = plain["simulation"];
  readAgents(root, scenario);
  scenario.perturbation = controller.vector<3>("perturbation");
  scenario.central = controller.choice<bool>("differences", {{"central", true}, {"forward", false}});
  scenario.exact_response = controller.choice<bool>("jacobian", {{"perturbed_copies", false}, {"equilibrium", true}});
  scenario.turns = controller.text("orientation") != "fixed";
  scenario.wrenches = controller.has("grip_force") || controller.has("grip_torque") || controller.has("tension") ||
                      controller.has("wrench_watch");
  scenario.clock.time_step = simulation.number("time_step");
  scenario.clock.substeps = simulation.integer("substeps");
  scenario.duration = simulation.number("duration");
  scenario.command_timeout = controller.number("timeout");
  scenario.pose_smoothing = controller.number("pose_smoothing");
  const double rate = controller.number("rate");
  scenario.clock.steps_per_cycle = static_cast<int>(std::lround(1.0 / (rate * scenario.clock.time_step)));
  if (root.has("correction")) {
    scenario.correction = pbd::CorrectionParameters::read(root.section("correction"));
  }
  check.throwIfAny();
  return scenario;
}

}  // namespace deformable_manipulation
