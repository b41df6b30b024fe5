#include "options.h"

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <map>
#include <stdexcept>
#include <string_view>

namespace suspension_health_monitor {
namespace {

/// What arrays get by an argument of the call.
const std::map<std::string_view, std::string> kArguments{
    {"effects", "model"}, {"model_file", "model"}, {"effects_file", "effects_file"}, {"baseline_file", "baseline"}};

bool isOfArrays(const OptionField<ShellOptions>& field) { return field.name == "input_timeout"; }

}  // namespace

OptionMap withoutMessages(OptionMap keywords) {
  for (const auto& field : kShellFields)
    if (!isOfArrays(field) && kArguments.count(field.name) == 0) keywords.erase(std::string(field.name));
  return keywords;
}

OptionMap takeKeywords(const OptionMap& keywords, const std::vector<OptionDescription>& known,
                       const std::vector<std::string>& arguments) {
  OptionMap taken, unknown;
  for (const auto& [name, value] : keywords) {
    const auto option = std::find_if(known.begin(), known.end(), [&, &its = name](const OptionDescription& one) {
      return one.name == its || boost::replace_all_copy(one.name, "/", "_") == its;
    });
    if (option == known.end())
      unknown.emplace(name, value);
    else if (!taken.emplace(option->name, value).second)
      throw std::invalid_argument(option->name + " is given twice, must be given once");
  }
  std::vector<OptionDescription> named = known;
  for (const std::string& argument : arguments) named.push_back({"", argument, "", "", "", ""});
  refuseUnknown(unknown, named);
  return taken;
}

PipelineOptions arrayOptions(const OptionMap& keywords) {
  for (const auto& field : kShellFields) {
    if (isOfArrays(field) || keywords.count(std::string(field.name)) == 0) continue;
    const auto argument = kArguments.find(field.name);
    throw std::invalid_argument(std::string(field.name) +
                                " is an option of messages and files, must not come with arrays: " +
                                (argument != kArguments.end() ? "for these there is " + argument->second + '='
                                                              : "these have the accelerations along the strut"));
  }
  return PipelineOptions::fromValues(keywords);
}

}  // namespace suspension_health_monitor
