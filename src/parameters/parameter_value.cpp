#include "deformable_manipulation/parameters/parameter_value.h"

#include <sstream>

namespace deformable_manipulation {

const ParameterValue& ParameterValue::operator[](const std::string& key) const {
  static const ParameterValue missing;
  const auto* mapping = as<Mapping>();
  if (mapping == nullptr) {
    return missing;
  }
  const auto found = mapping->find(key);
  return found == mapping->end() ? missing : found->second;
}

std::string ParameterValue::description() const {
  if (const auto* number = as<double>()) {
    std::ostringstream stream;
    stream << *number;
    return stream.str();
  }
  if (const auto* flag = as<bool>()) {
    return *flag ? "true" : "false";
  }
  if (const auto* text = as<std::string>()) {
    return "'" + *text + "'";
  }
  if (const auto* list = as<List>()) {
    return "a list of " + std::to_string(list->size());
  }
  return as<Mapping>() != nullptr ? "a mapping" : "missing";
}

}  // namespace deformable_manipulation
