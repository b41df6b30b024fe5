// Prints tables for whole drives: error of b1 and b0 by least squares over all rows and by the estimate of identify(),
// and how often the latter's 95 % interval holds the truth; then the latter in the field (field_drive.h).
//   whole_drive_table [SEEDS [SECONDS]]      measurements of each drive, default 20, and its length, default 120
#include <array>
#include <cstdio>
#include <cstdlib>

#include "../test/core/interval_coverage.h"
#include "field_drive.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"

namespace suspension_health_monitor {
namespace {

struct Case {
  const char* name;
  const char* scenario;
  const char* vehicle;
  const char* iso_class;
  double rate;  // [Hz]
};
constexpr Case kCases[] = {{"paper's road", "paper_clean", "default", "default", 100},
                           {"paper's vehicle, ISO road", "iso_road", "paper", "default", 100},
                           {"car, class A", "iso_road", "golden_car", "A", 200},
                           {"car, class C", "iso_road", "golden_car", "C", 200},
                           {"rover, class D", "iso_road", "rover", "D", 200},
                           {"UGV, class B", "iso_road", "ugv", "B", 200},
                           {"UGV, class C", "iso_road", "ugv", "C", 200}};
constexpr double kNoise = 0.03;  // [m/s^2]

struct Errors {
  double sum = 0.0;  // relative
  Coverage coverage;
  void add(double estimate, double stddev, double truth) {
    sum += estimate / truth - 1.0;
    coverage.add(estimate - truth, stddev);
  }
};

void print(const Errors& errors, int num) {
  if (num == 0) return void(std::printf(" |"));
  std::printf(" %+.2f, %.0f, %.2f |", 100.0 * errors.sum / num, 100.0 * errors.coverage.share(), errors.coverage.rms());
}

void printRow(const char* name, const std::array<double, 2>& least_squares, const std::array<Errors, 2>& errors,
              int seeds) {
  std::printf("| %s |", name);
  for (const double error : least_squares) std::printf(" %+.2f |", 100.0 * error / seeds);
  for (const Errors& each : errors) print(each, seeds);
  std::printf("\n");
  std::fflush(stdout);
}

void printTable(int seeds, double seconds) {
  std::printf(
      "| drive | LS b1: mean error [%%] | LS b0 | estimate's b1: mean error [%%], interval holds [%%], rms z | b0 |\n"
      "|---|---|---|---|---|\n");
  std::array<Coverage, 2> all;
  for (const Case& drive : kCases) {
    SimulationOptions simulation;
    simulation.scenario = drive.scenario;
    simulation.vehicle = drive.vehicle;
    simulation.iso_class = drive.iso_class;
    simulation.rate = drive.rate;
    simulation.duration = seconds;
    const CleanDrive clean = cleanDrive(simulation);
    const int horizon = proposedHorizon(clean, kNoise);
    const IntegralFilterOptions filter{horizon, clean.period, IntegrationRule::kBandLimited};
    std::array<double, 2> least_squares{};
    std::array<Errors, 2> errors;
    for (int seed = 1; seed <= seeds; ++seed) {
      RecursiveOptions never_forgets;
      never_forgets.forgetting_factor = 1.0;
      SuspensionRegression regression(filter);
      RecursiveLeastSquares ls(kNumStrutParameters, never_forgets);
      Drive readings;
      measure(clean, kNoise, static_cast<unsigned>(7000 + seed), [&](const CornerSample& sample) {
        if (const RegressionRow* row = regression.push(sample)) ls.update(*row);
        readings.samples.push_back(sample);
      });
      IdentifyOptions options;
      options.horizon_samples = horizon;
      const StrutEstimate found = identify({readings}, options).estimate;
      least_squares[0] += ls.parameters()[0] / clean.damping_to_mass - 1.0;
      least_squares[1] += ls.parameters()[1] / clean.stiffness_to_mass - 1.0;
      errors[0].add(found.damping_to_mass, found.damping_to_mass_stddev, clean.damping_to_mass);
      errors[1].add(found.stiffness_to_mass, found.stiffness_to_mass_stddev, clean.stiffness_to_mass);
    }
    printRow(drive.name, least_squares, errors, seeds);
    for (std::size_t i = 0; i < 2; ++i) all[i] += errors[i].coverage;
  }
  std::printf("| **all** | | | %.1f %%, %.2f | %.1f %%, %.2f |\n", 100.0 * all[0].share(), all[0].rms(),
              100.0 * all[1].share(), all[1].rms());
}

struct Field {
  const char* name;
  double FieldDrive::*what;
  double value;
};
constexpr Field kFields[] = {{"as it should be", &FieldDrive::offset, 0.0},
                             {"offset of 0.8 m/s^2", &FieldDrive::offset, 0.8},
                             {"offset +- 0.3 m/s^2 in 10 minutes", &FieldDrive::offset_swing, 0.3},
                             {"wheel 2 ms late", &FieldDrive::skew, 0.002},
                             {"engine 0.5 m/s^2", &FieldDrive::engine, 0.5}};
constexpr FieldWay kWays[] = {{"A, 30 m/s, 100 Hz", 16e-6, 30.0, 100}, {"C, 15 m/s, 200 Hz", 256e-6, 15.0, 200}};

void printField(int seeds, double seconds) {
  std::printf(
      "\n| road | sensors | vehicle | valid | b1: mean error [%%], interval holds [%%], rms z | b0 |\n"
      "|---|---|---|---|---|---|\n");
  for (const FieldWay& way : kWays)
    for (const Field& field : kFields)
      for (const FieldVehicle& vehicle : kFieldVehicles) {
        std::array<Errors, 2> errors;
        int valid = 0;
        for (int seed = 1; seed <= seeds; ++seed) {
          FieldDrive drive;
          drive.vehicle = vehicle;
          drive.road = way.road;
          drive.speed = way.speed;
          drive.rate = way.rate;
          drive.seed = static_cast<unsigned>(seed);
          drive.*field.what = field.value;
          FieldSimulator simulator(drive);
          Drive readings;
          while (simulator.time() < seconds) readings.samples.push_back(simulator.next());
          const StrutEstimate found = identify({readings}).estimate;
          if (!found.valid()) continue;
          ++valid;
          errors[0].add(found.damping_to_mass, found.damping_to_mass_stddev, vehicle.b1);
          errors[1].add(found.stiffness_to_mass, found.stiffness_to_mass_stddev, vehicle.b0);
        }
        std::printf("| %s | %s | %s | %d of %d |", way.name, field.name, vehicle.name, valid, seeds);
        for (const Errors& each : errors) print(each, valid);
        std::printf("\n");
        std::fflush(stdout);
      }
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 20;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 120.0;
  suspension_health_monitor::printTable(seeds, seconds);
  suspension_health_monitor::printField(seeds, seconds);
}
