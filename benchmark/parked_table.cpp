// Prints what a day parked does to the estimates; doc/uncertainty.md quotes it.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>

#include "../test/core/braked_road.h"
#include "../test/core/paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

struct Accelerations {
  double sprung, unsprung;
};

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
    return kPaperB1 * (wheel.rate - v) + kPaperB0 * (wheel.height - z);
  }

  Road wheel_;
  double t_ = 0.0, z_ = 0.0, v_ = 0.0;
};

// A drive, a stop, 24 h of nothing but the sensors' noise, then the road again: LA of either preset, and the estimate.
void printParked(const char* preset, StrutEstimate ModelReport::*which, double brake, double body_noise,
                 double wheel_noise) {
  constexpr long kDay = 24L * 3600 * 50, kSecond = 50;
  MonitorSettings options = MonitorOptions::of(preset);
  options.sample_period = 0.02;
  SuspensionMonitor monitor(options);
  Stamp stamp{};
  std::mt19937_64 engine(7);
  std::normal_distribution<double> noise;
  const auto add = [&](const Accelerations& read) {
    stamp += std::chrono::milliseconds(20);
    monitor.addSample({stamp, read.sprung + body_noise * noise(engine), read.unsprung + wheel_noise * noise(engine)});
    return monitor.report().*which;
  };
  BrakedDrive drive(brake), next_drive(brake);
  StrutEstimate stop, day, soon, next;
  for (long k = 0; k < std::lround((BrakedDrive::kStop + brake) * kSecond); ++k) stop = add(drive.next());
  for (long k = 0; k < 5 * kSecond; ++k) add(drive.next());  // the body comes to rest
  for (long k = 0; k < kDay; ++k) day = add({0.0, 0.0});
  for (long k = 0; k < kSecond; ++k) soon = add(next_drive.next());
  for (long k = 0; k < 9 * kSecond; ++k) next = add(next_drive.next());
  std::printf("| %s, %s | %.1f s | %g, %g | %.2f, %.2f | %.1f, %.1f | %.3f, %.3f | %.2f, %.1f; %.2f, %.1f |\n",
              which == &ModelReport::la ? "LA" : "estimate", preset, brake, body_noise, wheel_noise,
              stop.damping_to_mass, day.damping_to_mass, stop.stiffness_to_mass, day.stiffness_to_mass,
              stop.damping_to_mass_stddev, day.damping_to_mass_stddev, soon.damping_to_mass, soon.stiffness_to_mass,
              next.damping_to_mass, next.stiffness_to_mass);
  std::fflush(stdout);
}

void printParkedTable() {
  std::printf(
      "| estimate, preset | stop within | noise of body, wheel [m/s^2] | b1 at the stop, after the day [1/s] | b0 "
      "[1/s^2] "
      "| stddev of b1 [1/s] | b1, b0 1 s, 10 s into the next drive |\n|---|---|---|---|---|---|---|\n");
  for (const double brake : {3.0, 0.3}) printParked("paper", &ModelReport::la, brake, 0.024, 0.024);
  for (const auto which : {&ModelReport::la, &ModelReport::estimate})
    for (const double brake : {3.0, 0.3}) printParked("default", which, brake, 0.024, 0.024);
  printParked("default", &ModelReport::estimate, 3.0, 0.024, 0.072);
  printParked("default", &ModelReport::estimate, 3.0, 0.072, 0.024);
  printParked("default", &ModelReport::estimate, 3.0, 0.002, 0.002);
  printParked("default", &ModelReport::estimate, 3.0, 0.1, 0.1);
}

int command(const Arguments&) { return printParkedTable(), 0; }

const AddTable kAdded("parked", {"", command});

}  // namespace
}  // namespace suspension_health_monitor
