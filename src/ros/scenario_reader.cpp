#include "scenario_reader.h"

#include <cmath>

#include "deformable_manipulation/pbd/errors.h"

namespace deformable_manipulation {
namespace {

using XmlRpc::XmlRpcValue;

const char kRemedy[] = " (run check_scenario on the scenario file)";

//! A part of the scenario, read key by key; what is wrong is noted in the check.
class Section {
 public:
  Section(const XmlRpcValue& value, std::string path, pbd::ParameterCheck& check)
      : value_(value), path_(std::move(path)), check_(check) {
    check_.require(valid(), path_, "not a mapping", std::string("a mapping") + kRemedy);
  }

  Section section(const std::string& key) const { return Section(at(key), pathOf(key), check_); }

  double number(const std::string& key) const { return toNumber(at(key), pathOf(key)); }

  int integer(const std::string& key) const {
    const double number = this->number(key);
    check_.require(number == std::floor(number), pathOf(key), number, "a whole number");
    return static_cast<int>(number);
  }

  std::string text(const std::string& key) const {
    XmlRpcValue value = at(key);
    if (value.getType() != XmlRpcValue::TypeString) {
      check_.require(false, pathOf(key), describe(value), std::string("a text") + kRemedy);
      return "";
    }
    return static_cast<std::string>(value);
  }

  template <int size>
  Eigen::Matrix<double, size, 1> vector(const std::string& key) const {
    XmlRpcValue value = at(key);
    Eigen::Matrix<double, size, 1> result = Eigen::Matrix<double, size, 1>::Zero();
    if (value.getType() != XmlRpcValue::TypeArray || value.size() != size) {
      check_.require(false, pathOf(key), describe(value), std::to_string(size) + " numbers" + kRemedy);
      return result;
    }
    for (int i = 0; i < size; ++i) {
      result[i] = toNumber(value[i], pathOf(key) + "." + std::to_string(i));
    }
    return result;
  }

  pbd::Pose pose(const std::string& position, const std::string& orientation) const {
    const Eigen::Vector4d q = vector<4>(orientation);
    return {vector<3>(position), pbd::Quaternion(q[3], q[0], q[1], q[2])};
  }

  //! The one of the choices whose name stands at the key.
  template <typename Value>
  Value choice(const std::string& key, const std::vector<std::pair<std::string, Value>>& choices) const {
    const std::string given = text(key);
    std::string allowed;
    for (const auto& choice : choices) {
      if (choice.first == given) {
        return choice.second;
      }
      allowed += (allowed.empty() ? "" : " or ") + choice.first;
    }
    check_.require(false, pathOf(key), "'" + given + "'", allowed);
    return choices.front().second;
  }

  //! Keys in the order of the mapping (alphabetic on the parameter server).
  std::vector<std::string> keys() const {
    std::vector<std::string> names;
    if (valid()) {
      XmlRpcValue copy = value_;
      for (auto& item : copy) {
        names.push_back(item.first);
      }
    }
    return names;
  }

 private:
  bool valid() const { return value_.getType() == XmlRpcValue::TypeStruct; }

  std::string pathOf(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  XmlRpcValue at(const std::string& key) const {
    return valid() && value_.hasMember(key) ? XmlRpcValue(value_[key]) : XmlRpcValue();
  }

  double toNumber(XmlRpcValue value, const std::string& path) const {
    if (value.getType() == XmlRpcValue::TypeDouble) {
      return static_cast<double>(value);
    }
    if (value.getType() == XmlRpcValue::TypeInt) {
      return static_cast<int>(value);
    }
    check_.require(false, path, describe(value), std::string("a number") + kRemedy);
    return 0.0;
  }

  static std::string describe(const XmlRpcValue& value) { return value.valid() ? value.toXml() : "missing"; }

  XmlRpcValue value_;
  std::string path_;
  pbd::ParameterCheck& check_;
};

pbd::RodParameters readRod(const Section& object, const Section& simulation) {
  pbd::RodParameters rod;
  object.choice<int>("type", {{"rod", 0}});
  rod.length = object.number("length");
  rod.radius = object.number("radius");
  rod.density = object.number("density");
  rod.segments = object.integer("segments");
  rod.young_modulus = object.number("young_modulus");
  rod.torsion_modulus = object.number("torsion_modulus");
  rod.stretch = object.choice<pbd::Stretch>("stretch",
                                            {{"zero", pbd::Stretch::ZERO}, {"from_moduli", pbd::Stretch::FROM_MODULI}});
  rod.damping = object.number("damping");
  rod.pose = object.section("pose").pose("position", "orientation");
  rod.gravity = simulation.vector<3>("gravity");
  rod.solver = simulation.choice<pbd::RodSolver>(
      "solver", {{"direct", pbd::RodSolver::DIRECT}, {"gauss_seidel", pbd::RodSolver::GAUSS_SEIDEL}});
  return rod;
}

//! Per assistant and axis a copy on one side, or one on each.
void addPerturbations(const Section& controller, SimulatorScenario& scenario) {
  const pbd::Vector3 size = controller.vector<3>("perturbation");
  const bool central = controller.choice<bool>("differences", {{"central", true}, {"forward", false}});
  for (std::size_t agent = 0; agent < scenario.agents.size(); ++agent) {
    for (int axis = 0; scenario.is_assistant[agent] && axis < 3; ++axis) {
      const pbd::Vector3 displacement = size[axis] * pbd::Vector3::Unit(axis);
      scenario.perturbations.push_back({static_cast<int>(agent), displacement});
      if (central) {
        scenario.perturbations.push_back({static_cast<int>(agent), -displacement});
      }
    }
  }
}

void readAgents(const Section& section, SimulatorScenario& scenario) {
  const Section agents = section.section("agents");
  for (const std::string& name : agents.keys()) {
    const Section agent = agents.section(name);
    const bool assistant = agent.choice<bool>("role", {{"leader", false}, {"assistant", true}});
    scenario.agents.push_back(
        {name, agent.integer("particle"),
         agent.choice<pbd::Hold>("hold", {{"clamped", pbd::Hold::CLAMPED}, {"pinned", pbd::Hold::PINNED}}),
         agent.pose("start", "orientation")});
    scenario.is_assistant.push_back(assistant);
    scenario.driven_by.push_back(
        agent.choice<DrivenBy>("driven_by", {{"command", DrivenBy::COMMAND}, {"pose", DrivenBy::POSE}}));
  }
}

}  // namespace

SimulatorScenario readScenario(const XmlRpcValue& value) {
  pbd::ParameterCheck check;
  SimulatorScenario scenario;
  const Section root(value, "", check);
  const Section simulation = root.section("simulation");
  const Section controller = root.section("controller");
  scenario.name = root.text("name");
  scenario.frame = root.text("frame");
  scenario.rod = readRod(root.section("object"), simulation);
  readAgents(root, scenario);
  addPerturbations(controller, scenario);
  scenario.exact_response = controller.choice<bool>("jacobian", {{"perturbed_copies", false}, {"equilibrium", true}});
  scenario.clock.time_step = simulation.number("time_step");
  scenario.clock.substeps = simulation.integer("substeps");
  scenario.duration = simulation.number("duration");
  scenario.command_timeout = controller.number("timeout");
  const double rate = controller.number("rate");
  scenario.clock.steps_per_cycle = static_cast<int>(std::lround(1.0 / (rate * scenario.clock.time_step)));
  check.throwIfAny();
  return scenario;
}

}  // namespace deformable_manipulation
