// An offset between the two sensors is no part of the strut: it is estimated beside it, and changes nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "paper_drive.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/vehicle/rough_strut.h"

namespace suspension_health_monitor {
namespace {

struct Road {
  const char *scenario, *vehicle, *iso_class;
  double rate, horizon;  // [Hz], [s]
};
constexpr Road kRoads[] = {{"paper_clean", "default", "default", 50, 0.6},
                           {"iso_road", "golden_car", "A", 100, 0.6},
                           {"iso_road", "golden_car", "A", 200, 0.6},
                           {"iso_road", "golden_car", "C", 200, 0.6}};

std::vector<CornerSample> driveOn(const Road& road) {
  SimulationOptions options;
  options.scenario = road.scenario;
  options.vehicle = road.vehicle;
  options.iso_class = road.iso_class;
  options.rate = road.rate;
  options.damping_end_fraction = 1.0;
  options.duration = 120.0;
  return simulate(options);
}

MonitorSettings settingsOf(const Road& road) {
  MonitorOptions options;
  options.sample_period = 1.0 / road.rate;
  options.integration_horizon = road.horizon;
  return options;
}

TEST(SensorOffset, ChangesNoEstimate) {
  for (const Road& road : kRoads) {
    const std::vector<CornerSample> drive = driveOn(road);
    for (const double offset : {0.05, -0.5}) {
      SuspensionMonitor reference(settingsOf(road)), monitor(settingsOf(road));
      for (CornerSample sample : drive) {
        reference.addSample(sample);
        sample.unsprung_acceleration += offset;
        monitor.addSample(sample);
      }
      const StrutEstimate &expected = reference.report().la, &found = monitor.report().la;
      SCOPED_TRACE(std::string(road.vehicle) + road.iso_class + std::to_string(offset));
      EXPECT_TRUE(found.valid());
      const StrutEstimate &blocks_expected = reference.report().estimate, &blocks = monitor.report().estimate;
      EXPECT_TRUE(blocks.valid());
      EXPECT_NEAR(blocks.damping_to_mass, blocks_expected.damping_to_mass, 1e-6 * blocks_expected.damping_to_mass);
      EXPECT_NEAR(blocks.stiffness_to_mass, blocks_expected.stiffness_to_mass,
                  1e-6 * blocks_expected.stiffness_to_mass);
      // What remains is the start, from which another offset was learned.
      EXPECT_NEAR(found.damping_to_mass, expected.damping_to_mass, 1e-3 * expected.damping_to_mass);
      EXPECT_NEAR(found.stiffness_to_mass, expected.stiffness_to_mass, 1e-3 * expected.stiffness_to_mass);
      EXPECT_NEAR(found.offset - expected.offset, offset, 1e-3 * std::abs(offset));
      EXPECT_NEAR(monitor.report().ls.offset - reference.report().ls.offset, offset, 1e-3 * std::abs(offset));
    }
  }
}

TEST(SensorOffset, ChangesNeitherHorizonNorRecordedDrives) {
  for (const Road& road : kRoads) {
    Drive drive{driveOn(road), {}};
    const RoughStrut rough = roughStrut({drive}, 1.0 / road.rate).value();
    const IdentifyResult expected = identify({drive});
    for (CornerSample& sample : drive.samples) sample.unsprung_acceleration += 0.5;
    const IdentifyResult found = identify({drive});
    EXPECT_NEAR(found.estimate.stiffness_to_mass, expected.estimate.stiffness_to_mass,
                1e-3 * expected.estimate.stiffness_to_mass);
    EXPECT_NEAR(found.ls.damping_to_mass, expected.ls.damping_to_mass, 1e-3 * expected.ls.damping_to_mass);
    const RoughStrut with_offset = roughStrut({drive}, 1.0 / road.rate).value();
    EXPECT_EQ(with_offset.horizonSamples(1.0 / road.rate), rough.horizonSamples(1.0 / road.rate));
    EXPECT_NEAR(with_offset.strut.stiffness_to_mass, expected.estimate.stiffness_to_mass,
                0.1 * expected.estimate.stiffness_to_mass);
  }
}

TEST(SensorOffset, MayDrift) {
  for (const Road& road : kRoads) {
    const std::vector<CornerSample> drive = driveOn(road);
    SuspensionMonitor reference(settingsOf(road)), monitor(settingsOf(road));
    double worst = 0.0;
    for (CornerSample sample : drive) {
      reference.addSample(sample);
      sample.unsprung_acceleration += 0.3 * std::sin(2 * M_PI * toSeconds(sample.stamp) / 3600.0);  // as it warms up
      const MonitorReport* report = monitor.addSample(sample);
      if (report == nullptr || !report->estimate.valid() || !reference.report().estimate.valid()) continue;
      const StrutEstimate &expected = reference.report().estimate, &found = report->estimate;
      worst = std::max(worst, std::abs(found.stiffness_to_mass - expected.stiffness_to_mass) /
                                  std::hypot(0.01 * expected.stiffness_to_mass, found.stiffness_to_mass_stddev));
    }
    EXPECT_LT(worst, 2.0) << road.vehicle << road.iso_class << road.rate;
  }
}

// Up to 3 mm/s^2 in a second, on the roads that move the strut least.
TEST(SensorOffset, MayDriftFastWithoutADoubt) {
  for (const Road& road : {kRoads[1], kRoads[2]}) {
    MonitorSettings settings = settingsOf(road);
    settings.nominal_damping_to_mass = 6.0;
    settings.nominal_stiffness_to_mass = 63.3;
    SuspensionMonitor monitor(settings);
    double worst = 0.0;
    int judged = 0, outliers = 0, stale = 0;
    for (CornerSample sample : driveOn(road)) {
      const double time = toSeconds(sample.stamp), offset = 0.3 * std::sin(2 * M_PI * time / 600.0);
      sample.unsprung_acceleration += offset;
      const MonitorReport* report = monitor.addSample(sample);
      if (report == nullptr || time < 30.0) continue;
      worst = std::max({worst, std::abs(report->la.offset - offset), std::abs(report->ls.offset - offset)});
      ++judged;
      outliers += int{report->health.outliers};
      stale += int{report->health.level != HealthLevel::kOk};
    }
    ASSERT_GT(judged, 0);
    EXPECT_LT(worst, 0.03) << road.rate;
    EXPECT_EQ(outliers, 0) << road.rate;
    EXPECT_EQ(stale, 0) << road.rate;
  }
}

TEST(SensorOffset, ParkingIsRecognisedWithIt) {
  const std::vector<CornerSample> drive = driveOn(kRoads[3]);
  double held = 0.0;
  for (const double offset : {0.0, 0.1, -0.5, 2.0}) {
    SuspensionMonitor monitor(settingsOf(kRoads[3]));
    std::mt19937 engine(1);
    std::normal_distribution<double> noise(0.0, 0.03);
    Stamp stamp = drive.front().stamp;
    const auto add = [&](double body, double wheel) {
      monitor.addSample({stamp, body, wheel + offset});
      stamp += fromSeconds(1.0 / kRoads[3].rate);
    };
    for (const CornerSample& sample : drive) add(sample.sprung_acceleration, sample.unsprung_acceleration);
    ASSERT_TRUE(monitor.report().la.valid());
    for (int k = 0; k < 90 * kRoads[3].rate; ++k) add(noise(engine), noise(engine));
    EXPECT_EQ(monitor.report().estimate.doubt, EstimateDoubt::kOldData) << offset;
    if (offset == 0.0) held = monitor.report().la.stiffness_to_mass;
    EXPECT_NEAR(monitor.report().la.stiffness_to_mass, held, 1e-3 * held) << offset;
    for (std::size_t k = 0; k < drive.size() / 4; ++k)
      add(drive[k].sprung_acceleration, drive[k].unsprung_acceleration);
    EXPECT_TRUE(monitor.report().la.valid()) << offset;
  }
}

TEST(SensorOffset, IsNotEstimatedAsInThePaper) {
  MonitorSettings paper = MonitorOptions::of("paper");
  paper.sample_period = 0.02;
  SuspensionMonitor monitor(paper);
  for (const CornerSample& sample : driveOn(kRoads[0])) monitor.addSample(sample);
  EXPECT_TRUE(std::isnan(monitor.report().la.offset));
}

}  // namespace
}  // namespace suspension_health_monitor
