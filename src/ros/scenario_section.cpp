#include "scenario_section.h"

#include <cmath>

namespace deformable_manipulation {
namespace {

using XmlRpc::XmlRpcValue;

const char kRemedy[] = " (run check_scenario on the scenario file)";

std::string describe(const XmlRpcValue& value) { return value.valid() ? value.toXml() : "missing"; }

}  // namespace

ScenarioSection::ScenarioSection(const XmlRpcValue& value, std::string path, pbd::ParameterCheck& check)
    : value_(value), path_(std::move(path)), check_(check) {
  check_.require(valid(), path_, "not a mapping", std::string("a mapping") + kRemedy);
}

int ScenarioSection::integer(const std::string& key) const {
  const double number = this->number(key);
  check_.require(number == std::floor(number), pathOf(key), number, "a whole number");
  return static_cast<int>(number);
}

std::string ScenarioSection::text(const std::string& key) const {
  XmlRpcValue value = at(key);
  if (value.getType() != XmlRpcValue::TypeString) {
    check_.require(false, pathOf(key), describe(value), std::string("a text") + kRemedy);
    return "";
  }
  return static_cast<std::string>(value);
}

pbd::Pose ScenarioSection::pose(const std::string& position, const std::string& orientation) const {
  const Eigen::Vector4d q = vector<4>(orientation);
  return {vector<3>(position), pbd::Quaternion(q[3], q[0], q[1], q[2])};
}

std::vector<pbd::Vector3> ScenarioSection::vectors(const std::string& key) const {
  const XmlRpcValue value = at(key);
  std::vector<pbd::Vector3> result;
  if (requireArray(value, pathOf(key), -1, "a list of 3 numbers each")) {
    result.reserve(value.size());
    for (int i = 0; i < value.size(); ++i) {
      result.push_back(toVector<3>(value[i], pathOf(key) + "." + std::to_string(i)));
    }
  }
  return result;
}

std::vector<std::string> ScenarioSection::keys() const {
  std::vector<std::string> names;
  if (valid()) {
    XmlRpcValue copy = value_;
    for (auto& item : copy) {
      names.push_back(item.first);
    }
  }
  return names;
}

XmlRpcValue ScenarioSection::at(const std::string& key) const {
  return valid() && value_.hasMember(key) ? XmlRpcValue(value_[key]) : XmlRpcValue();
}

double ScenarioSection::toNumber(XmlRpcValue value, const std::string& path) const {
  if (value.getType() == XmlRpcValue::TypeDouble) {
    return static_cast<double>(value);
  }
  if (value.getType() == XmlRpcValue::TypeInt) {
    return static_cast<int>(value);
  }
  check_.require(false, path, describe(value), std::string("a number") + kRemedy);
  return 0.0;
}

bool ScenarioSection::requireArray(const XmlRpcValue& value, const std::string& path, int size,
                                   const std::string& allowed) const {
  const bool is_array = value.getType() == XmlRpcValue::TypeArray && (size < 0 || value.size() == size);
  if (!is_array) {
    check_.require(false, path, describe(value), allowed + kRemedy);
  }
  return is_array;
}

}  // namespace deformable_manipulation
