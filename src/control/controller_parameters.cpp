#include "deformable_manipulation/control/controller_parameters.h"

#include <algorithm>

namespace deformable_manipulation {
namespace control {
namespace {

Team readTeam(const ParameterSection& controller, const ParameterSection& team) {
  Team result;
  result.agents = team.integer("agents");
  result.leader = team.integer("leader");
  result.assistants = team.integers("assistants");
  result.commanded = team.integers("commanded");
  result.max_velocity = controller.number("max_velocity");
  result.formulation = Formulation::read(controller);
  result.turns = controller.text("orientation") != "fixed";
  result.max_angular_velocity = controller.number("max_angular_velocity");
  return result;
}

//! The numbers of the barriers in the order of their names.
Priority readPriority(const ParameterSection& controller, const std::vector<std::string>& barriers) {
  Priority priority;
  for (const std::string& name : controller.texts("priority")) {
    const auto found = std::find(barriers.begin(), barriers.end(), name);
    controller.check().require(found != barriers.end(), controller.pathOf("priority"), "'" + name + "'",
                               "the names of the barriers in use");
    priority.push_back(static_cast<int>(found - barriers.begin()));
  }
  return priority;
}

}  // namespace

HorizonParameters HorizonParameters::read(const ParameterSection& horizon) {
  return {horizon.number("length"),
          horizon.integer("nodes"),
          horizon.choice<ExpectedLeader>("leader", {{"fading", ExpectedLeader::FADING},
                                                    {"announced", ExpectedLeader::ANNOUNCED},
                                                    {"known", ExpectedLeader::KNOWN}}),
          horizon.number("leader_fade"),
          horizon.number("leader_doubt"),
          horizon.number("leader_memory"),
          horizon.number("obstacle_doubt"),
          horizon.vector<3>("weights")};
}

ControllerParameters ControllerParameters::read(const ParameterSection& controller, const ParameterSection& team) {
  ControllerParameters p;
  p.references = team.vectors("references");
  p.places = team.vectors("places");
  p.cycle_time = team.number("cycle_time");
  p.safety = team.flag("safety");
  p.gain = controller.number("gain");
  p.weights = controller.vector<3>("weights");
  p.max_velocity = controller.number("max_velocity");
  p.max_acceleration = controller.number("max_acceleration");
  p.max_jerk = controller.number("max_jerk");
  p.orientation = controller.choice<OrientationMode>(
      "orientation",
      {{"fixed", OrientationMode::FIXED}, {"follow", OrientationMode::FOLLOW}, {"free", OrientationMode::FREE}});
  p.turning_gain = controller.number("turning_gain");
  p.turning_weights = controller.vector<3>("turning_weights");
  p.max_angular_acceleration = controller.number("max_angular_acceleration");
  const Eigen::MatrixXd orientations = team.matrix("orientations");
  for (Eigen::Index agent = 0; agent < orientations.rows() && orientations.cols() == 4; ++agent) {
    p.orientations.push_back(pbd::Quaternion(Eigen::Vector4d(orientations.row(agent))).normalized());
  }
  team.check().require(static_cast<int>(p.orientations.size()) == team.integer("agents"), team.pathOf("orientations"),
                       static_cast<double>(p.orientations.size()), "a quaternion x, y, z, w per agent");
  p.smoothing = controller.number("smoothing");
  p.disturbance_filter = controller.number("disturbance_filter");
  p.timeout = controller.number("timeout");
  p.exact_gradients = controller.choice<bool>("jacobian", {{"equilibrium", true}, {"perturbed_copies", false}});
  p.horizon = HorizonParameters::read(controller.section("horizon"));
  p.team = readTeam(controller, team);
  p.own = team.integers("own");
  p.barriers = team.texts("barriers");
  p.priority = readPriority(controller, p.barriers);
  p.values = controller.value();
  return p;
}

}  // namespace control
}  // namespace deformable_manipulation
