#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "body_drive.h"
#include "suspension_health_monitor/internal/simulation/sensors.h"

namespace suspension_health_monitor {
namespace {

SimulationOptions quiet(const std::string& vehicle = "golden_car") {
  SimulationOptions options = swayingDrive(vehicle, 1, 10.0);
  options.noise = options.gyro_noise = 0.0;
  return options;
}

std::vector<DriveSample> driveWith(const ActiveMeasurementEffect& hidden, SimulationOptions options = quiet()) {
  options.hidden_faults = {hidden};
  return drive(options);
}

TEST(SwayOf, HasTheRmsThatIsAskedForAndItsDerivativeIsOne) {
  const auto sway = swayOf(swayingDrive("golden_car", 7));
  std::array<double, 2> acceleration{}, rate{};
  constexpr int kMoments = 60000;
  for (int k = 0; k < kMoments; ++k) {
    const double t = 0.01 * k, h = 1e-4;
    const Sway now = sway(t), before = sway(t - h), after = sway(t + h);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      acceleration[axis] += now.acceleration[axis] * now.acceleration[axis];
      rate[axis] += now.angular_rate[axis] * now.angular_rate[axis];
      ASSERT_NEAR(now.angular_acceleration[axis], (after.angular_rate[axis] - before.angular_rate[axis]) / (2 * h),
                  1e-4);
    }
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {  // sines of 0.1 Hz and more: 600 s are 60 periods of the slowest
    EXPECT_NEAR(std::sqrt(acceleration[axis] / kMoments), 1.0, 0.05);
    EXPECT_NEAR(std::sqrt(rate[axis] / kMoments), 0.1, 0.005);
  }
}

TEST(SimulatedFaults, AreAbsentUnlessHidden) {
  SimulationOptions still = quiet();
  still.body_acceleration = still.body_rate = 0.0;
  const std::vector<DriveSample> plain = drive(still), swaying = drive(quiet());
  for (std::size_t k = 0; k < plain.size(); ++k) {
    ASSERT_EQ(plain[k].sprung->acceleration, plain[k].truth.sprung_acceleration);
    ASSERT_EQ(swaying[k].sprung->acceleration, plain[k].sprung->acceleration);  // the body sways beside the strut
    ASSERT_EQ(plain[k].body.acceleration[0], 0.0);
    ASSERT_EQ(plain[k].body.angular_rate[1], 0.0);
  }
}

TEST(SimulatedFaults, BiasGainTiltAndLeverArmChangeTheReadingAsTheyShould) {
  const auto sway = swayOf(quiet());
  const auto expectReading = [&](const ActiveMeasurementEffect& hidden, const auto& expected) {
    const std::vector<DriveSample> samples = driveWith(hidden);
    for (const DriveSample& sample : samples)
      ASSERT_NEAR(sample.sprung->acceleration,
                  expected(sample.truth.sprung_acceleration, sway(toSeconds(sample.stamp))), 1e-12)
          << hidden.effect.name;
  };
  expectReading(fault("accelerometer_bias", {0.3}), [](double y, const Sway&) { return y + 0.3; });
  expectReading(fault("scale_error", {-0.2}), [](double y, const Sway&) { return 0.8 * y; });
  expectReading(fault("mount_tilt", {0.02, -0.05}),
                [](double y, const Sway& s) { return y + 0.02 * s.acceleration[0] - 0.05 * s.acceleration[1]; });
  expectReading(fault("lever_arm", {0.5, -0.3}), [](double y, const Sway& s) {
    return y - 0.3 * s.angular_acceleration[0] - 0.5 * s.angular_acceleration[1];
  });
}

TEST(SimulatedFaults, ClockOffsetReadsWhatWasBefore) {
  SimulationOptions fine = quiet();
  fine.rate = 1000.0;
  const std::vector<DriveSample> truth = drive(fine);
  for (const double delay : {0.004, -0.003, 0.025}) {
    const std::vector<DriveSample> samples = driveWith(fault("clock_offset", {delay}));
    for (std::size_t k = 5; k + 5 < samples.size(); ++k) {
      const auto then = static_cast<std::size_t>(std::lround(1000.0 * (0.01 * static_cast<double>(k) - delay)));
      ASSERT_NEAR(samples[k].sprung->acceleration, truth[then].truth.sprung_acceleration, 1e-6) << delay;
      ASSERT_NEAR(samples[k].truth.sprung_acceleration, truth[10 * k].truth.sprung_acceleration, 1e-6);
      ASSERT_EQ(samples[k].sprung->stamp, samples[k].stamp);
    }
  }
}

TEST(SimulatedFaults, ThatCannotShowAreRefused) {
  const auto refusal = [](const ActiveMeasurementEffect& hidden) {
    SimulationOptions options = swayingDrive("golden_car", 1);
    options.body_acceleration = options.body_rate = 0.0;
    options.hidden_faults = {hidden};
    try {
      validate(options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refusal(fault("mount_tilt", {0.0, 0.02})).find("body_acceleration"), std::string::npos);
  EXPECT_NE(refusal(fault("lever_arm", {0.3, 0.0})).find("body_rate"), std::string::npos);
  EXPECT_EQ(refusal(fault("clock_offset", {0.003})), "accepted");
  ActiveMeasurementEffect unknown = fault("scale_error", {0.1});
  unknown.effect.name = "gremlin";
  EXPECT_NE(refusal(unknown).find("gremlin, must be one of"), std::string::npos);
}

}  // namespace
}  // namespace suspension_health_monitor
