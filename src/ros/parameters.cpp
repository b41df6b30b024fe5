#include "parameters.h"

#include <XmlRpcValue.h>
#include <ros/console.h>

#include <sstream>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

/// A list of texts as one text with commas, such as the names of effects; of other lists their text.
OptionValue toValue(XmlRpc::XmlRpcValue& list) {
  std::ostringstream text;
  bool all_texts = true;
  for (int i = 0; i < list.size(); ++i) {
    list[i].write(text << (i == 0 ? "" : ", "));
    all_texts = all_texts && list[i].getType() == XmlRpc::XmlRpcValue::TypeString;
  }
  return all_texts ? OptionValue(text.str()) : UnusableList{'[' + text.str() + ']'};
}

void flatten(const std::string& name, XmlRpc::XmlRpcValue& value, OptionMap& result) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeStruct:
      for (auto& [key, nested] : value) flatten(name.empty() ? key : name + '/' + key, nested, result);
      break;
    case XmlRpc::XmlRpcValue::TypeBoolean: result[name] = static_cast<bool>(value); break;
    case XmlRpc::XmlRpcValue::TypeInt: result[name] = static_cast<int>(value); break;
    case XmlRpc::XmlRpcValue::TypeDouble: result[name] = static_cast<double>(value); break;
    case XmlRpc::XmlRpcValue::TypeString: result[name] = static_cast<std::string>(value); break;
    case XmlRpc::XmlRpcValue::TypeArray: result[name] = toValue(value); break;
    default: throw std::invalid_argument(name + " is a date or binary, must be true or false, a number or a text");
  }
}

}  // namespace

OptionMap readParameters(const ros::NodeHandle& private_node) {
  OptionMap result;
  XmlRpc::XmlRpcValue value;
  if (private_node.getParam(private_node.getNamespace(), value)) flatten("", value, result);
  return result;
}

void startOrRefuse(const ros::NodeHandle& private_node, const std::function<void()>& start) {
  try {
    start();
  } catch (const std::exception& error) {
    ROS_ERROR("%s (in %s)", error.what(), private_node.getNamespace().c_str());
    throw;
  }
}

}  // namespace suspension_health_monitor
