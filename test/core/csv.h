#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace suspension_health_monitor {

/// @param name  file below test/core/data: one line of names, then lines of numbers between commas.
/// @return the numbers by line.
inline std::vector<std::vector<double>> readCsv(const std::string& name) {
  std::ifstream file(std::string(TEST_DATA_DIR) + "/" + name);
  if (!file) throw std::runtime_error("cannot open " + name);
  std::vector<std::vector<double>> lines;
  std::string line, cell;
  std::getline(file, line);
  while (std::getline(file, line)) {
    lines.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) lines.back().push_back(std::stod(cell));
  }
  return lines;
}

}  // namespace suspension_health_monitor
