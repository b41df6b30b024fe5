// Prints the table of doc/forgetting.md: how late LS and LA follow the paper's ramp of the damping and a step of it,
// how much they scatter, and what faults do to them, against the forgetting factor; and that of LA whose forgetting
// factor falls while its residuals are correlated with the regressors.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "../test/core/estimation_error.h"
#include "../test/core/simulated_drive.h"
#include "suspension_health_monitor/identification/suspension_regression.h"
#include "suspension_health_monitor/pi.h"
#include "suspension_health_monitor/simulation/road.h"
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

// The paper's strut on the paper's road, until it stands after a stop that takes `brake` seconds. Midpoint rule, 1 ms.
class BrakedDrive {
 public:
  static constexpr double kStop = 57.0;  // [s]

  explicit BrakedDrive(double brake) : brake_(brake) {}

  struct Accelerations {
    double sprung, unsprung;
  };

  /// @return what ideal sensors read, 20 ms after the last time.
  Accelerations next() {
    const Accelerations now{bodyAt(t_, z_, v_), wheelAt(t_).acceleration};
    constexpr double h = 1e-3;
    for (int k = 0; k < 20; ++k) {
      const double a = bodyAt(t_, z_, v_), middle = v_ + 0.5 * h * a;
      const double a_middle = bodyAt(t_ + 0.5 * h, z_ + 0.5 * h * v_, middle);
      z_ += h * middle;
      v_ += h * a_middle;
      t_ += h;
    }
    return now;
  }

 private:
  // The speed falls like half a cosine.
  RoadPoint wheelAt(double t) const {
    const double x = std::clamp(t - kStop, 0.0, brake_), angle = kPi * x / brake_;
    const double s = std::min(t, kStop) + 0.5 * x + 0.5 * brake_ / kPi * std::sin(angle);
    const double rate = 0.5 + 0.5 * std::cos(angle), slowing = -0.5 * kPi / brake_ * std::sin(angle);
    const RoadPoint road = paperRoad(s);
    return {road.height, road.rate * rate, road.acceleration * rate * rate + road.rate * slowing};
  }

  double bodyAt(double t, double z, double v) const {
    const RoadPoint wheel = wheelAt(t);
    return 3.0 * (wheel.rate - v) + 13.8 * (wheel.height - z);
  }

  double brake_, t_ = 0.0, z_ = 0.0, v_ = 0.0;
};

// A drive, a stop, 24 h of nothing but the sensors' noise, then the road again.
void printParked(const char* rule, double brake, double body_noise, double wheel_noise) {
  constexpr long kDay = 24L * 3600 * 50, kSecond = 50;
  MonitorOptions options;
  options.sample_period = 0.02;
  options.forgetting_rule = rule;
  SuspensionMonitor monitor(options);
  Stamp stamp{};
  std::mt19937_64 engine(7);
  std::normal_distribution<double> noise;
  const auto add = [&](const BrakedDrive::Accelerations& read) {
    stamp += std::chrono::milliseconds(20);
    monitor.addSample({stamp, read.sprung + body_noise * noise(engine), read.unsprung + wheel_noise * noise(engine)});
    return monitor.report().la;
  };
  BrakedDrive drive(brake), next_drive(brake);
  StrutEstimate stop, day, soon, next;
  for (long k = 0; k < std::lround((BrakedDrive::kStop + brake) * kSecond); ++k) stop = add(drive.next());
  for (long k = 0; k < 5 * kSecond; ++k) add(drive.next());  // the body comes to rest
  for (long k = 0; k < kDay; ++k) day = add({0.0, 0.0});
  for (long k = 0; k < kSecond; ++k) soon = add(next_drive.next());
  for (long k = 0; k < 9 * kSecond; ++k) next = add(next_drive.next());
  std::printf("| %s | %.1f s | %g, %g | %.2f, %.2f | %.1f, %.1f | %.3f, %.3f | %.2f, %.1f; %.2f, %.1f |\n", rule, brake,
              body_noise, wheel_noise, stop.damping_to_mass, day.damping_to_mass, stop.stiffness_to_mass,
              day.stiffness_to_mass, stop.damping_to_mass_stddev, day.damping_to_mass_stddev, soon.damping_to_mass,
              soon.stiffness_to_mass, next.damping_to_mass, next.stiffness_to_mass);
  std::fflush(stdout);
}

void printParkedTable() {
  std::printf(
      "\n| rule | stop within | noise of body, wheel [m/s^2] | b1 at the stop, after the day [1/s] | b0 [1/s^2] | stddev "
      "of b1 [1/s] | b1, b0 1 s, 10 s into the next drive |\n|---|---|---|---|---|---|---|\n");
  for (const double brake : {3.0, 0.3}) printParked("exponential", brake, 0.024, 0.024);
  for (const double brake : {3.0, 0.3}) printParked("directional", brake, 0.024, 0.024);
  printParked("directional", 3.0, 0.024, 0.072);
  printParked("directional", 3.0, 0.072, 0.024);
  printParked("directional", 3.0, 0.002, 0.002);
  printParked("directional", 3.0, 0.1, 0.1);
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  if (only != "parked") suspension_health_monitor::printTable();
  suspension_health_monitor::printParkedTable();
}
