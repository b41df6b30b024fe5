#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "command.h"
#include "results.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kPlotLines = 25;
constexpr int kCurvePoints = 241;
constexpr double kCurveDecades = 1.5;  // on either side of the bandwidth
constexpr double kColumnsPerUnit = 30.0;
constexpr double kHighestPlotted = 3.0;

/// One frequency of the two magnitude responses that are to match.
struct MagnitudePoint {
  double frequency_hz, strut, filter;
};

/// @return frequencies in equal ratios around the bandwidth.
std::vector<MagnitudePoint> curvesOf(double damping_to_mass, double stiffness_to_mass, double horizon,
                                     double bandwidth_hz) {
  std::vector<MagnitudePoint> curves;
  for (int i = 0; i < kCurvePoints; ++i) {
    const double decades = kCurveDecades * (2.0 * i / (kCurvePoints - 1) - 1.0);
    const double frequency = bandwidth_hz * std::pow(10.0, decades);
    curves.push_back({frequency, transmissibility(damping_to_mass, stiffness_to_mass, frequency),
                      integralFilterMagnitude(horizon, frequency)});
  }
  return curves;
}

/// Both curves as a plot on its side, for a terminal; a higher resonance is cut off.
void plot(const std::vector<MagnitudePoint>& curves) {
  const auto column = [](double magnitude) {
    return static_cast<std::size_t>(std::min(magnitude, kHighestPlotted) * kColumnsPerUnit);
  };
  std::printf("      Hz   strut  filter   magnitude: S strut, F filter, | is 1\n");
  const std::size_t step = curves.size() / kPlotLines;
  for (std::size_t i = 0; i < curves.size(); i += step) {
    const MagnitudePoint& point = curves[i];
    std::string line(std::max(column(point.strut), column(1.0)) + 1, ' ');
    line[column(1.0)] = '|';
    line[column(point.filter)] = 'F';
    line[column(point.strut)] = 'S';
    std::printf("%8.3f  %6.3f  %6.3f   %s\n", point.frequency_hz, point.strut, point.filter, line.c_str());
  }
}

}  // namespace

SHM_FIELDS(MagnitudePoint, frequency_hz, strut, filter)

void horizon(const Arguments& arguments) {
  po::options_description description("options");
  auto add = description.add_options();
  add("damping-to-mass", po::value<double>()->required(), "[1/s] rough b1, e.g. from identify");
  add("stiffness-to-mass", po::value<double>()->required(), "[1/s^2] rough b0");
  add("json", po::value<std::string>(), "write proposal and curves as JSON");
  const auto values =
      parse(arguments, "horizon --damping-to-mass B1 --stiffness-to-mass B0 [--json FILE]", description);
  if (!values) return;
  const double b1 = (*values)["damping-to-mass"].as<double>(), b0 = (*values)["stiffness-to-mass"].as<double>();
  const double horizon = proposeHorizon(b1, b0), bandwidth_hz = bandwidth(b1, b0) / (2.0 * M_PI);
  const std::vector<MagnitudePoint> curves = curvesOf(b1, b0, horizon, bandwidth_hz);
  if (std::optional<TextFile> file = outputFile(*values, "json")) {
    const json all{{"horizon", horizon}, {"bandwidth_hz", bandwidth_hz}, {"curves", jsonOf(curves)}};
    file->commit(all.dump(2) + '\n');
  }
  plot(curves);
  std::printf("\nintegration_horizon: %.3g   # [s] strut and filter both reach to %.3g Hz (3 dB)\n", horizon,
              bandwidth_hz);
  printWritten(*values, {"json"});
}

}  // namespace suspension_health_monitor
