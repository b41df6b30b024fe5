// Prints the table of doc/forgetting.md over roads and horizons: what a forgetting factor that falls while the damping
// moves gains after a step, and what it costs while nothing changes, against the slow factor alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "../test/core/simulated_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr int kFirstSeed = 201;
constexpr double kStepAt = 40.0, kDuration = 80.0, kSettled = 15.0;  // [s]

struct Case {
  const char *name, *scenario, *vehicle, *iso_class;
  double speed, rate, noise;  // [m/s], [Hz], [m/s^2]
  int horizon;                // L
  double slow, fastest;
  int seeds;
};
constexpr Case kCases[] = {
    {"paper's road", "paper_clean", "paper", "default", 5, 50, 0.024, 30, 0.99, 0.97, 12},
    {"paper's road", "paper_clean", "paper", "default", 5, 50, 0.024, 30, 0.995, 0.97, 12},
    {"paper's road, noise 0.1", "paper_clean", "paper", "default", 5, 50, 0.1, 30, 0.995, 0.97, 12},
    {"paper's road", "paper_clean", "paper", "default", 5, 50, 0.024, 8, 0.995, 0.97, 12},
    {"golden car, C, 15 m/s", "iso_road", "golden_car", "C", 15, 100, 0.03, 30, 0.99, 0.97, 12},
    {"golden car, C, 15 m/s", "iso_road", "golden_car", "C", 15, 100, 0.03, 30, 0.995, 0.97, 12},
    {"golden car, C, 15 m/s", "iso_road", "golden_car", "C", 15, 100, 0.03, 60, 0.995, 0.97, 12},
    {"golden car, A, 15 m/s", "iso_road", "golden_car", "A", 15, 100, 0.03, 30, 0.995, 0.97, 12},
    {"rover, E, 2 m/s", "iso_road", "rover", "E", 2, 100, 0.03, 10, 0.995, 0.97, 12},
    {"UGV, D, 6 m/s", "iso_road", "ugv", "D", 6, 100, 0.03, 15, 0.995, 0.97, 12},
    {"paper's road, 1 kHz", "paper_clean", "paper", "default", 5, 1000, 0.024, 600, 0.999, 0.997, 4},
    {"paper's road, 1 kHz", "paper_clean", "paper", "default", 5, 1000, 0.024, 600, 0.9998, 0.998, 4},
    {"paper's road, 1 kHz", "paper_clean", "paper", "default", 5, 1000, 0.024, 3000, 0.9998, 0.998, 4},
};

std::vector<DriveSample> driven(const Case& road, int seed, bool step) {
  SimulationOptions options;
  options.scenario = road.scenario;
  options.vehicle = road.vehicle;
  options.iso_class = road.iso_class;
  options.speed = road.speed;
  options.rate = road.rate;
  options.noise = road.noise;
  options.duration = kDuration;
  options.seed = seed;
  options.damping_end_fraction = step ? 0.8 : 1.0;
  options.ramp_start = kStepAt;
  options.ramp_end = kStepAt + 1.0 / road.rate;
  return drive(options);
}

// One wrong reading or ten in a row of the wheel's sensor every 10 s, five times as large as the body's motion.
void spoil(std::vector<DriveSample>& drive, double rate) {
  double square = 0.0;
  for (const DriveSample& sample : drive) square += std::pow(sample.truth.sprung_acceleration, 2);
  const double size = 5.0 * std::sqrt(square / static_cast<double>(drive.size()));
  for (int i = 2; i < 7; ++i)
    for (std::size_t j = 0; j < (i % 2 == 0 ? 1U : 10U); ++j)
      drive[static_cast<std::size_t>((10.0 * i + 5.0) * rate) + j].unsprung->acceleration += size;
}

/// Of one drive, by LA.
struct Course {
  double seen_after = kDuration - kStepAt;  // [s]: 15 of 20 %
  double damping = 0.0, stiffness = 0.0;    // rms errors once settled, before the step
  double opened = 0.0;                      // mean of (slow - lambda) / (slow - fastest), likewise
};

