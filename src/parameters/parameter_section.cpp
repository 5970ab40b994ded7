#include "deformable_manipulation/parameters/parameter_section.h"

#include <cmath>

namespace deformable_manipulation {
namespace {

const char REMEDY[] = " (run check_scenario on the scenario file)";

}  // namespace

ParameterSection::ParameterSection(const ParameterValue& value, std::string path, pbd::ParameterCheck& check)
    : value_(value), path_(std::move(path)), check_(check) {
  if (value_.as<ParameterValue::Mapping>() == nullptr) {
    refuse(value_, path_, "a mapping");
  }
}

std::optional<double> ParameterSection::numberOrAuto(const std::string& key) const {
  const auto* text = value_[key].as<std::string>();
  return text != nullptr && *text == "auto" ? std::nullopt : std::optional<double>(number(key));
}

int ParameterSection::integer(const std::string& key) const {
  const double number = this->number(key);
  check_.require(number == std::floor(number), pathOf(key), number, "a whole number");
  return static_cast<int>(number);
}

bool ParameterSection::flag(const std::string& key) const {
  const auto* flag = value_[key].as<bool>();
  if (flag == nullptr) {
    refuse(value_[key], pathOf(key), "true or false");
  }
  return flag != nullptr && *flag;
}

std::string ParameterSection::text(const std::string& key) const {
  const auto* text = value_[key].as<std::string>();
  if (text == nullptr) {
    refuse(value_[key], pathOf(key), "a text");
    return "";
  }
  return *text;
}

pbd::Pose ParameterSection::pose(const std::string& position, const std::string& orientation) const {
  const Eigen::Vector4d q = vector<4>(orientation);
  return {vector<3>(position), pbd::Quaternion(q[3], q[0], q[1], q[2])};
}

std::vector<std::string> ParameterSection::texts(const std::string& key) const {
  std::vector<std::string> result;
  for (const ParameterValue& item : items(key, "a list of texts")) {
    if (const auto* text = item.as<std::string>()) {
      result.push_back(*text);
    } else {
      refuse(item, pathOf(key), "a list of texts");
    }
  }
  return result;
}

std::vector<double> ParameterSection::numbers(const std::string& key) const {
  std::vector<double> result;
  for (const ParameterValue& item : items(key, "a list of numbers")) {
    result.push_back(toNumber(item, pathOf(key)));
  }
  return result;
}

std::vector<int> ParameterSection::integers(const std::string& key) const {
  std::vector<int> result;
  for (const ParameterValue& item : items(key, "a list of whole numbers")) {
    result.push_back(static_cast<int>(toNumber(item, pathOf(key))));
  }
  return result;
}

std::vector<pbd::Vector3> ParameterSection::vectors(const std::string& key) const {
  std::vector<pbd::Vector3> result;
  const ParameterValue::List& list = items(key, "a list of 3 numbers each");
  result.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    result.push_back(toVector<3>(list[i], pathOf(key) + "." + std::to_string(i)));
  }
  return result;
}

std::vector<ParameterSection> ParameterSection::sections(const std::string& key) const {
  std::vector<ParameterSection> result;
  const ParameterValue::List& list = items(key, "a list of mappings");
  for (std::size_t i = 0; i < list.size(); ++i) {
    result.emplace_back(list[i], pathOf(key) + "." + std::to_string(i), check_);
  }
  return result;
}

Eigen::MatrixXd ParameterSection::matrix(const std::string& key) const {
  const ParameterValue::List& list = items(key, "a list of rows of numbers");
  const auto* first = list.empty() ? nullptr : list.front().as<ParameterValue::List>();
  const auto columns = static_cast<Eigen::Index>(first != nullptr ? first->size() : 0);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(list.size()), columns);
  for (Eigen::Index row = 0; row < result.rows(); ++row) {
    const auto* numbers = list[row].as<ParameterValue::List>();
    if (numbers == nullptr || static_cast<Eigen::Index>(numbers->size()) != columns) {
      refuse(list[row], pathOf(key), "a list of rows of equal length");
      continue;
    }
    for (Eigen::Index column = 0; column < columns; ++column) {
      result(row, column) = toNumber((*numbers)[column], pathOf(key));
    }
  }
  return result;
}

std::vector<std::string> ParameterSection::keys() const {
  std::vector<std::string> names;
  if (const auto* mapping = value_.as<ParameterValue::Mapping>()) {
    for (const auto& item : *mapping) {
      names.push_back(item.first);
    }
  }
  return names;
}

double ParameterSection::toNumber(const ParameterValue& value, const std::string& path) const {
  if (const auto* number = value.as<double>()) {
    return *number;
  }
  refuse(value, path, "a number");
  return 0.0;
}

const ParameterValue::List& ParameterSection::items(const std::string& key, const std::string& allowed) const {
  static const ParameterValue::List none;
  const auto* list = value_[key].as<ParameterValue::List>();
  if (list == nullptr) {
    refuse(value_[key], pathOf(key), allowed);
    return none;
  }
  return *list;
}

void ParameterSection::refuse(const ParameterValue& value, const std::string& path, const std::string& allowed) const {
  check_.require(false, path, value.description(), allowed + REMEDY);
}

}  // namespace deformable_manipulation
