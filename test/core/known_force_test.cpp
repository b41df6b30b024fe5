// Forces on a vehicle's body that are measured.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/monitor/vehicle_monitor.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "vehicle_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr double kDuration = 120.0;

/// A vehicle that is pulled at a tow bar behind its axles and to one side.
/// @param strength  what the force would do to the body's mass alone, rms [m/s^2].
Vehicle towing(const char* name, double strength = 0.3) {
  Vehicle vehicle = namedVehicle(name);
  KnownForce bar;
  bar.name = "tow_bar";
  bar.x = 1.6 * vehicle.struts.back().x;
  bar.y = 0.4 * vehicle.struts.front().y;
  bar.rms = strength * vehicle.mass;
  vehicle.known_forces = {bar};
  return vehicle;
}

/// 1/M + x_i x / Iyy + y_i y / Ixx.
double coefficientOf(const Vehicle& vehicle, const VehicleStrut& strut) {
  const KnownForce& bar = vehicle.known_forces.front();
  double sum = 1.0 / vehicle.mass + strut.x * bar.x / vehicle.pitch_inertia;
  if (strut.y != 0.0) sum += strut.y * bar.y / vehicle.roll_inertia;
  return sum;
}

double worstError(const Vehicle& vehicle, const SeparatedVehicle& found) {
  double worst = 0.0;
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
    const VehicleStrut& strut = vehicle.struts[i];
    const double own = vehicle.mobility(strut, strut);
    worst = std::fmax(worst, std::abs(found.models[i].damping_to_mass / (own * strut.damping) - 1.0));
    worst = std::fmax(worst, std::abs(found.models[i].stiffness_to_mass / (own * strut.stiffness) - 1.0));
  }
  return worst;
}

TEST(KnownForce, MovesEveryStrutTopAsTheBodysMassAndInertiasSay) {
  for (const char* name : {"half_sedan", "sedan", "truck"}) {
    const Vehicle vehicle = towing(name);
    const VehicleDrive drive = vehicleDriveOf(vehicle, vehicleDrive(kDuration));
    const SeparatedVehicle found = separateVehicle({drive}, strutNames(vehicle));
    ASSERT_TRUE(found.coupling) << name << ": " << found.coupling.reason;
    ASSERT_EQ(found.coupling.forces.size(), 1U);
    const KnownForceCoefficients& bar = found.coupling.forces.front();
    EXPECT_EQ(bar.name, "tow_bar");
    bool lifts = false, lowers = false;
    for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
      const double truth = coefficientOf(vehicle, vehicle.struts[i]);
      EXPECT_LT(bar.stddevs[i], 0.02 / vehicle.mass) << name << i;
      EXPECT_NEAR(bar.values[i], truth, 5.0 * bar.stddevs[i]) << name << i;
      (truth > 0.0 ? lifts : lowers) = true;
    }
    EXPECT_TRUE(lifts && lowers) << name << ": what lifts the rear lowers the front";
    EXPECT_LT(worstError(vehicle, found), 0.02) << name;
    const SeparatedVehicle without = separateVehicle({drive.struts}, strutNames(vehicle));
    EXPECT_TRUE(!without.coupling || worstError(vehicle, without) < 0.03) << name << ": instruments do not have it";
  }
}

TEST(KnownForce, LeavesNothingMissingAndHidesNothing) {
  for (const bool hidden : {false, true}) {
    Vehicle vehicle = towing("half_sedan", 0.1);
    if (hidden) vehicle.struts[0].hidden = {{findEffect(builtInEffects().forces, "quadratic_damping"), 2.0, {}}};
    const VehicleDrive drive = vehicleDriveOf(vehicle, vehicleDrive(kDuration));
    const VehicleDiagnosis found = diagnoseVehicle({drive}, strutNames(vehicle));
    ASSERT_TRUE(found) << found.coupling.reason;
    EXPECT_EQ(found.verdict, hidden ? Verdict::kEffectFound : Verdict::kNothingMissing) << found.summary;
    for (std::size_t i = 0; i < found.struts.size(); ++i) {
      const bool is_there = hidden && i == 0;
      EXPECT_EQ(found.selected(i), std::vector<std::string>(is_there ? 1 : 0, "quadratic_damping")) << found.summary;
    }
  }
}

