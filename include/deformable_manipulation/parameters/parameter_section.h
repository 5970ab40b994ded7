#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deformable_manipulation/parameters/parameter_value.h"
#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {

//! A section of the resolved scenario, read key by key.
//!
//! Python has checked the scenario and filled in its defaults: ranges, units and defaults of all keys are declared
//! there, once. If a key is missing or has a wrong type nevertheless, the check notes it and a value of the right type
//! is returned, so that one pass finds every mistake.
//!
//! It refers to the value and the check; both must outlive it.
class ParameterSection {
 public:
  ParameterSection(const ParameterValue& value, std::string path, pbd::ParameterCheck& check);

  ParameterSection section(const std::string& key) const { return {value_[key], pathOf(key), check_}; }

  bool has(const std::string& key) const { return value_[key].as<std::monostate>() == nullptr; }

  double number(const std::string& key) const { return toNumber(value_[key], pathOf(key)); }
  std::optional<double> numberOrAuto(const std::string& key) const;  //!< none: `auto`
  int integer(const std::string& key) const;
  bool flag(const std::string& key) const;
  std::string text(const std::string& key) const;

  template <int size>
  Eigen::Matrix<double, size, 1> vector(const std::string& key) const {
    return toVector<size>(value_[key], pathOf(key));
  }

  pbd::Pose pose(const std::string& position, const std::string& orientation) const;

  std::vector<std::string> texts(const std::string& key) const;
  std::vector<double> numbers(const std::string& key) const;
  std::vector<int> integers(const std::string& key) const;
  std::vector<pbd::Vector3> vectors(const std::string& key) const;
  std::vector<ParameterSection> sections(const std::string& key) const;

  //! A list of rows of equal length.
  Eigen::MatrixXd matrix(const std::string& key) const;

  //! The choice that the key names.
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

  //! Keys in alphabetic order.
  std::vector<std::string> keys() const;

  const ParameterValue& value() const { return value_; }
  std::string pathOf(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  pbd::ParameterCheck& check() const { return check_; }

 private:
  double toNumber(const ParameterValue& value, const std::string& path) const;

  template <int size>
  Eigen::Matrix<double, size, 1> toVector(const ParameterValue& value, const std::string& path) const {
    Eigen::Matrix<double, size, 1> result = Eigen::Matrix<double, size, 1>::Zero();
    const auto* list = value.as<ParameterValue::List>();
    if (list == nullptr || list->size() != static_cast<std::size_t>(size)) {
      refuse(value, path, std::to_string(size) + " numbers");
      return result;
    }
    for (int i = 0; i < size; ++i) {
      result[i] = toNumber((*list)[i], path + "." + std::to_string(i));
    }
    return result;
  }

  //! The items of a list. If it is not a list: no items, and the problem is noted.
  const ParameterValue::List& items(const std::string& key, const std::string& allowed) const;

  void refuse(const ParameterValue& value, const std::string& path, const std::string& allowed) const;

  const ParameterValue& value_;
  std::string path_;
  pbd::ParameterCheck& check_;
};

}  // namespace deformable_manipulation
