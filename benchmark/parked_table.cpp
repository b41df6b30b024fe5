// Prints the tables of doc/forgetting.md about rest: what tells rows of a drive from those of a vehicle that stands,
// and what a day parked does to the estimates.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "../test/core/braked_road.h"
#include "../test/core/paper_drive.h"
#include "suspension_health_monitor/internal/identification/excitation.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

const Eigen::Vector2d kStrut(kPaperB1, kPaperB0);

struct Accelerations {
  double sprung, unsprung;
};

// What rows say of a strut: share of psi^2 that the best one explains, and how far the regressors are clear of noise.
struct Saying {
  double share, damping, stiffness;
};

Saying sayingOf(const RowMoments& rows, const RegressorNoise& noise) {
  const StrutFit fit = rows.bestStrut(2.0 * kStrut);
  const auto [damping, stiffness] = excitationOf(rows, fit, noise);
  return {1.0 - fit.rest / rows.output, damping, stiffness};
}

using Readings = std::function<Accelerations(long)>;

std::vector<Saying> sayings(long samples, const Readings& read, int blocks) {
  const IntegralFilterOptions filter{30, 0.02, IntegrationRule::kBandLimited};
  const RegressorNoise noise(filter);
  SuspensionRegression regression(filter);
  RunningMean offset(0.9975);
  RowMoments rows;
  std::vector<Saying> all;
  for (long k = 0, count = 0; k < samples; ++k) {
    const auto [sprung, unsprung] = read(k);
    const RegressionRow* row = regression.push({Stamp{}, sprung, unsprung});
    if (row == nullptr) continue;
    offset.add(row->regressor[kStiffnessToMass]);
    if (k < 500) continue;
    rows.add(row->regressor[kDampingToMass], row->regressor[kStiffnessToMass] - offset.mean(), row->output);
    if (++count % (64 * blocks) != 0) continue;
    all.push_back(sayingOf(rows, noise));
    rows = RowMoments();
  }
  return all;
}

double share(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(p * static_cast<double>(values.size())))];
}

// Worst: least of a drive, most of a rest.
void printSaying(const std::string& name, bool driven, long samples, const Readings& read) {
  std::printf("| %s |", name.c_str());
  for (const int blocks : {2, 8}) {
    std::vector<double> shares, damping, stiffness;
    for (const Saying& saying : sayings(samples, read, blocks)) {
      shares.push_back(saying.share);
      damping.push_back(saying.damping);
      stiffness.push_back(saying.stiffness);
    }
    const double worst = driven ? 0.0 : 1.0;
    std::printf(" %.2f, %.2f | %.2g, %.2g | %.2g, %.2g |", share(shares, 0.5), share(shares, worst),
                share(damping, 0.5), share(damping, worst), share(stiffness, 0.5), share(stiffness, worst));
  }
  std::printf("\n");
  std::fflush(stdout);
}

void printDriven(const std::string& name, double b1, double b0, double smoother, double noise) {
  SimulationOptions options;
  options.damping_end_fraction = 1.0;
  options.duration = 600.0;
  options.noise = 0.0;
  options.damping_to_mass = b1;
  options.stiffness_to_mass = b0;
  const std::vector<CornerSample> drive = simulate(options);
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal(0.0, noise);
  printSaying(name, true, static_cast<long>(drive.size()), [&](long k) -> Accelerations {
    const CornerSample& sample = drive[static_cast<std::size_t>(k)];
    const double body = normal(engine), wheel = normal(engine);
    return {sample.sprung_acceleration / smoother + body, sample.unsprung_acceleration / smoother + wheel};
  });
}

void printRest(const std::string& name, double body, double wheel, double amplitude, double frequency) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  printSaying(name, false, 4320000, [&](long k) -> Accelerations {
    const double shaken = amplitude * std::sin(2.0 * kPi * frequency * 0.02 * static_cast<double>(k));
    return {shaken + body * normal(engine), wheel * normal(engine)};
  });
}

