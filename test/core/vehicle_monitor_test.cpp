#include "suspension_health_monitor/internal/monitor/vehicle_monitor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "vehicle_drive.h"

namespace suspension_health_monitor {
namespace {

MonitorSettings settingsAt(double period) {
  MonitorSettings settings;
  settings.sample_period = period;
  return settings;
}

TEST(VehicleMonitor, AccusesTheCornerThatLosesItsDampingAndNoOther) {
  Vehicle vehicle = namedVehicle("sedan");
  constexpr double kLoss = 200.0;
  vehicle.struts[1].damping_end_fraction = 0.6;
  vehicle.struts[1].ramp_start = vehicle.struts[1].ramp_end = kLoss;
  const StrutDrives drive = strutDrives(vehicle, vehicleDrive(260.0));
  std::array<double, 4> ok{}, reports{};
  std::array<std::set<HealthLevel>, 4> levels;
  double error_at = 0.0;
  VehicleMonitor monitor(std::vector<MonitorSettings>(4, settingsAt(0.01)),
                         [&](std::size_t strut, const MonitorReport& report) {
                           levels[strut].insert(report.health.level);
                           reports[strut] += 1.0;
                           ok[strut] += report.health.level == HealthLevel::kOk ? 1.0 : 0.0;
                           if (report.health.level == HealthLevel::kError && error_at == 0.0)
                             error_at = toSeconds(report.stamp);
                         });
  for (std::size_t k = 0; k < drive.front().samples.size(); ++k) monitor.addSample(sampleOf(drive, k));
  ASSERT_TRUE(monitor.isCoupled());
  for (const std::size_t healthy : {0, 2, 3}) {
    EXPECT_EQ(levels[healthy].count(HealthLevel::kWarn) + levels[healthy].count(HealthLevel::kError), 0U) << healthy;
    EXPECT_GT(ok[healthy], 0.95 * reports[healthy]) << healthy;
  }
  EXPECT_GT(error_at, kLoss);
  EXPECT_LT(error_at, kLoss + 30.0);
}

/// How long each strut of a sedan was at WARN or ERROR, and what was said last.
struct Warnings {
  std::array<double, 4> seconds{};
  std::array<HealthReport, 4> last;
};

/// @param baselines  of the struts; empty: they are learned.
/// @param over_the_drive  takes the estimates of the whole drive.
Warnings warningsOf(const Vehicle& sedan, double seconds, const std::vector<Baseline>& baselines = {},
                    std::vector<StrutEstimate>* over_the_drive = nullptr) {
  constexpr double kPeriod = 0.01;
  const StrutDrives drive = strutDrives(sedan, vehicleDrive(seconds));
  Warnings warnings;
  VehicleMonitor monitor(std::vector<MonitorSettings>(4, settingsAt(kPeriod)),
                         [&](std::size_t strut, const MonitorReport& report) {
                           const HealthLevel level = report.health.level;
                           const bool warns = level == HealthLevel::kWarn || level == HealthLevel::kError;
                           warnings.seconds[strut] += warns ? kPeriod : 0.0;
                           warnings.last[strut] = report.health;
                         });
  for (std::size_t i = 0; i < baselines.size(); ++i) monitor.setBaseline(i, baselines[i]);
  for (std::size_t k = 0; k < drive.front().samples.size(); ++k) monitor.addSample(sampleOf(drive, k));
  for (std::size_t i = 0; over_the_drive != nullptr && i < 4; ++i) over_the_drive->push_back(monitor.overTheDrive(i));
  return warnings;
}

// Dampers that soften together while they warm, by less than the error threshold, and one that softens beyond that.
TEST(VehicleMonitor, TakesWhatAllDampersShareForTheirTemperature) {
  constexpr double kWarm = 0.8, kWornToo = 0.72, kFrom = 100.0, kTo = 160.0;
  for (const bool is_one_worn : {false, true}) {
    Vehicle vehicle = namedVehicle("sedan");
    for (VehicleStrut& strut : vehicle.struts) {
      strut.damping_end_fraction = kWarm;
      strut.ramp_start = kFrom;
      strut.ramp_end = kTo;
    }
    if (is_one_worn) vehicle.struts[1].damping_end_fraction = kWornToo * kWarm;
    const auto [warned, last] = warningsOf(vehicle, 260.0);
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_one_worn && i == 1) {
        EXPECT_EQ(last[i].level, HealthLevel::kError);
        continue;
      }
      EXPECT_LT(warned[i], 3.0) << i;  // [s]: estimates of the struts come one after the other
      EXPECT_EQ(last[i].level, HealthLevel::kOk) << i << describe(last[i]);
      ASSERT_TRUE(last[i].shared_damping_change) << i << describe(last[i]);
      EXPECT_NEAR(*last[i].shared_damping_change, kWarm - 1.0, 0.05);
      EXPECT_NE(describe(last[i]).find("softer: warm?"), std::string::npos);
    }
  }
}

// The first judgement of a strut comes before those of the others.
TEST(VehicleMonitor, RaisesNoLevelForDampersThatAreWarmFromTheStart) {
  constexpr double kWarm = 0.8, kSeconds = 60.0;
  Vehicle vehicle = namedVehicle("sedan");
  const auto soften = [&](double fraction) {
    for (VehicleStrut& strut : vehicle.struts) {
      strut.damping_end_fraction = fraction;
      strut.ramp_start = strut.ramp_end = 0.0;
    }
  };
  soften(1.0);
  std::vector<StrutEstimate> healthy;
  const Warnings cold = warningsOf(vehicle, kSeconds, {}, &healthy);
  std::vector<Baseline> baselines;
  for (const StrutEstimate& estimate : healthy) {
    ASSERT_TRUE(estimate.valid());
    Baseline& baseline = baselines.emplace_back();
    baseline.damping_to_mass = estimate.damping_to_mass;
    baseline.stiffness_to_mass = estimate.stiffness_to_mass;
    baseline.damping_to_mass_stddev = estimate.damping_to_mass_stddev;
    baseline.stiffness_to_mass_stddev = estimate.stiffness_to_mass_stddev;
  }
  soften(kWarm);
  const auto [warned, last] = warningsOf(vehicle, kSeconds, baselines);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(cold.seconds[i], 0.0) << i;
    EXPECT_EQ(warned[i], 0.0) << i;
    ASSERT_TRUE(last[i].shared_damping_change) << i << describe(last[i]);
    EXPECT_NEAR(*last[i].shared_damping_change, kWarm - 1.0, 0.05);
  }
}

