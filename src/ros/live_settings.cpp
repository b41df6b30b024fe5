#include "live_settings.h"

#include <dynamic_reconfigure/config_tools.h>
#include <ros/console.h>

#include <algorithm>
#include <optional>

#include "parameters.h"

namespace suspension_health_monitor {
namespace {

using dynamic_reconfigure::ConfigTools;
using option_table::Bound;

/// The live settings among all options.
std::vector<Bound> bindLive(PipelineOptions& options) {
  std::vector<Bound> live;
  const auto add = [&](const auto& fields, auto& group) {
    for (const auto& field : fields)
      if (std::any_of(kLiveSettings.begin(), kLiveSettings.end(),
                      [&](const LiveSetting& setting) { return setting.name == field.name; }))
        live.push_back(option_table::bind(field, group));
  };
  add(kMonitorFields, options.monitor);
  add(kShellFields, options.shell);
  return live;
}

/// Names of the groups in the order of the options, each once.
std::vector<std::string> groupsOf(const std::vector<Bound>& live) {
  std::vector<std::string> groups;
  for (const Bound& option : live)
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) groups.emplace_back(option.group);
  return groups;
}

/// The top of the groups, as the generator would have it: it holds the others, and no setting.
constexpr const char* kTop = "Default";
}  // namespace

LiveSettings::LiveSettings(PipelineOptions options) {
  options.monitor.memory = MonitorSettings(options.monitor).presentMemory();
  for (const Bound& option : bindLive(options)) values_[std::string(option.name)] = *option_table::valueOf(option);
}

LiveSettings LiveSettings::atEnds(double LiveSetting::*end, double (*beyond)(double, double)) const {
  LiveSettings settings = *this;
  for (const LiveSetting& setting : kLiveSettings) {
    OptionValue& value = settings.values_[std::string(setting.name)];
    if (auto* whole = std::get_if<int>(&value)) *whole = static_cast<int>(beyond(*whole, setting.*end));
    if (auto* number = std::get_if<double>(&value)) *number = beyond(*number, setting.*end);
  }
  return settings;
}

PipelineOptions LiveSettings::appliedTo(PipelineOptions options) const {
  OptionMap values = values_;
  const std::optional<double> given = options.monitor.memory;
  const double memory = MonitorSettings(options.monitor).presentMemory();
  takeOptions(values, kMonitorFields, options.monitor);
  if (options.monitor.memory == memory)
    options.monitor.memory = given;
  else
    options.monitor.forgetting_factor.reset();  // what was turned counts
  takeOptions(values, kShellFields, options.shell);
  options.monitor.validate();
  return options;
}

dynamic_reconfigure::ConfigDescription LiveSettings::__getDescriptionMessage__() {
  dynamic_reconfigure::ConfigDescription description;
  description.groups.resize(1);
  description.groups.front().name = kTop;
  PipelineOptions options;
  const std::vector<Bound> live = bindLive(options);
  for (const std::string& name : groupsOf(live)) {
    dynamic_reconfigure::Group group;
    group.name = name;
    group.id = static_cast<int>(description.groups.size());
    for (const Bound& option : live) {
      if (option.group != name) continue;
      dynamic_reconfigure::ParamDescription parameter;
      parameter.name = std::string(option.name);
      parameter.type = std::holds_alternative<int*>(option.member) ? "int" : "double";
      parameter.description = '[' + std::string(option.unit) + "] " + std::string(option.help);
      group.parameters.push_back(std::move(parameter));
    }
    description.groups.push_back(std::move(group));
  }
  __getMin__().__toMessage__(description.min);
  __getMax__().__toMessage__(description.max);
  __getDefault__().__toMessage__(description.dflt);
  return description;
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

void LiveSettings::__fromMessage__(const dynamic_reconfigure::Config& message) {
  const auto take = [&](const auto& parameters) {
    for (const auto& parameter : parameters) {
      const auto found = values_.find(parameter.name);
      if (found == values_.end())
        ROS_WARN("%s is not a setting that can change while running", parameter.name.c_str());
      else
        found->second = parameter.value;
    }
  };
  take(message.ints);
  take(message.doubles);
}

void LiveSettings::__toMessage__(dynamic_reconfigure::Config& message) const {
  ConfigTools::clear(message);
  for (const auto& [name, value] : values_) {
    if (const auto* whole = std::get_if<int>(&value)) ConfigTools::appendParameter(message, name, *whole);
    if (const auto* number = std::get_if<double>(&value)) ConfigTools::appendParameter(message, name, *number);
  }
  PipelineOptions options;
  std::vector<std::string> groups = groupsOf(bindLive(options));
  groups.insert(groups.begin(), kTop);
  dynamic_reconfigure::GroupState is_shown;
  is_shown.state = true;
  for (std::size_t i = 0; i < groups.size(); ++i)
    ConfigTools::appendGroup(message, groups[i], static_cast<int>(i), 0, is_shown);
}

}  // namespace suspension_health_monitor
