// A vehicle that stands still, for hours, and sensors that are stuck: nothing may overflow, "cannot tell" must be said,
// and the next drive must give right estimates soon.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "monitor_settings.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

// 2.2 hours and 6.7 minutes at 50 Hz. Between them 1000 memories of 2 s: a double has forgotten e^-745.
constexpr int kHours = 400000, kThousandMemories = 100000, kMinutes = 20000;

struct Readings {
  double sprung, unsprung;
};

class ParkedVehicle : public testing::Test {
 protected:
  const MonitorReport& add(const Readings& readings) {
    stamp_ += std::chrono::milliseconds(20);
    return *monitor_.addSample({stamp_, readings.sprung, readings.unsprung});
  }

  // Gravity stays in the readings, as at rest.
  void driveFor(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
      add({drive_[k].sprung_acceleration + kGravity, drive_[k].unsprung_acceleration + kGravity});
  }

  // From 70 s on all that is known is older than 60 s.
  void park(int samples, const std::function<Readings()>& readings) {
    for (int k = 0; k < samples; ++k) {
      const MonitorReport& report = add(readings());
      if (!report.has_row) continue;
      for (const StrutEstimate& estimate : {report.estimate, report.ls, report.la}) {
        if (!(estimate.effective_rows > 0.0)) {  // parked from the start: nothing is known
          ASSERT_FALSE(estimate.valid()) << k;
          continue;
        }
        ASSERT_TRUE(std::isfinite(estimate.damping_to_mass) && std::isfinite(estimate.stiffness_to_mass)) << k;
        ASSERT_GT(estimate.damping_to_mass_stddev, 0.0) << k;  // infinite: noise may be all that there is
        ASSERT_GT(estimate.stiffness_to_mass_stddev, 0.0) << k;
        ASSERT_TRUE(std::isfinite(estimate.damping_to_mass_stddev + estimate.stiffness_to_mass_stddev) ||
                    !estimate.valid())
            << k;
        ASSERT_TRUE(std::isfinite(estimate.explained)) << k;
        ASSERT_FALSE(k > 3500 && estimate.valid()) << k;
      }
    }
    EXPECT_EQ(monitor_.report().health.level, HealthLevel::kStale);
  }

  void expectRecovery() {
    driveFor(1000);  // 20 s, ten memories
    for (const StrutEstimate& estimate : {monitor_.report().estimate, monitor_.report().ls, monitor_.report().la}) {
      EXPECT_TRUE(estimate.valid());
      EXPECT_NEAR(estimate.damping_to_mass, kPaperB1, std::max(0.15, 3.0 * estimate.damping_to_mass_stddev));
      EXPECT_NEAR(estimate.stiffness_to_mass, kPaperB0, 0.4);
    }
    EXPECT_TRUE(std::isfinite(monitor_.report().comparison.rmse));
    EXPECT_EQ(monitor_.report().health.level, HealthLevel::kOk) << describe(monitor_.report().health);
  }

  void expectParkingIsSurvived(const std::function<Readings()>& readings, int samples = kThousandMemories) {
    park(samples, readings);
    expectRecovery();
    if (HasFatalFailure()) return;
    park(kMinutes, readings);
    expectRecovery();
  }

  static constexpr double kGravity = 9.81;

  double noise() { return 0.024 * normal_(engine_); }

  SuspensionMonitor monitor_{liveOptions()};

 private:
  const std::vector<CornerSample> drive_ = healthyPaperDrive(20.0, 0.024);
  Stamp stamp_{};
  std::mt19937_64 engine_{7};
  std::normal_distribution<double> normal_;
};

TEST_F(ParkedVehicle, WithEqualConstantReadings) {
  expectParkingIsSurvived([] { return Readings{kGravity, kGravity}; }, kHours);
}

TEST_F(ParkedVehicle, WithConstantReadingsOfTwoBiasedSensors) {
  expectParkingIsSurvived([] { return Readings{kGravity, kGravity + 0.12}; });
}

TEST_F(ParkedVehicle, WithNoiseOnly) {
  expectParkingIsSurvived([this] { return Readings{kGravity + noise(), kGravity + noise()}; }, kHours);
}

TEST_F(ParkedVehicle, WithNoiseBelowTheSteps) {
  const auto step = [this] { return kGravity + 0.01 * std::round(noise() / 0.03); };
  expectParkingIsSurvived([&] { return Readings{step(), step()}; });
}

TEST_F(ParkedVehicle, WithTheBodysSensorStuck) {
  expectParkingIsSurvived([this] { return Readings{kGravity, kGravity + 40.0 * noise()}; });
}

TEST_F(ParkedVehicle, WithTheWheelsSensorStuck) {
  expectParkingIsSurvived([this] { return Readings{kGravity + 40.0 * noise(), kGravity}; }, kHours);
}

TEST_F(ParkedVehicle, WithBothSensorsDead) {
  driveFor(1000);
  ASSERT_TRUE(monitor_.report().estimate.valid());
  expectParkingIsSurvived([] { return Readings{0.0, 0.0}; });
}

}  // namespace
}  // namespace suspension_health_monitor