TEST(VehicleMonitor, OfOneStrutIsASuspensionMonitor) {
  const Vehicle vehicle = namedVehicle("half_sedan");
  const StrutDrives drive = strutDrives(vehicle, vehicleDrive(30.0));
  SuspensionMonitor alone(settingsAt(0.01));
  std::vector<double> of_vehicle, of_strut;
  VehicleMonitor monitor({settingsAt(0.01)}, [&](std::size_t, const MonitorReport& report) {
    of_vehicle.push_back(report.la.stiffness_to_mass);
  });
  for (const CornerSample& sample : drive.front().samples) {
    VehicleSample one{sample.stamp, StrutVector(1), StrutVector(1), ForceVector(0)};
    one.sprung[0] = sample.sprung_acceleration;
    one.unsprung[0] = sample.unsprung_acceleration;
    monitor.addSample(one);
    if (const MonitorReport* report = alone.addSample(sample)) of_strut.push_back(report->la.stiffness_to_mass);
  }
  ASSERT_EQ(of_vehicle.size(), of_strut.size());
  for (std::size_t k = 0; k < of_strut.size(); ++k)
    EXPECT_TRUE(of_vehicle[k] == of_strut[k] || std::isnan(of_strut[k])) << k;
}

TEST(VehicleMonitor, SaysNothingOfStrutsThatTheRoadCannotTellApart) {
  const Vehicle vehicle = namedVehicle("sedan");
  VehicleDriveOptions options = vehicleDrive(120.0);
  options.tracks = "identical";
  const StrutDrives drive = strutDrives(vehicle, options);
  int reports = 0;
  VehicleMonitor monitor(std::vector<MonitorSettings>(4, settingsAt(0.01)),
                         [&](std::size_t, const MonitorReport&) { ++reports; });
  for (std::size_t k = 0; k < drive.front().samples.size(); ++k) monitor.addSample(sampleOf(drive, k));
  EXPECT_FALSE(monitor.isCoupled());
  EXPECT_EQ(reports, 0);
  EXPECT_EQ(monitor.strut(0), nullptr);
}

// Of 16 numbers one in 1e6 vehicles has one that is six standard deviations off.
void expectRightRatios(const Vehicle& vehicle, const VehicleMonitor& monitor) {
  ASSERT_TRUE(monitor.isCoupled());
  for (Eigen::Index i = 0; i < monitor.rows()->size(); ++i)
    for (Eigen::Index j = 0; j < monitor.rows()->size(); ++j) {
      const double truth = ratioOf(vehicle, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      const Measured found = monitor.rows()->ratio(i, j);
      EXPECT_NEAR(found.value, truth, std::fmax(6.0 * found.stddev, 1e-9)) << i << j;
    }
}

// Of a road so smooth, and behind a gyro so loud, that a minute would never do.
TEST(VehicleMonitor, ForgetsNothingBeforeTheRatiosAreKnown) {
  Vehicle vehicle = namedVehicle("sedan");
  vehicle.iso_class = "A";
  vehicle.speed = 20.0;
  VehicleDriveOptions options = vehicleDrive(600.0);
  options.gyro_noise = 0.005;
  const VehicleDrive drive = bodyImuDrive(vehicle, options);
  VehicleMonitor monitor(std::vector<MonitorSettings>(4, settingsAt(0.01)), {});
  for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) monitor.addSample(sampleOf(drive, k));
  expectRightRatios(vehicle, monitor);
}

// Ten minutes of noise are ten times the memory.
TEST(VehicleMonitor, KnowsTheRatiosAfterAStop) {
  const Vehicle vehicle = namedVehicle("sedan");
  const VehicleDriveOptions options = vehicleDrive(60.0);
  const StrutDrives drive = strutDrives(vehicle, options);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(options.gravity, options.noise);
  const auto reading = [&] { return noise(random); };
  VehicleMonitor monitor(std::vector<MonitorSettings>(4, settingsAt(0.01)), {});
  constexpr std::size_t kStop = 3000, kParked = 60000;
  const auto addDrive = [&](std::size_t from, std::size_t to, std::size_t later) {
    for (std::size_t k = from; k < to; ++k) {
      VehicleSample sample = sampleOf(drive, k);
      sample.stamp += fromSeconds(0.01 * static_cast<double>(later));
      monitor.addSample(sample);
    }
  };
  addDrive(0, kStop, 0);
  for (std::size_t k = 0; k < kParked; ++k)
    monitor.addSample({drive.front().samples[kStop].stamp + fromSeconds(0.01 * static_cast<double>(k)),
                       StrutVector::NullaryExpr(4, reading), StrutVector::NullaryExpr(4, reading), ForceVector(0)});
  expectRightRatios(vehicle, monitor);
  addDrive(kStop, drive.front().samples.size(), kParked);
  expectRightRatios(vehicle, monitor);
}

TEST(VehicleMonitor, RefusesNoStrut) {
  EXPECT_THROW(VehicleMonitor(std::vector<MonitorSettings>{}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
