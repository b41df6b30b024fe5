#include <gtest/gtest.h>

#include <cmath>

#include "../../benchmark/field_monitor.h"

namespace suspension_health_monitor {
namespace {

class TiltedWheelImu : public testing::TestWithParam<int> {};

// It reads braking and pulling away, 3.75 m/s^2 of it, of which a tilt of 2 degrees makes 0.13 m/s^2.
TEST_P(TiltedWheelImu, NeitherBlamesAStrutNorIsWrongWithConfidence) {
  FieldDrive drive;
  drive.vehicle = kFieldVehicles[static_cast<std::size_t>(GetParam())];
  drive.stops = true;
  drive.tilt = 2.0 * M_PI / 180.0;
  drive.seed = 40 + static_cast<unsigned>(GetParam());
  double valid = 0.0, wrong = 0.0, reports = 0.0;
  follow(drive, {}, 1800.0, [&](double time, const MonitorReport& report) {
    EXPECT_NE(report.health.level, HealthLevel::kWarn) << time;
    EXPECT_NE(report.health.level, HealthLevel::kError) << time;
    reports += 1.0;
    if (!report.estimate.valid()) return;
    valid += 1.0;
    const double off = report.estimate.stiffness_to_mass - drive.vehicle.b0;
    wrong += std::abs(off) > 3.0 * report.estimate.stiffness_to_mass_stddev ? 1.0 : 0.0;
  });
  EXPECT_GT(valid, 0.3 * reports);  // of two thirds in which it drives
  EXPECT_LT(wrong, 0.03 * valid);
}

INSTANTIATE_TEST_SUITE_P(Vehicles, TiltedWheelImu, testing::Range(0, 4));

}  // namespace
}  // namespace suspension_health_monitor
