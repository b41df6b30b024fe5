#include "live_settings.h"

#include <dynamic_reconfigure/config_tools.h>
#include <ros/console.h>

#include <algorithm>
#include <type_traits>

#include "parameters.h"

namespace suspension_health_monitor {
namespace {

using dynamic_reconfigure::ConfigTools;

/// Calls visit(field, pointer to the int or double member) for every live setting of a table.
template <class Options, std::size_t N, class Visit>
void forEachLive(const std::array<OptionField<Options>, N>& fields, const Visit& visit) {
  for (const OptionField<Options>& field : fields) {
    if (std::find(kLiveSettings.begin(), kLiveSettings.end(), field.name) == kLiveSettings.end()) continue;
    std::visit(
        [&](auto member) {
          using Value = std::decay_t<decltype(std::declval<Options&>().*member)>;
          if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>) visit(field, member);
        },
        field.member);
  }
}

/// Options in which every live setting is at one end of its range.
template <class Options, std::size_t N>
Options atEnd(const std::array<OptionField<Options>, N>& fields, bool largest) {
  Options options;
  forEachLive(fields, [&](const auto& field, auto member) {
    using Value = std::decay_t<decltype(options.*member)>;
    options.*member = static_cast<Value>(largest ? field.max : field.min);
  });
  return options;
}

LiveSettings ends(bool largest) {
  PipelineOptions options;
  options.monitor = atEnd(kMonitorFields, largest);
  options.shell = atEnd(kShellFields, largest);
  return LiveSettings(options);
}

template <class Options, std::size_t N>
void describe(const std::array<OptionField<Options>, N>& fields, dynamic_reconfigure::Group& group) {
  forEachLive(fields, [&](const auto& field, auto member) {
    using Value = std::decay_t<decltype(std::declval<Options&>().*member)>;
    dynamic_reconfigure::ParamDescription description;
    description.name = std::string(field.name);
    description.type = std::is_same_v<Value, int> ? "int" : "double";
    description.description = '[' + std::string(field.unit) + "] " + std::string(field.help);
    group.parameters.push_back(std::move(description));
  });
}

dynamic_reconfigure::ConfigDescription describeAll() {
  dynamic_reconfigure::ConfigDescription description;
  description.groups.resize(1);
  description.groups.front().name = "Default";
  describe(kMonitorFields, description.groups.front());
  describe(kShellFields, description.groups.front());
  LiveSettings::__getMin__().__toMessage__(description.min);
  LiveSettings::__getMax__().__toMessage__(description.max);
  LiveSettings::__getDefault__().__toMessage__(description.dflt);
  return description;
}

}  // namespace

LiveSettings::LiveSettings(const PipelineOptions& options) {
  forEachLive(kMonitorFields,
              [&](const auto& field, auto member) { values_[std::string(field.name)] = options.monitor.*member; });
  forEachLive(kShellFields,
              [&](const auto& field, auto member) { values_[std::string(field.name)] = options.shell.*member; });
}

PipelineOptions LiveSettings::appliedTo(PipelineOptions options) const {
  OptionMap values = values_;
  takeOptions(values, kMonitorFields, options.monitor);
  takeOptions(values, kShellFields, options.shell);
  options.monitor.validate();
  return options;
}

const dynamic_reconfigure::ConfigDescription& LiveSettings::__getDescriptionMessage__() {
  static const dynamic_reconfigure::ConfigDescription description = describeAll();
  return description;
}

const LiveSettings& LiveSettings::__getMin__() {
  static const LiveSettings settings = ends(false);
  return settings;
}

const LiveSettings& LiveSettings::__getMax__() {
  static const LiveSettings settings = ends(true);
  return settings;
}

const LiveSettings& LiveSettings::__getDefault__() {
  static const LiveSettings settings;
  return settings;
}

void LiveSettings::__fromServer__(const ros::NodeHandle& node) {
  *this = LiveSettings(PipelineOptions::fromValues(readParameters(node)));
}

void LiveSettings::__toServer__(const ros::NodeHandle& node) const {
  for (const auto& [name, value] : values_) {
    if (const auto* whole = std::get_if<int>(&value)) node.setParam(name, *whole);
    if (const auto* number = std::get_if<double>(&value)) node.setParam(name, *number);
  }
}

bool LiveSettings::__fromMessage__(const dynamic_reconfigure::Config& message) {
  bool known = message.bools.empty() && message.strs.empty();
  const auto take = [&](const auto& parameters) {
    for (const auto& parameter : parameters) {
      const auto found = values_.find(parameter.name);
      if (found != values_.end()) found->second = parameter.value;
      known = known && found != values_.end();
      if (found == values_.end()) ROS_WARN("%s is not a setting that can change while running", parameter.name.c_str());
    }
  };
  take(message.ints);
  take(message.doubles);
  return known;
}

void LiveSettings::__toMessage__(dynamic_reconfigure::Config& message) const {
  ConfigTools::clear(message);
  for (const auto& [name, value] : values_) {
    if (const auto* whole = std::get_if<int>(&value)) ConfigTools::appendParameter(message, name, *whole);
    if (const auto* number = std::get_if<double>(&value)) ConfigTools::appendParameter(message, name, *number);
  }
  message.groups.resize(1);
  message.groups.front().name = "Default";
  message.groups.front().state = true;
}

}  // namespace suspension_health_monitor
