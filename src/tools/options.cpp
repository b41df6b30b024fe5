#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "../ros/shell_options.h"
#include "../ros/simulator_options.h"
#include "command.h"

namespace suspension_health_monitor {
namespace {

std::vector<OptionDescription> optionsOf(const std::string& of) {
  if (of == "monitor") return PipelineOptions::describe();
  if (of == "simulator") return SimulatorOptions::describe();
  if (of == "vehicle") return VehicleSimulationOptions::describe();
  throw std::invalid_argument("options of " + of + ", must be monitor, simulator or vehicle");
}

using Cells = std::array<std::string, 5>;

/// One table with columns as wide as their longest cell, so that it can be read on a terminal, too.
void print(const std::vector<Cells>& rows) {
  Cells line;
  std::array<int, std::tuple_size_v<Cells>> widths{};
  for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
    for (const Cells& row : rows) widths[i] = std::max(widths[i], static_cast<int>(row[i].size()));
    line[i].assign(static_cast<std::size_t>(widths[i]), '-');
  }
  line.back() = "---";
  const auto printRow = [&](const Cells& row) {
    for (std::size_t i = 0; i < row.size(); ++i) std::printf("| %-*s ", widths[i], row[i].c_str());
    std::printf("|\n");
  };
  printRow(rows.front());
  printRow(line);
  std::for_each(rows.begin() + 1, rows.end(), printRow);
}

}  // namespace

void options(const Arguments& arguments) {
  po::options_description description("options");
  description.add_options()("of", po::value<std::string>()->default_value("monitor"), "monitor, simulator or vehicle");
  const auto values = parse(arguments, "options [monitor|simulator|vehicle]", description, "of");
  if (!values) return;
  const std::vector<OptionDescription> all = optionsOf((*values)["of"].as<std::string>());
  for (auto option = all.begin(); option != all.end();) {
    const std::string& group = option->group;
    std::vector<Cells> rows{{group, "default", "unit", "allowed", "meaning"}};
    for (; option != all.end() && option->group == group; ++option)
      rows.push_back({'`' + option->name + '`', option->default_value, option->unit, option->allowed, option->help});
    if (group != all.front().group) std::printf("\n");
    print(rows);
  }
}

}  // namespace suspension_health_monitor
