#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "../ros/corners_options.h"
#include "../ros/shell_options.h"
#include "../ros/simulator_options.h"
#include "command.h"

namespace suspension_health_monitor {
namespace {

std::vector<OptionDescription> optionsOf(const std::string& of) {
  if (of == "monitor") return PipelineOptions::describe();
  if (of == "simulator") return SimulatorOptions::describe();
  if (of == "corners") return describeOptions(kCornersFields);
  throw std::invalid_argument("options of " + of + ", must be monitor, simulator or corners");
}

}  // namespace

void options(const Arguments& arguments) {
  namespace po = boost::program_options;
  po::options_description description("options");
  description.add_options()("of", po::value<std::string>()->default_value("monitor"), "monitor, simulator or corners");
  const auto values = parse(arguments, "options [monitor|simulator|corners]", description, "of");
  if (!values) return;
  const std::vector<OptionDescription> all = optionsOf((*values)["of"].as<std::string>());
  std::printf("| name | default | unit | allowed | meaning |\n|---|---|---|---|---|\n");
  for (const OptionDescription& option : all)
    std::printf("| `%s` | %s | %s | %s | %s |\n", option.name.c_str(), option.default_value.c_str(),
                option.unit.c_str(), option.allowed.c_str(), option.help.c_str());
}

}  // namespace suspension_health_monitor
