#pragma once

#include <XmlRpcValue.h>

#include <string>
#include <utility>
#include <vector>

#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {

//! A part of the scenario on the parameter server, read key by key; what is wrong is noted in the check.
class ScenarioSection {
 public:
  ScenarioSection(const XmlRpc::XmlRpcValue& value, std::string path, pbd::ParameterCheck& check);

  ScenarioSection section(const std::string& key) const { return ScenarioSection(at(key), pathOf(key), check_); }

  double number(const std::string& key) const { return toNumber(at(key), pathOf(key)); }

  int integer(const std::string& key) const;

  std::string text(const std::string& key) const;

  template <int size>
  Eigen::Matrix<double, size, 1> vector(const std::string& key) const {
    return toVector<size>(at(key), pathOf(key));
  }

  pbd::Pose pose(const std::string& position, const std::string& orientation) const;

  //! A list of vectors.
  std::vector<pbd::Vector3> vectors(const std::string& key) const;

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
  std::vector<std::string> keys() const;

 private:
  bool valid() const { return value_.getType() == XmlRpc::XmlRpcValue::TypeStruct; }

  std::string pathOf(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  XmlRpc::XmlRpcValue at(const std::string& key) const;

  double toNumber(XmlRpc::XmlRpcValue value, const std::string& path) const;

  template <int size>
  Eigen::Matrix<double, size, 1> toVector(const XmlRpc::XmlRpcValue& value, const std::string& path) const {
    Eigen::Matrix<double, size, 1> result = Eigen::Matrix<double, size, 1>::Zero();
    if (requireArray(value, path, size, std::to_string(size) + " numbers")) {
      for (int i = 0; i < size; ++i) {
        result[i] = toNumber(value[i], path + "." + std::to_string(i));
      }
    }
    return result;
  }

  //! Notes a problem unless the value is an array of so many items (-1: any number).
  bool requireArray(const XmlRpc::XmlRpcValue& value, const std::string& path, int size,
                    const std::string& allowed) const;

  XmlRpc::XmlRpcValue value_;
  std::string path_;
  pbd::ParameterCheck& check_;
};

}  // namespace deformable_manipulation
