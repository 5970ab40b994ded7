#pragma once

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace deformable_manipulation {

//! A value of the resolved scenario, from the parameter server or from Python.
class ParameterValue {
 public:
  using List = std::vector<ParameterValue>;
  using Mapping = std::map<std::string, ParameterValue>;

  ParameterValue() = default;  //!< nothing: the key is missing
  ParameterValue(bool flag) : content_(flag) {}
  ParameterValue(double number) : content_(number) {}
  ParameterValue(int number) : content_(static_cast<double>(number)) {}
  ParameterValue(std::string text) : content_(std::move(text)) {}
  ParameterValue(const char* text) : content_(std::string(text)) {}
  ParameterValue(List list) : content_(std::move(list)) {}
  ParameterValue(Mapping mapping) : content_(std::move(mapping)) {}

  //! The content if it is of this type, else null.
  template <typename Content>
  const Content* as() const {
    return std::get_if<Content>(&content_);
  }

  //! The value of a key; a missing value if there is none.
  const ParameterValue& operator[](const std::string& key) const;

  //! What it is, in words, for messages.
  std::string description() const;

 private:
  std::variant<std::monostate, bool, double, std::string, List, Mapping> content_;
};

}  // namespace deformable_manipulation
