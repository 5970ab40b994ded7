#include "parameter_value_from_xmlrpc.h"

#include <string>
#include <utility>

namespace deformable_manipulation {

using XmlRpc::XmlRpcValue;

ParameterValue toParameterValue(const XmlRpcValue& value) {
  XmlRpcValue copy = value;  // its contents cannot be read otherwise
  switch (copy.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(copy);
    case XmlRpcValue::TypeInt:
      return static_cast<int>(copy);
    case XmlRpcValue::TypeDouble:
      return static_cast<double>(copy);
    case XmlRpcValue::TypeString:
      return static_cast<std::string>(copy);
    case XmlRpcValue::TypeArray: {
      ParameterValue::List list;
      for (int i = 0; i < value.size(); ++i) {
        list.push_back(toParameterValue(value[i]));
      }
      return list;
    }
    case XmlRpcValue::TypeStruct: {
      ParameterValue::Mapping mapping;
      for (auto& item : copy) {
        mapping.emplace(item.first, toParameterValue(item.second));
      }
      return mapping;
    }
    default:
      return {};
  }
}

}  // namespace deformable_manipulation
