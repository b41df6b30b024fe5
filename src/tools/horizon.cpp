#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "command.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

constexpr std::size_t kPlotLines = 25;
constexpr double kColumnsPerUnit = 30.0;
constexpr double kHighestPlotted = 3.0;

/// Both curves as a plot on its side, for a terminal; a higher resonance is cut off.
void plot(const HorizonProposal& proposal) {
  const auto column = [](double magnitude) {
    return static_cast<std::size_t>(std::min(magnitude, kHighestPlotted) * kColumnsPerUnit);
  };
  std::printf("      Hz   strut  filter   magnitude: S strut, F filter, | is 1\n");
  const std::size_t step = proposal.curves.size() / kPlotLines;
  for (std::size_t i = 0; i < proposal.curves.size(); i += step) {
    const MagnitudePoint& point = proposal.curves[i];
    std::string line(std::max(column(point.system), column(1.0)) + 1, ' ');
    line[column(1.0)] = '|';
    line[column(point.filter)] = 'F';
    line[column(point.system)] = 'S';
    std::printf("%8.3f  %6.3f  %6.3f   %s\n", point.frequency_hz, point.system, point.filter, line.c_str());
  }
}

nlohmann::json toJson(const HorizonProposal& proposal) {
  nlohmann::json curves = nlohmann::json::array();
  for (const MagnitudePoint& point : proposal.curves)
    curves.push_back({{"frequency_hz", point.frequency_hz}, {"strut", point.system}, {"filter", point.filter}});
  return {{"horizon", proposal.horizon}, {"bandwidth_hz", proposal.bandwidth_hz}, {"curves", curves}};
}

}  // namespace

void horizon(const Arguments& arguments) {
  po::options_description description("options");
  auto add = description.add_options();
  add("damping-to-mass", po::value<double>()->required(), "[1/s] rough b1, e.g. from identify");
  add("stiffness-to-mass", po::value<double>()->required(), "[1/s^2] rough b0");
  add("json", po::value<std::string>(), "write proposal and curves as JSON");
  const auto values =
      parse(arguments, "horizon --damping-to-mass B1 --stiffness-to-mass B0 [--json FILE]", description);
  if (!values) return;
  const HorizonProposal proposal =
      proposeHorizon((*values)["damping-to-mass"].as<double>(), (*values)["stiffness-to-mass"].as<double>());
  if (std::optional<TextFile> file = outputFile(*values, "json")) file->commit(toJson(proposal).dump(2) + '\n');
  plot(proposal);
  std::printf("\nintegration_horizon: %.3g   # [s] strut and filter both reach to %.3g Hz (3 dB)\n", proposal.horizon,
              proposal.bandwidth_hz);
  printWritten(*values, {"json"});
}

}  // namespace suspension_health_monitor
