// What the sampling cannot show, and what no strut does: said of the input, not of strut or sensor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/strut_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSimulated = 1000.0, kSampled = 100.0;  // [Hz]
constexpr int kDecimation = 10;

/// What both sensors see, at 1 kHz, without noise.
struct Motion {
  std::vector<double> body, wheel;
};

Motion goldenCar(const std::string& road, double speed, double seconds) {
  SimulationOptions options = scenario("iso_road", seconds);
  options.vehicle = "golden_car";
  options.iso_class = road;
  options.speed = speed;
  options.rate = kSimulated;
  options.noise = 0.0;
  Motion motion;
  for (const DriveSample& sample : drive(options)) {
    motion.body.push_back(sample.sprung->acceleration);
    motion.wheel.push_back(sample.unsprung->acceleration);
  }
  return motion;
}

/// Every tenth value, behind a low-pass of 35 Hz (windowed sinc, Hamming) or as it is.
std::vector<double> decimated(const std::vector<double>& values, bool filtered) {
  constexpr int kTaps = 8 * kDecimation + 1, kMiddle = kTaps / 2;
  std::vector<double> taps(kTaps, 0.0), result;
  for (int i = 0; i < kTaps; ++i) {
    const double x = 2.0 * 35.0 / kSimulated * (i - kMiddle);
    const double window = 0.54 + 0.46 * std::cos(M_PI * (i - kMiddle) / kMiddle);
    taps[static_cast<std::size_t>(i)] =
        2.0 * 35.0 / kSimulated * window * (x == 0.0 ? 1.0 : std::sin(M_PI * x) / (M_PI * x));
  }
  for (std::size_t k = kMiddle; k + kMiddle < values.size(); k += kDecimation) {
    double sum = filtered ? 0.0 : values[k];
    for (std::size_t i = 0; filtered && i < taps.size(); ++i) sum += taps[i] * values[k - kMiddle + i];
    result.push_back(sum);
  }
  return result;
}

/// What was said of a drive: alarms of all of it, the rest from 20 s on.
struct Said {
  long samples = 0, valid = 0, beyond = 0, warned = 0, accused = 0;  // beyond: valid, and off by 3 stddev
  std::string of_input;                                              // at last
  double worst = 0.0;                                                // error of a valid b1 or b0, as a share
};

/// @param engine  amplitude at the body's sensor, 25 to 40 Hz [m/s^2].  @param wheel_noise  of the wheel's [m/s^2].
Said listen(const std::vector<double>& body, const std::vector<double>& wheel, double rate, double engine = 0.0,
            double wheel_noise = 0.024) {
  constexpr double kGoldenB1 = 6.0, kGoldenB0 = 63.3;
  MonitorOptions options;
  options.sample_period = 1.0 / rate;
  options.nominal_damping_to_mass = kGoldenB1;
  options.nominal_stiffness_to_mass = kGoldenB0;
  Said said;
  StrutMonitor monitor(options, [&](const MonitorReport& report) {
    const HealthLevel level = report.health.level;
    said.warned += level == HealthLevel::kWarn || level == HealthLevel::kError ? 1 : 0;
    if (toSeconds(report.stamp) < 20.0) return;
    ++said.samples;
    said.valid += report.estimate.valid() ? 1 : 0;
    said.accused += report.health.sensor.fault != SensorFault::kNone ? 1 : 0;
    if (!report.estimate.valid()) return;
    const double off = report.estimate.stiffness_to_mass - kGoldenB0;
    said.beyond += std::abs(off) > 3.0 * report.estimate.stiffness_to_mass_stddev ? 1 : 0;
    said.worst = std::max({said.worst, std::abs(report.estimate.damping_to_mass / kGoldenB1 - 1.0),
                           std::abs(report.estimate.stiffness_to_mass / kGoldenB0 - 1.0)});
  });
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.024), noise_of_wheel(0.0, wheel_noise);
  double phase = 0.0;
  for (std::size_t k = 0; k < body.size(); ++k) {
    const double time = static_cast<double>(k) / rate;
    phase += 2.0 * M_PI * (25.0 + 15.0 * std::fmod(time, 60.0) / 60.0) / rate;
    const Stamp stamp = fromSeconds(1.0 + time);
    monitor.push(Side::kSprung, stamp, 9.81 + body[k] + engine * std::sin(phase) + noise(random));
    monitor.push(Side::kUnsprung, stamp, 9.81 + wheel[k] + noise_of_wheel(random));
    if (const std::string now = describeShaking(monitor.input()); time > 20.0 && !now.empty()) said.of_input = now;
  }
  return said;
}