void printSeparation() {
  std::printf(
      "| rows | 2 blocks: share of psi explained, median, worst | damping's excitation | stiffness' | 8 blocks: share "
      "| damping's | stiffness' |\n|---|---|---|---|---|---|---|\n");
  for (const double smoother : {1.0, 3.0, 5.0, 10.0, 20.0})
    printDriven("road / " + std::to_string(std::lround(smoother)), kStrut[0], kStrut[1], smoother, 0.024);
  printDriven("noise 0.2", kStrut[0], kStrut[1], 1.0, 0.2);
  const double light = 0.04 * std::sqrt(kStrut[1]);
  for (const double smoother : {1.0, 10.0})
    printDriven("zeta 0.02, road / " + std::to_string(std::lround(smoother)), light, kStrut[1], smoother, 0.024);
  for (const double smoother : {1.0, 5.0, 10.0}) {
    const std::string road = ", road / " + std::to_string(std::lround(smoother));
    printDriven("b1 to 10 %" + road, 0.1 * kStrut[0], kStrut[1], smoother, 0.024);
    printDriven("b0 to 50 %" + road, kStrut[0], 0.5 * kStrut[1], smoother, 0.024);
  }
  printRest("rest, 24 h", 0.024, 0.024, 0.0, 0.0);
  printRest("rest, wheel's noise x 3", 0.024, 0.072, 0.0, 0.0);
  printRest("rest, body's noise x 3", 0.072, 0.024, 0.0, 0.0);
  for (const double frequency : {3.0, 12.0, 22.0})
    printRest("idling at " + std::to_string(std::lround(frequency)) + " Hz, 0.5 m/s^2", 0.024, 0.024, 0.5, frequency);
  std::printf("\n");
}

// The paper's strut on the paper's road, until it stands after a stop that takes `brake` seconds. Midpoint rule, 1 ms.
class BrakedDrive {
 public:
  static constexpr double kStop = 57.0;  // [s]

  explicit BrakedDrive(double brake) : wheel_(brakedPaperRoad(kStop, brake)) {}

  /// @return what ideal sensors read, 20 ms after the last time.
  Accelerations next() {
    const Accelerations now{bodyAt(t_, z_, v_), wheel_(t_).acceleration};
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
  double bodyAt(double t, double z, double v) const {
    const RoadPoint wheel = wheel_(t);
    return kStrut[0] * (wheel.rate - v) + kStrut[1] * (wheel.height - z);
  }

  Road wheel_;
  double t_ = 0.0, z_ = 0.0, v_ = 0.0;
};

// A drive, a stop, 24 h of nothing but the sensors' noise, then the road again.
void printParked(bool forgets_unexcited, double brake, double body_noise, double wheel_noise) {
  constexpr long kDay = 24L * 3600 * 50, kSecond = 50;
  MonitorSettings options;
  options.sample_period = 0.02;
  options.estimators.forgets_unexcited = forgets_unexcited;
  SuspensionMonitor monitor(options);
  Stamp stamp{};
  std::mt19937_64 engine(7);
  std::normal_distribution<double> noise;
  const auto add = [&](const Accelerations& read) {
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
  std::printf("| %s | %.1f s | %g, %g | %.2f, %.2f | %.1f, %.1f | %.3f, %.3f | %.2f, %.1f; %.2f, %.1f |\n",
              forgets_unexcited ? "exponential" : "directional", brake, body_noise, wheel_noise, stop.damping_to_mass,
              day.damping_to_mass, stop.stiffness_to_mass, day.stiffness_to_mass, stop.damping_to_mass_stddev,
              day.damping_to_mass_stddev, soon.damping_to_mass, soon.stiffness_to_mass, next.damping_to_mass,
              next.stiffness_to_mass);
  std::fflush(stdout);
}

void printParkedTable() {
  std::printf(
      "| rule | stop within | noise of body, wheel [m/s^2] | b1 at the stop, after the day [1/s] | b0 [1/s^2] "
      "| stddev of b1 [1/s] | b1, b0 1 s, 10 s into the next drive |\n|---|---|---|---|---|---|---|\n");
  for (const double brake : {3.0, 0.3}) printParked(true, brake, 0.024, 0.024);
  for (const double brake : {3.0, 0.3}) printParked(false, brake, 0.024, 0.024);
  printParked(false, 3.0, 0.024, 0.072);
  printParked(false, 3.0, 0.072, 0.024);
  printParked(false, 3.0, 0.002, 0.002);
  printParked(false, 3.0, 0.1, 0.1);
}

}  // namespace
}  // namespace suspension_health_monitor

int main() {
  suspension_health_monitor::printSeparation();
  suspension_health_monitor::printParkedTable();
}