TEST(KnownForce, OfAnyUnitAndDirectionIsTheSame) {
  const Vehicle vehicle = towing("half_sedan");
  VehicleDrive drive = vehicleDriveOf(vehicle, vehicleDrive(60.0));
  const SeparatedVehicle in_newtons = separateVehicle({drive}, strutNames(vehicle));
  for (double& value : drive.forces[0].values) value = -1e-3 * value + 7.0;  // kN, down, from a scale with a tare
  const SeparatedVehicle found = separateVehicle({drive}, strutNames(vehicle));
  ASSERT_TRUE(found.coupling) << found.coupling.reason;
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
    const double coefficient = in_newtons.coupling.forces[0].values[i];
    EXPECT_NEAR(found.coupling.forces[0].values[i], -1e3 * coefficient, 1e-4 * std::abs(1e3 * coefficient));
    for (std::size_t k = 0; k < found.struts[i][0].samples.size(); ++k)
      ASSERT_NEAR(found.struts[i][0].samples[k].sprung_acceleration,
                  in_newtons.struts[i][0].samples[k].sprung_acceleration, 1e-4);
  }
}

TEST(KnownForce, ThatNeverChangesTellsNothingAndDisturbsNothing) {
  const Vehicle vehicle = namedVehicle("half_sedan");
  VehicleDrive drive = vehicleDriveOf(vehicle, vehicleDrive(60.0));
  const SeparatedVehicle without = separateVehicle({drive}, strutNames(vehicle));
  drive.forces = {{"winch", std::vector<double>(drive.struts[0].samples.size(), 1234.5)}};
  const SeparatedVehicle found = separateVehicle({drive}, strutNames(vehicle));
  ASSERT_TRUE(found.coupling) << found.coupling.reason;
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
    EXPECT_EQ(found.coupling.forces[0].values[i], 0.0);
    EXPECT_EQ(found.coupling.forces[0].stddevs[i], HUGE_VAL);
    EXPECT_NEAR(found.models[i].stiffness_to_mass, without.models[i].stiffness_to_mass,
                1e-4 * found.models[i].stiffness_to_mass);
    EXPECT_NEAR(found.coupling.ratios[0][1], without.coupling.ratios[0][1], 1e-4);
  }
}

TEST(KnownForce, OnABodyOfOneStrutIsTakenOffLive) {
  Vehicle vehicle = namedVehicle("half_sedan");
  vehicle.struts.resize(1);
  vehicle.struts[0].x = vehicle.struts[0].y = 0.0;
  vehicle.mass *= 0.5;
  KnownForce actuator;
  actuator.name = "actuator";
  actuator.rms = 0.5 * vehicle.mass;
  vehicle.known_forces = {actuator};
  const VehicleDrive drive = vehicleDriveOf(vehicle, vehicleDrive(kDuration));
  MonitorSettings settings;
  settings.sample_period = 0.01;
  const VehicleStrut& strut = vehicle.struts[0];
  for (const bool is_known : {true, false}) {
    double off = 0.0, reports = 0.0;
    VehicleMonitor monitor(
        {settings},
        [&](std::size_t, const MonitorReport& report) {
          if (toSeconds(report.stamp) < 0.5 * kDuration) return;
          off += std::abs(report.la.stiffness_to_mass / (strut.stiffness / vehicle.mass) - 1.0);
          reports += 1.0;
        },
        is_known ? 1 : 0);
    const VehicleDrive told(drive.struts, is_known ? drive.forces : std::vector<KnownForceRecord>{});
    for (std::size_t k = 0; k < drive.struts[0].samples.size(); ++k) monitor.addSample(sampleOf(told, k));
    ASSERT_GT(reports, 1000.0);
    if (is_known) {
      EXPECT_LT(off / reports, 0.02);
      EXPECT_NEAR(monitor.rows()->force(0, 0), 1.0 / vehicle.mass, 0.02 / vehicle.mass);
    } else {
      EXPECT_GT(off / reports, 0.05);
    }
  }
}

TEST(KnownForce, IsRefusedWithoutAValueForEverySampleAndUnlikeThatOfOtherDrives) {
  const Vehicle vehicle = towing("half_sedan");
  const VehicleDrive drive = vehicleDriveOf(vehicle, vehicleDrive(5.0));
  VehicleDrive shorter = drive, other = drive;
  shorter.forces[0].values.pop_back();
  other.forces[0].name = "winch";
  EXPECT_THROW(separateVehicle({shorter}, strutNames(vehicle)), std::invalid_argument);
  EXPECT_THROW(separateVehicle({drive, other}, strutNames(vehicle)), std::invalid_argument);
  other.forces.assign(kMostKnownForces + 1, drive.forces[0]);
  EXPECT_THROW(separateVehicle({other}, strutNames(vehicle)), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