TEST(Sampling, OfFilteredReadingsIsNeverDoubted) {
  for (const char* road : {"A", "C", "E"})
    for (const double speed : {3.0, 12.0, 30.0}) {
      SCOPED_TRACE(std::string(road) + " at " + std::to_string(speed));
      const Motion motion = goldenCar(road, speed, 60.0);
      const Said said = listen(decimated(motion.body, true), decimated(motion.wheel, true), kSampled);
      EXPECT_EQ(said.of_input, "");
      EXPECT_GT(said.valid, 0.9 * said.samples);
      EXPECT_EQ(said.warned, 0);
    }
}

// At 20 m/s what is folded back lies above the strut's band and does no harm; from 36 m/s on it drives a strut that is
// not there.
TEST(Sampling, WithoutAFilterIsDoubtedWhereItDoesHarm) {
  for (const double speed : {20.0, 36.0, 45.0}) {
    SCOPED_TRACE(speed);
    const Motion motion = goldenCar("C", speed, 120.0);
    const Said said = listen(decimated(motion.body, false), decimated(motion.wheel, false), kSampled);
    EXPECT_EQ(said.warned, 0);
    EXPECT_LE(said.beyond, 0.05 * said.samples);
    if (speed < 30.0) {
      EXPECT_GT(said.valid, 0.9 * said.samples);
    }
  }
}

TEST(Sampling, WithoutAFilterTheEstimateOverTheWholeDriveIsDoubtedOrRight) {
  const Motion motion = goldenCar("C", 45.0, 120.0);
  for (const bool filtered : {true, false}) {
    SCOPED_TRACE(filtered);
    const std::vector<double> body = decimated(motion.body, filtered), wheel = decimated(motion.wheel, filtered);
    Drive drive;
    for (std::size_t k = 0; k < body.size(); ++k)
      drive.samples.push_back({fromSeconds(static_cast<double>(k) / kSampled), body[k], wheel[k]});
    const StrutEstimate whole = identify({drive}).estimate;
    EXPECT_TRUE(whole.valid() || !filtered) << describe(whole.doubt);
    if (!whole.valid()) continue;
    EXPECT_LT(std::abs(whole.damping_to_mass - 6.0), 3.0 * whole.damping_to_mass_stddev);
    EXPECT_LT(std::abs(whole.stiffness_to_mass - 63.3), 3.0 * whole.stiffness_to_mass_stddev);
  }
}

// Ten times the body's noise on the wheel pulls b0 down, by a tenth on class C and nearly to nothing on A: that is in
// the interval, or nothing is told, and it is no fault of the spring.
TEST(Sampling, NoiseOfTheWheelsSensorAloneIsInTheInterval) {
  double samples = 0.0, beyond = 0.0;
  for (const char* road : {"A", "B", "C"})
    for (const double speed : {8.0, 25.0}) {
      SCOPED_TRACE(std::string(road) + " at " + std::to_string(speed));
      const Motion motion = goldenCar(road, speed, 120.0);
      const Said said = listen(decimated(motion.body, true), decimated(motion.wheel, true), kSampled, 0.0, 0.3);
      EXPECT_EQ(said.warned, 0);
      samples += said.samples;
      beyond += said.beyond;
    }
  EXPECT_LE(beyond, 0.01 * samples);
}

TEST(Vibration, OfAnEngineIsSaidOfTheInputAndAccusesNobody) {
  const Motion motion = goldenCar("B", 5.0, 130.0);
  for (const int step : {5, 10})  // 200 and 100 Hz
    for (const double engine : {0.5, 1.5}) {
      SCOPED_TRACE(std::to_string(step) + ", " + std::to_string(engine));
      std::vector<double> body, wheel;
      for (std::size_t k = 0; k < motion.body.size(); k += static_cast<std::size_t>(step)) {
        const bool stands = k >= 60000 && k < 90000;
        body.push_back(stands ? 0.0 : motion.body[k]);
        wheel.push_back(stands ? 0.0 : motion.wheel[k]);
      }
      const Said said = listen(body, wheel, kSimulated / step, engine);
      EXPECT_NE(said.of_input.find("the sprung IMU shakes above the strut's band"), std::string::npos) << said.of_input;
      EXPECT_EQ(said.accused, 0);
      EXPECT_EQ(said.warned, 0);
    }
}

}  // namespace
}  // namespace suspension_health_monitor
