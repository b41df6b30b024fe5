#include <cstdio>
#include <stdexcept>

#include "../ros/shell_options.h"
#include "../ros/simulator_options.h"
#include "command.h"

namespace suspension_health_monitor {

void options(const Arguments& arguments) {
  namespace po = boost::program_options;
  po::options_description description("options");
  description.add_options()("of", po::value<std::string>()->default_value("monitor"), "monitor or simulator");
  const auto values = parse(arguments, "options [monitor|simulator]", description, "of");
  if (!values) return;
  const auto of = (*values)["of"].as<std::string>();
  if (of != "monitor" && of != "simulator")
    throw std::invalid_argument("options of " + of + ", must be monitor or simulator");
  std::printf("| name | default | unit | allowed | meaning |\n|---|---|---|---|---|\n");
  for (const OptionDescription& option : of == "monitor" ? PipelineOptions::describe() : SimulatorOptions::describe())
    std::printf("| `%s` | %s | %s | %s | %s |\n", option.name.c_str(), option.default_value.c_str(),
                option.unit.c_str(), option.allowed.c_str(), option.help.c_str());
}

}  // namespace suspension_health_monitor
