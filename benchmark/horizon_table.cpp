// Prints the table of doc/horizon.md: the proposed horizon against the one with the smallest rms error in simulation.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "../test/core/paper_drive.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"
#include "suspension_health_monitor/internal/identification/regression.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr int kNumSeeds = 12;
constexpr double kPeriodsPerDrive = 40.0;
constexpr double kMemory = 0.6;  // of the estimators, in natural periods; 50 rows at 50 Hz for the paper's strut

struct Drive {
  const char* name;
  const char* scenario;
  const char* vehicle;
  double b1, b0, rate, noise;
};

constexpr Drive kDrives[] = {
    {"paper strut, paper's road", "paper_clean", "paper", 3.0, 13.8, 50.0, 0.024},
    {"paper strut, paper's road, noise x 4", "paper_clean", "paper", 3.0, 13.8, 50.0, 0.1},
    {"paper strut, ISO C", "iso_road", "paper", 3.0, 13.8, 50.0, 0.024},
    {"golden car, ISO C", "iso_road", "golden_car", 6.0, 63.3, 200.0, 0.1},
    {"rover, ISO E", "iso_road", "rover", 5.0, 120.0, 100.0, 0.1},
    {"ugv, ISO D", "iso_road", "ugv", 4.0, 40.0, 100.0, 0.1},
    {"ugv, damping ratio 0.1", "iso_road", "ugv", 1.265, 40.0, 100.0, 0.1},
    {"ugv, damping ratio 0.7", "iso_road", "ugv", 8.85, 40.0, 100.0, 0.1},
    {"ugv, damping ratio 1", "iso_road", "ugv", 12.65, 40.0, 100.0, 0.1},
    {"golden car, damping ratio 1", "iso_road", "golden_car", 15.9, 63.3, 200.0, 0.1},
    {"paper strut, damping ratio 1", "paper_clean", "paper", 7.43, 13.8, 50.0, 0.024},
};

using Samples = std::vector<CornerSample>;

std::vector<Samples> simulateAll(const Drive& drive) {
  std::vector<Samples> drives(kNumSeeds);
  for (int i = 0; i < kNumSeeds; ++i) {
    SimulationOptions options;
    options.scenario = drive.scenario;
    options.vehicle = drive.vehicle;
    options.damping_to_mass = drive.b1;
    options.stiffness_to_mass = drive.b0;
    options.damping_end_fraction = 1.0;
    options.rate = drive.rate;
    options.noise = drive.noise;
    options.duration = kPeriodsPerDrive * 2.0 * M_PI / std::sqrt(drive.b0);
    options.seed = i + 1;
    drives[static_cast<std::size_t>(i)] = simulate(options);
  }
  return drives;
}

struct Errors {
  double ls = 0.0, la = 0.0;
};

// rms relative error of both parameters over the last two thirds of the rows of all drives.
Errors errorsAt(double horizon, const Drive& drive, const std::vector<Samples>& drives) {
  const IntegralFilterOptions filter{horizonSamples(horizon, 1.0 / drive.rate), 1.0 / drive.rate,
                                     IntegrationRule::kBandLimited};
  RecursiveOptions recursive;
  recursive.forgetting_factor = 1.0 - std::sqrt(drive.b0) / (kMemory * 2.0 * M_PI * drive.rate);
  const auto squaredError = [&](const Eigen::VectorXd& theta) {
    return (std::pow(theta[0] / drive.b1 - 1.0, 2) + std::pow(theta[1] / drive.b0 - 1.0, 2)) / 2.0;
  };
  Errors sum;
  std::size_t count = 0;
  for (const Samples& samples : drives) {
    SuspensionRegression regression(filter);
    RecursiveLeastSquares ls(kNumStrutParameters, recursive);
    RecursiveLeastAbsolute la(kNumStrutParameters, recursive);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const RegressionRow* row = regression.push(samples[k]);
      if (row == nullptr) continue;
      ls.update(*row);
      la.update(*row);
      if (3 * k < samples.size()) continue;
      sum.ls += squaredError(ls.parameters());
      sum.la += squaredError(la.parameters());
      ++count;
    }
  }
  const auto n = static_cast<double>(count);
  return {std::sqrt(sum.ls / n), std::sqrt(sum.la / n)};
}

void printRow(const Drive& drive) {
  const std::vector<Samples> drives = simulateAll(drive);
  const double proposed = proposeHorizon(drive.b1, drive.b0);
  const Errors at_proposal = errorsAt(proposed, drive, drives);
  Errors least = at_proposal, best{proposed, proposed};
  for (double factor = 0.3; factor < 3.0; factor *= 1.1) {
    const double horizon = factor * proposed;
    const Errors errors = errorsAt(horizon, drive, drives);
    if (errors.ls < least.ls) least.ls = errors.ls, best.ls = horizon;
    if (errors.la < least.la) least.la = errors.la, best.la = horizon;
  }
  const double root = std::sqrt(drive.b0);
  std::printf("| %s | %.2f | %.3f (%.2f) | %.3f (%.2f) | %.3f (%.2f) | %.2f %% | %.2f %% | +%.0f %% | +%.0f %% |\n",
              drive.name, drive.b1 / (2.0 * root), proposed, proposed * root, best.ls, best.ls * root, best.la,
              best.la * root, 100.0 * at_proposal.ls, 100.0 * at_proposal.la, 100.0 * (at_proposal.ls / least.ls - 1.0),
              100.0 * (at_proposal.la / least.la - 1.0));
}

int command(const Arguments&) {
  std::printf(
      "| drive | damping ratio | proposed h [s] (h sqrt(b0)) | best for LS | best for LA | rms error LS | rms error LA "
      "| LS above best | LA above best |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& drive : kDrives) printRow(drive);
  return 0;
}

const AddTable kAdded("horizon", {"", command});

}  // namespace
}  // namespace suspension_health_monitor
