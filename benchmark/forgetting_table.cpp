// Prints the table of doc/forgetting.md: how late LS and LA follow the paper's ramp of the damping and a step of it,
// how much they scatter, and what faults do to them, against the forgetting factor; and that of LA whose forgetting
// factor falls while its residuals are correlated with the regressors.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "../test/core/estimation_error.h"
#include "../test/core/simulated_drive.h"
#include "suspension_health_monitor/identification/suspension_regression.h"
#include "suspension_health_monitor/pi.h"
#include "suspension_health_monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr int kNumSeeds = 10;

struct Setting {
  std::string name;
  double slow, fast;  // forgetting factors; equal: fixed
  bool absolute;      // LA, else LS
};

// Scores phi_i sgn(e), bounded so that outliers count like any other row, have the mean 0 if the estimate is right.
class Follower : public RecursiveLeastAbsolute {
 public:
  Follower(const Setting& setting)
      : RecursiveLeastAbsolute(kNumStrutParameters, optionsOf(setting), startOf(setting)), setting_(setting) {}

  void take(const RegressionRow& row) {
    const double innovation = update(row);
    const double bounded = std::clamp(innovation / std::max(meanAbsoluteResidual(), 1e-100), -1.0, 1.0);
    double drift = 0.0;
    for (int i = 0; i < kNumStrutParameters; ++i) {
      scores_[i] += kGain * (bounded * row.regressor[i] - scores_[i]);
      sizes_[i] += kGain * (bounded * bounded * row.regressor[i] * row.regressor[i] - sizes_[i]);
      drift = std::max(drift, sizes_[i] > 0.0 ? scores_[i] * scores_[i] / sizes_[i] : 0.0);
    }
    const double share = std::clamp((drift - kStill) / (kMoving - kStill), 0.0, 1.0);
    options_.forgetting_factor = setting_.slow + share * (setting_.fast - setting_.slow);
  }

 private:
  static constexpr double kGain = 1.0 / 60.0, kStill = 0.04, kMoving = 0.15;

  static RecursiveOptions optionsOf(const Setting& setting) {
    return {setting.slow, RecursiveOptions{}.initial_variance, InitialVariance::kRelative};
  }

  static LeastAbsoluteOptions startOf(const Setting& setting) {
    LeastAbsoluteOptions options;
    if (!setting.absolute) options.start_rows = 1000000;  // LS leads to the end
    return options;
  }

  Setting setting_;
  double scores_[kNumStrutParameters] = {}, sizes_[kNumStrutParameters] = {};
};

struct Point {
  double time;
  DriveTruth truth;
  double b1, b0;
};

std::vector<Point> follow(const std::vector<DriveSample>& drive, const Setting& setting) {
  SuspensionRegression regression({30, 0.02, IntegrationRule::kCubic});
  Follower follower(setting);
  std::vector<Point> points;
  for (const DriveSample& sample : drive) {
    const RegressionRow* row =
        regression.push({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
    if (row == nullptr) continue;
    follower.take(*row);
    points.push_back({toSeconds(sample.stamp), sample.truth, follower.parameters()[kDampingToMass],
                      follower.parameters()[kStiffnessToMass]});
  }
  return points;
}

std::vector<DriveSample> driven(SimulationOptions options, int seed) {
  options.seed = seed;
  return drive(options);
}

SimulationOptions stepDrive() {
  SimulationOptions options;
  options.damping_end_fraction = 0.8;
  options.ramp_start = 40.0;
  options.ramp_end = 40.02;
  options.duration = 80.0;
  return options;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double rms(const std::vector<Point>& points, double from, double to, bool damping) {
  double sum = 0.0, count = 0.0;
  for (const Point& point : points) {
    if (point.time <= from || point.time > to) continue;
    sum += std::pow(damping ? point.b1 - point.truth.damping_to_mass : point.b0 - point.truth.stiffness_to_mass, 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

double lagOnRamp(const std::vector<Point>& points) {
  double sum = 0.0, count = 0.0;
  for (const Point& point : points) {
    if (point.time < 55.0 || point.time > 100.0) continue;
    sum += point.b1 - point.truth.damping_to_mass;
    ++count;
  }
  return sum / count * 60.0;  // the ramp falls by 1/60 1/s per s
}

// Until 15 of the 20 % have been seen.
double timeToSee(const std::vector<Point>& points) {
  for (const Point& point : points)
    if (point.time > 40.0 && point.b1 < 0.85 * 3.0) return point.time - 40.0;
  return 40.0;
}

struct Drives {
  std::vector<std::vector<DriveSample>> ramp, step, loss, stops;
};

Drives simulateAll() {
  Drives drives;
  SimulationOptions loss, stops;
  loss.scenario = "paper_outliers";
  stops.scenario = "paper_saturation";
  for (int seed = 1; seed <= kNumSeeds; ++seed) {
    drives.ramp.push_back(driven({}, seed));
    drives.step.push_back(driven(stepDrive(), seed));
    drives.loss.push_back(driven(loss, seed));
    drives.stops.push_back(driven(stops, seed));
  }
  return drives;
}

void printRow(const Setting& setting, const Drives& drives) {
  std::vector<double> lag, scatter1, scatter0, step, loss1, loss0, stops1, stops0;
  for (std::size_t i = 0; i < drives.ramp.size(); ++i) {
    const auto ramp = follow(drives.ramp[i], setting);
    lag.push_back(lagOnRamp(ramp));
    scatter1.push_back(rms(ramp, 10.0, 40.0, true));
    scatter0.push_back(rms(ramp, 10.0, 40.0, false));
    step.push_back(timeToSee(follow(drives.step[i], setting)));
    const auto lost = follow(drives.loss[i], setting), stopped = follow(drives.stops[i], setting);
    loss1.push_back(rms(lost, 10.0, 120.0, true));
    loss0.push_back(rms(lost, 10.0, 120.0, false));
    stops1.push_back(rms(stopped, 10.0, 120.0, true));
    stops0.push_back(rms(stopped, 10.0, 120.0, false));
  }
  std::printf("| %s | %.1f | %.1f | %.3f, %.3f | %.3f, %.3f | %.3f, %.3f |\n", setting.name.c_str(), median(lag),
              median(step), median(scatter1), median(scatter0), median(loss1), median(loss0), median(stops1),
              median(stops0));
  std::fflush(stdout);
}

void printTable() {
  std::printf(
      "| estimator, lambda | lag on the ramp [s] | -15 %% of a step of -20 %% seen after [s] | rms while nothing "
      "changes | data loss | end stops |\n|---|---|---|---|---|---|\n");
  const Drives drives = simulateAll();
  char name[64];
  for (const bool absolute : {false, true}) {
    for (const double lambda : {0.97, 0.98, 0.985, 0.99, 0.995}) {
      std::snprintf(name, sizeof name, "%s, %g", absolute ? "LA" : "LS", lambda);
      printRow({name, lambda, lambda, absolute}, drives);
    }
  }
  for (const double slow : {0.995, 0.99}) {
    for (const double fast : {0.98, 0.97}) {
      std::snprintf(name, sizeof name, "LA, variable %g to %g", slow, fast);
      printRow({name, slow, fast, true}, drives);
    }
  }
}

}  // namespace
}  // namespace suspension_health_monitor

int main() { suspension_health_monitor::printTable(); }
