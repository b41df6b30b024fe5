// Prints tables, which doc/uncertainty.md quotes, on vehicles that nobody had in mind, and on clocks that differ: how
// far the block estimate and LA are off, and how often their intervals hold the truth.
//   tables accuracy offset|skew [MEMORY]     memory in seconds
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "field_monitor.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

/// Errors of one estimate of one parameter.
struct Errors {
  std::vector<double> relative;
  double inside = 0.0;

  void add(double value, double stddev, double truth) {
    relative.push_back(value / truth - 1.0);
    inside += std::abs(value - truth) < 1.96 * stddev ? 1.0 : 0.0;
  }
};

std::string medianAndShare(const Errors& errors) {
  if (errors.relative.empty()) return "-";
  char text[48];
  std::snprintf(text, sizeof text, "%+.1f %%, %.0f %%", 100.0 * median(errors.relative),
                100.0 * errors.inside / static_cast<double>(errors.relative.size()));
  return text;
}

/// Four estimates' errors over 600 s, as cells of a table.
std::string accuracyOf(const FieldDrive& drive, std::optional<double> memory) {
  std::array<Errors, 4> errors;
  double next = 20.0, valid = 0.0, samples = 0.0;
  follow(drive, memory, 600.0, [&](double time, const MonitorReport& report) {
    samples += 1.0;
    valid += report.estimate.valid() ? 1.0 : 0.0;
    if (time < next || !report.estimate.valid()) return;
    next = time + 2.0;
    for (std::size_t e = 0; e < 2; ++e) {
      const StrutEstimate& estimate = e == 0 ? report.estimate : report.la;
      errors[2 * e].add(estimate.damping_to_mass, estimate.damping_to_mass_stddev, drive.vehicle.b1);
      errors[2 * e + 1].add(estimate.stiffness_to_mass, estimate.stiffness_to_mass_stddev, drive.vehicle.b0);
    }
  });
  std::string cells;
  for (const Errors& of_one : errors) cells += medianAndShare(of_one) + " | ";
  return cells + std::to_string(std::lround(100.0 * valid / samples)) + " %";
}

const char* roadName(double road) { return road < 2e-5 ? "A" : "C"; }

/// What is done to the sensors of a drive, and how a row calls it.
struct Variant {
  const char* name;
  std::function<void(FieldDrive&)> set;
};

/// Every rate, vehicle and variant on two roads; what: the variants' column.
void printTable(const char* what, const std::vector<int>& rates, const std::vector<Variant>& variants,
                std::optional<double> memory) {
  std::printf(
      "| road, rate | vehicle | %s | b1: median error, inside 95 %% | b0 | b1 of LA | b0 of LA | valid |\n"
      "|---|---|---|---|---|---|---|---|\n",
      what);
  unsigned seed = 1;
  for (const double road : {16e-6, 256e-6})
    for (const int rate : rates)
      for (const FieldVehicle& vehicle : kFieldVehicles)
        for (const Variant& variant : variants) {
          FieldDrive drive;
          drive.vehicle = vehicle;
          drive.road = road;
          drive.rate = rate;
          drive.seed = seed++;
          variant.set(drive);
          std::printf("| %s, %d Hz | %s | %s | %s |\n", roadName(road), rate, vehicle.name, variant.name,
                      accuracyOf(drive, memory).c_str());
          std::fflush(stdout);
        }
}

void printOffset(std::optional<double> memory) {
  const auto drifts = [](FieldDrive& drive) {
    drive.offset_swing = 0.3;
    drive.offset_period = 3770.0;  // 0.3 m/s^2 in ten minutes
  };
  printTable(
      "offset [m/s^2]", {50, 100, 200, 500},
      {{"0.0", [](FieldDrive&) {}}, {"0.8", [](FieldDrive& drive) { drive.offset = 0.8; }}, {"0.0, drifts", drifts}},
      memory);
}

void printSkew(std::optional<double> memory) {
  printTable("late [ms]", {100, 200},
             {{"0.00", [](FieldDrive&) {}},
              {"1.00", [](FieldDrive& drive) { drive.skew = 1e-3; }},
              {"5.00", [](FieldDrive& drive) { drive.skew = 5e-3; }},
              {"10.00", [](FieldDrive& drive) { drive.skew = 10e-3; }}},
             memory);
}

int command(const Arguments& arguments) {
  const std::optional<double> memory = arguments.given(1);
  if (arguments.word(0) == "offset")
    printOffset(memory);
  else if (arguments.word(0) == "skew")
    printSkew(memory);
  else
    return 2;
  return 0;
}

const AddTable kAdded("accuracy", {"offset|skew [MEMORY]", command});

}  // namespace
}  // namespace suspension_health_monitor
