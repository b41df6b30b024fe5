// What the estimates lose when the input comes as it really does: doc/alignment.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/signal/uniform_grid.h"
#include "suspension_health_monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.005;

/// Means over the drive from kSettled on.
struct Estimates {
  double la_damping = 0.0, la_stiffness = 0.0, ls_damping = 0.0, ls_stiffness = 0.0;
  double valid = 0.0;  // share of the samples
  bool resampled = false;
};

Estimates identify(const SimulationOptions& drive_options, Alignment alignment) {
  constexpr double kSettled = 20.0;  // [s]
  MonitorOptions options;
  options.sample_period = kPeriod;
  options.forgetting_factor = 0.999;
  SuspensionMonitor monitor(options);
  UniformGrid grid(kPeriod, {alignment, false, 2 * monitor.horizonSamples()});
  DriveSimulator simulator(drive_options);
  Estimates mean;
  double count = 0.0;
  const auto push = [&](Side side, const std::optional<AccelerometerReading>& reading) {
    if (!reading) return;
    for (auto sample = grid.push(side, reading->stamp, reading->acceleration + 9.81); sample; sample = grid.next()) {
      const MonitorReport* report = monitor.addSample(*sample);
      if (report == nullptr || toSeconds(sample->stamp) < kSettled) continue;
      mean.la_damping += report->la.damping_to_mass;
      mean.la_stiffness += report->la.stiffness_to_mass;
      mean.ls_damping += report->ls.damping_to_mass;
      mean.ls_stiffness += report->ls.stiffness_to_mass;
      mean.valid += report->la.valid ? 1.0 : 0.0;
      count += 1.0;
    }
  };
  while (const std::optional<DriveSample> sample = simulator.next()) {
    push(Side::kSprung, sample->sprung);
    push(Side::kUnsprung, sample->unsprung);
  }
  for (double* value : {&mean.la_damping, &mean.la_stiffness, &mean.ls_damping, &mean.ls_stiffness, &mean.valid})
    *value /= count;
  mean.resampled = grid.resamples();
  return mean;
}

SimulationOptions asItComes(SimulationOptions options) {
  options.unsprung_rate = 333.0;
  options.unsprung_phase = 0.0011;
  options.dropout = 0.02;
  return options;
}

void print(const char* name, const Estimates& e, const Estimates& ideal) {
  std::printf("%-28s LA %8.4f %8.3f (%+5.2f %% %+5.2f %%)  LS %8.4f %8.3f (%+5.2f %% %+5.2f %%) valid %.3f\n", name,
              e.la_damping, e.la_stiffness, 100 * (e.la_damping / ideal.la_damping - 1),
              100 * (e.la_stiffness / ideal.la_stiffness - 1), e.ls_damping, e.ls_stiffness,
              100 * (e.ls_damping / ideal.ls_damping - 1), 100 * (e.ls_stiffness / ideal.ls_stiffness - 1), e.valid);
}

TEST(X, Y) {
  for (const char* name : {"paper_clean", "iso_road"}) {
    for (int seed : {1, 2}) {
    SimulationOptions options = scenario(name, 60.0);
    options.rate = 200.0;
    options.seed = seed;
    const Estimates ideal = identify(options, Alignment::kPaired);
    print("ideal", ideal, ideal);
    print("ideal, resampled", identify(options, Alignment::kResampled), ideal);
    SimulationOptions real = asItComes(options);
    print("rates, lost", identify(real, Alignment::kAuto), ideal);
    real.sampling_jitter = 0.001;
    print("sampling jitter", identify(real, Alignment::kAuto), ideal);
    print("sampling jitter, paired", identify(real, Alignment::kPaired), ideal);
    real.sampling_jitter = 0.0;
    real.stamp_jitter = 0.001;
    print("stamp jitter", identify(real, Alignment::kAuto), ideal);
    real.sampling_jitter = 0.001;
    print("both jitters", identify(real, Alignment::kAuto), ideal);
    }
  }
}

}  // namespace
}  // namespace suspension_health_monitor