Course follow(const std::vector<DriveSample>& drive, const Case& road, std::optional<double> fastest, double until) {
  MonitorSettings options;
  options.sample_period = 1.0 / road.rate;
  options.integration_horizon = road.horizon / road.rate;
  options.forgetting_factor = road.slow;
  if (fastest) options.fastest_memory = *options.sample_period / (1.0 - *fastest);
  SuspensionMonitor monitor(options);
  Course course;
  double count = 0.0;
  bool seen = false;
  for (const DriveSample& sample : drive) {
    const auto* report = monitor.addSample({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
    if (report == nullptr || !report->has_row) continue;
    const double time = toSeconds(sample.stamp), before = drive.front().truth.damping_to_mass;
    if (time > kStepAt && !seen && report->la.damping_to_mass < 0.85 * before) {
      course.seen_after = time - kStepAt;
      seen = true;
    }
    if (time < kSettled || time > until) continue;
    course.damping += std::pow(report->la.damping_to_mass - sample.truth.damping_to_mass, 2);
    course.stiffness += std::pow(report->la.stiffness_to_mass - sample.truth.stiffness_to_mass, 2);
    course.opened += (road.slow - monitor.forgettingFactor()) / (road.slow - road.fastest);
    count += 1.0;
  }
  course.damping = std::sqrt(course.damping / count);
  course.stiffness = std::sqrt(course.stiffness / count);
  course.opened /= count;
  return course;
}

// Mean T at the constant slow factor, while nothing changes.
double chanceOf(const std::vector<DriveSample>& drive, const Case& road) {
  SuspensionRegression regression({road.horizon, 1.0 / road.rate, IntegrationRule::kBandLimited});
  RecursiveOptions options;
  options.forgetting_factor = road.slow;
  RecursiveLeastAbsolute estimator(kNumStrutParameters, options, {});
  VariableForgetting forgetting(kNumStrutParameters, 2 * road.horizon, road.slow, road.slow);
  double sum = 0.0, count = 0.0;
  for (const DriveSample& sample : drive) {
    const auto* row = regression.push({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
    if (row == nullptr) continue;
    const double innovation = estimator.update(*row);
    forgetting.add(*row, innovation, estimator.meanAbsoluteResidual());
    if (toSeconds(sample.stamp) < kSettled) continue;
    sum += forgetting.drift();
    count += 1.0;
  }
  return sum / count;
}

void printRow(const Case& road) {
  std::vector<double> slow, fast, variable, damping, stiffness, spoilt_damping, spoilt_stiffness;
  std::vector<double> opened, spoilt, chance;
  for (int seed = kFirstSeed; seed < kFirstSeed + road.seeds; ++seed) {
    const std::vector<DriveSample> step = driven(road, seed, true);
    std::vector<DriveSample> healthy = driven(road, seed, false);
    chance.push_back(chanceOf(healthy, road));
    Case quick = road;
    quick.slow = road.fastest;
    const Course constant = follow(step, road, std::nullopt, kStepAt);
    const Course varied = follow(step, road, road.fastest, kStepAt);
    slow.push_back(constant.seen_after);
    fast.push_back(follow(step, quick, std::nullopt, kStepAt).seen_after);
    variable.push_back(varied.seen_after);
    damping.push_back(varied.damping / constant.damping);
    stiffness.push_back(varied.stiffness / constant.stiffness);
    opened.push_back(varied.opened);
    spoil(healthy, road.rate);
    const Course robust = follow(healthy, road, std::nullopt, kDuration);
    const Course tried = follow(healthy, road, road.fastest, kDuration);
    spoilt_damping.push_back(tried.damping / robust.damping);
    spoilt_stiffness.push_back(tried.stiffness / robust.stiffness);
    spoilt.push_back(tried.opened);
  }
  std::printf("| %s | %d | %g to %g | %.4f | %.1f, %.1f, %.1f | %.2f, %.2f | %.2f, %.2f | %.1f, %.1f |\n", road.name,
              road.horizon, road.slow, road.fastest, meanOf(chance), medianOf(slow), medianOf(variable), medianOf(fast),
              medianOf(damping), medianOf(stiffness), medianOf(spoilt_damping), medianOf(spoilt_stiffness),
              100.0 * meanOf(opened), 100.0 * meanOf(spoilt));
  std::fflush(stdout);
}

}  // namespace
}  // namespace suspension_health_monitor

int main() {
  std::printf(
      "| drive | L | lambda | mean T by chance | step seen after [s]: slow, variable, fastest | rms over that of slow "
      "| with wrong readings | open [%%] |\n|---|---|---|---|---|---|---|---|\n");
  for (const auto& road : suspension_health_monitor::kCases) suspension_health_monitor::printRow(road);
}
