// Something else than the wheel moves the body: wind, people who get in or load, an engine.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

// A quarter of a golden car whose body is moved by a force per mass, as by wind, at the frequencies where the body,
// with the wheel on its tyre, looks most like a strut without a damper.
class RockedCar {
 public:
  static constexpr double kRate = 100.0;

  explicit RockedCar(double frequency, double force) : frequency_(frequency), force_(force) {}

  CornerSample next() {
    constexpr int kSteps = 20;
    constexpr double h = 1.0 / (kRate * kSteps), kWheelMass = 0.15, kTyre = 653.0;
    double body = 0.0, wheel = 0.0;
    for (int step = 0; step < kSteps; ++step, t_ += h) {
      const double strut = 63.3 * (w_ - z_) + 6.0 * (w_rate_ - z_rate_);
      body = strut + force_ * std::sin(2.0 * M_PI * frequency_ * t_);
      wheel = -(strut + kTyre * w_) / kWheelMass;
      z_ += h * (z_rate_ += h * body);
      w_ += h * (w_rate_ += h * wheel);
    }
    return {Stamp{}, body + noise_(engine_), wheel + noise_(engine_)};
  }

 private:
  double frequency_, force_;
  double t_ = 0.0, z_ = 0.0, z_rate_ = 0.0, w_ = 0.0, w_rate_ = 0.0;
  std::mt19937_64 engine_{8};
  std::normal_distribution<double> noise_{0.0, 0.024};
};

TEST(Health, ParkedCarThatTheWindRocksHasNoBrokenStrut) {
  SimulationOptions road = scenario("iso_road", 60.0);
  road.vehicle = "golden_car";
  road.rate = RockedCar::kRate;
  const std::vector<DriveSample> driven = drive(road);
  for (const double frequency : {0.8, 1.0, 1.27, 1.5, 2.0})
    for (const double force : {0.1, 0.3}) {
      MonitorSettings options;
      options.sample_period = 1.0 / RockedCar::kRate;
      options.integration_horizon = 0.3;
      options.forgetting_factor = 0.995;
      options.nominal_damping_to_mass = 6.0;
      options.nominal_stiffness_to_mass = 63.3;
      SuspensionMonitor monitor(options);
      Stamp stamp{};
      int alarms = 0;
      const auto add = [&](CornerSample sample) {
        sample.stamp = stamp += fromSeconds(*options.sample_period);
        monitor.addSample(sample);
        const HealthLevel level = monitor.report().health.level;
        alarms += level == HealthLevel::kWarn || level == HealthLevel::kError ? 1 : 0;
      };
      const auto driveOn = [&] {
        for (const DriveSample& sample : driven) add({{}, sample.sprung->acceleration, sample.unsprung->acceleration});
        EXPECT_EQ(monitor.report().health.level, HealthLevel::kOk) << frequency << ' ' << force;
      };
      driveOn();
      RockedCar car(frequency, force);
      for (int k = 0; k < 90 * RockedCar::kRate; ++k) add(car.next());
      EXPECT_FALSE(monitor.report().estimate.valid()) << frequency << ' ' << force;
      EXPECT_EQ(monitor.report().health.level, HealthLevel::kStale) << frequency << ' ' << force;
      driveOn();
      EXPECT_EQ(alarms, 0) << frequency << ' ' << force;
    }
}

}  // namespace
}  // namespace suspension_health_monitor
