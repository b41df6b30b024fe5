#include "suspension_health_monitor/internal/simulation/vehicle_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "simulated_drive.h"
#include "simulated_vehicle.h"

namespace suspension_health_monitor {
namespace {

RoadPoint flat(double) { return {}; }

std::vector<Road> flatUnder(const Vehicle& vehicle) { return std::vector<Road>(vehicle.struts.size(), flat); }

double energyOf(const Vehicle& vehicle, const VehicleMotion::State& state) {
  const std::size_t n = vehicle.struts.size();
  double twice = vehicle.mass * state[3] * state[3] + vehicle.pitch_inertia * state[4] * state[4] +
                 vehicle.roll_inertia * state[5] * state[5];
  std::vector<double> travels;
  for (std::size_t i = 0; i < n; ++i) {
    const VehicleStrut& strut = vehicle.struts[i];
    const double height = state[6 + i], rate = state[6 + n + i];
    const double travel = height - (state[0] - strut.x * state[1] + strut.y * state[2]);
    travels.push_back(travel);
    twice +=
        strut.wheel_mass * rate * rate + strut.stiffness * travel * travel + strut.tyre_stiffness * height * height;
  }
  for (const AntiRollBar& bar : vehicle.anti_roll_bars)
    twice += bar.stiffness * std::pow(travels[bar.first] - travels[bar.second], 2);
  return twice / 2.0;
}

TEST(VehicleMotion, KeepsItsEnergyWithoutDampingAndLosesItWithAnyOne) {
  Vehicle vehicle = namedVehicle("sedan");
  vehicle.anti_roll_bars = {{0, 1, 12000.0}, {2, 3, 7000.0}};
  for (VehicleStrut& strut : vehicle.struts) strut.damping = strut.tyre_damping = 0.0;
  const auto changeIn = [&](const Vehicle& tried) {
    VehicleMotion motion(tried, flatUnder(tried), 0.01);
    motion.state() = {0.02, 0.01, -0.03, 0.1, -0.2, 0.3, 0.01, -0.01, 0.0, 0.005, 0.4, 0.0, -0.5, 0.2};
    const double before = energyOf(tried, motion.state());
    motion.advance(5.0);
    return energyOf(tried, motion.state()) / before - 1.0;
  };
  EXPECT_NEAR(changeIn(vehicle), 0.0, 1e-7);
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
    Vehicle damped = vehicle;
    damped.struts[i].damping = 100.0;
    EXPECT_LT(changeIn(damped), -1e-3) << "strut " << i;
    damped.struts[i].damping = 0.0;
    damped.struts[i].tyre_damping = 100.0;
    EXPECT_LT(changeIn(damped), -1e-3) << "tyre " << i;
  }
}

VehicleStrut goldenStrut(double share) {
  VehicleStrut strut;
  strut.damping = share * 1500.0;
  strut.stiffness = share * 15825.0;
  strut.wheel_mass = share * 37.5;
  strut.tyre_stiffness = share * 163250.0;
  return strut;
}

// By Huygens: a body with Iyy = M a b is as two masses, M b / (a + b) at a ahead and M a / (a + b) at b behind.
TEST(VehicleMotion, HalfCarOfTwoPointMassesIsTwoQuarterCars) {
  const double a = 1.1, b = 1.6, mass = 500.0;
  Vehicle vehicle;
  vehicle.mass = mass;
  vehicle.pitch_inertia = mass * a * b;
  vehicle.speed = 15.0;
  vehicle.struts = {goldenStrut(mass * b / (a + b) / 250.0), goldenStrut(mass * a / (a + b) / 250.0)};
  vehicle.struts[0].x = a;
  vehicle.struts[1].x = -b;
  const std::vector<VehicleInstant> samples = driveVehicle(vehicle, vehicleDrive(10.0));
  SimulationOptions quarter = scenario("iso_road", 10.0);
  quarter.rate = 100.0;
  const std::vector<DriveSample> alone = drive(quarter);
  const auto delay = static_cast<std::size_t>(std::lround((a + b) / 15.0 * 100.0));  // 18 samples
  ASSERT_EQ(samples.size(), alone.size());
  for (std::size_t k = 0; k < alone.size(); ++k) {
    const DriveTruth& front = samples[k].truth.struts[0];
    ASSERT_NEAR(front.sprung_acceleration, alone[k].truth.sprung_acceleration, 1e-6) << k;
    ASSERT_NEAR(front.unsprung_acceleration, alone[k].truth.unsprung_acceleration, 1e-6) << k;
    ASSERT_NEAR(front.damping_to_mass, 6.0, 1e-12);
    ASSERT_NEAR(front.stiffness_to_mass, 63.3, 1e-12);
    if (k < 800 || k < delay) continue;  // exp(-3 * 8) is left of the start, which was at another place of the road
    const DriveTruth& rear = samples[k].truth.struts[1];
    ASSERT_NEAR(rear.sprung_acceleration, alone[k - delay].truth.sprung_acceleration, 1e-6) << k;
  }
}

TEST(VehicleMotion, OneStrutIsTheQuarterCarWithItsHiddenEffects) {
  SimulationOptions quarter = scenario("iso_road", 5.0);
  quarter.rate = 100.0;
  quarter.hidden = {{findEffect(forceEffects(), "quadratic_damping"), 3.0, {}},
                    {findEffect(forceEffects(), "viscoelastic_mount"), 30.0, {0.05}},
                    {findEffect(forceEffects(), "body_drag"), 0.5, {3.0}}};
  Vehicle vehicle;
  vehicle.mass = 250.0;
  vehicle.speed = 15.0;
  vehicle.struts = {goldenStrut(1.0)};
  vehicle.struts[0].hidden = quarter.hidden;
  const std::vector<VehicleInstant> samples = driveVehicle(vehicle, vehicleDrive(5.0));
  const std::vector<DriveSample> expected = drive(quarter);
  for (std::size_t k = 0; k < expected.size(); ++k)
    ASSERT_NEAR(samples[k].truth.struts[0].sprung_acceleration, expected[k].truth.sprung_acceleration, 1e-6) << k;
}

Vehicle loadedSedan() {
  Vehicle vehicle = namedVehicle("sedan");
  vehicle.anti_roll_bars = {{0, 1, 12000.0}};
  vehicle.struts[0].hidden = {{findEffect(forceEffects(), "asymmetric_damping"), 2.0, {}}};
  vehicle.struts[3].hidden = {{findEffect(forceEffects(), "hysteresis"), 0.5, {0.01}},
                              {findEffect(forceEffects(), "progressive_spring"), 900.0, {3.0}}};
  vehicle.known_forces = {{"tow_bar", -2.0, 0.3, 800.0}};
  return vehicle;
}

TEST(VehicleMotion, EveryStrutTopIsMovedByAllForces) {
  const Vehicle vehicle = loadedSedan();
  for (const VehicleInstant& sample : driveVehicle(vehicle, vehicleDrive(3.0))) {
    const VehicleTruth& truth = sample.truth;
    for (std::size_t i = 0; i < 4; ++i) {
      const VehicleStrut& at = vehicle.struts[i];
      double expected = (1.0 / 1350.0 + at.x * -2.0 / 2100.0 + at.y * 0.3 / 480.0) * truth.known_forces[0];
      for (std::size_t j = 0; j < 4; ++j) {
        const VehicleStrut& of = vehicle.struts[j];
        expected += (1.0 / 1350.0 + at.x * of.x / 2100.0 + at.y * of.y / 480.0) * truth.forces[j];
      }
      ASSERT_NEAR(truth.struts[i].sprung_acceleration, expected, 1e-10);
    }
  }
}

TEST(VehicleMotion, ForcesAreTheStrutsOwnTheEffectsPerCornerMassAndTheBar) {
  const Vehicle vehicle = loadedSedan();
  double largest = 0.0;
  for (const VehicleInstant& sample : driveVehicle(vehicle, vehicleDrive(3.0))) {
    const VehicleTruth& truth = sample.truth;
    const auto linear = [&](std::size_t i) {
      const VehicleStrut& strut = vehicle.struts[i];
      return strut.damping * truth.struts[i].travel_rate + strut.stiffness * truth.struts[i].travel;
    };
    const double bar = 12000.0 * (truth.struts[0].travel - truth.struts[1].travel);
    const double corner_mass = 1.0 / (1.0 / 1350.0 + 1.15 * 1.15 / 2100.0 + 0.75 * 0.75 / 480.0);
    const double hidden = corner_mass * 2.0 * std::abs(truth.struts[0].travel_rate);
    ASSERT_NEAR(truth.forces[0], linear(0) + bar + hidden, 1e-8);
    ASSERT_NEAR(truth.forces[1], linear(1) - bar, 1e-8);
    ASSERT_NEAR(truth.forces[2], linear(2), 1e-8);
    ASSERT_NEAR(truth.struts[0].damping_to_mass, 1930.0 / corner_mass, 1e-12);
    largest = std::max(largest, std::abs(bar));
  }
  EXPECT_GT(largest, 10.0);
}

TEST(VehicleMotion, WheelsCarryTheirStrutAndTheirTyre) {
  const Vehicle vehicle = loadedSedan();
  const std::vector<VehicleInstant> samples = driveVehicle(vehicle, vehicleDrive(1.0, 2000.0));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 1; k + 1 < samples.size(); ++k) {
      const auto heightAt = [&](std::size_t sample) {
        const VehicleTruth& truth = samples[sample].truth;
        const VehicleStrut& strut = vehicle.struts[i];
        return truth.struts[i].travel + truth.body[0] - strut.x * truth.body[1] + strut.y * truth.body[2];
      };
      const VehicleTruth& truth = samples[k].truth;
      const double second = (heightAt(k + 1) - 2.0 * heightAt(k) + heightAt(k - 1)) * 2000.0 * 2000.0;
      ASSERT_NEAR(second, truth.struts[i].unsprung_acceleration, 0.1);
      const double lift = truth.struts[i].road_height - heightAt(k);
      const double tyre_damping = truth.struts[i].unsprung_acceleration * vehicle.struts[i].wheel_mass +
                                  truth.forces[i] - vehicle.struts[i].tyre_stiffness * lift;
      const double lift_rate = (samples[k + 1].truth.struts[i].road_height -
                                samples[k - 1].truth.struts[i].road_height - heightAt(k + 1) + heightAt(k - 1)) *
                               1000.0;
      ASSERT_NEAR(tyre_damping, 150.0 * lift_rate, 1.0);
    }
  }
}

TEST(VehicleMotion, TurnsOnlyAboutAxesThatItsStrutsLieAside) {
  for (const VehicleInstant& sample : driveVehicle(namedVehicle("half_sedan"), vehicleDrive(2.0))) {
    ASSERT_EQ(sample.truth.body[2], 0.0);
    ASSERT_EQ(sample.truth.body_acceleration[2], 0.0);
  }
  Vehicle axle = namedVehicle("half_sedan");
  std::swap(axle.roll_inertia, axle.pitch_inertia);
  for (VehicleStrut& strut : axle.struts) std::swap(strut.x, strut.y);
  double largest = 0.0;
  for (const VehicleInstant& sample : driveVehicle(axle, vehicleDrive(2.0))) {
    ASSERT_EQ(sample.truth.body_acceleration[1], 0.0);
    largest = std::max(largest, std::abs(sample.truth.body_acceleration[2]));
  }
  EXPECT_GT(largest, 0.1);
}

TEST(VehicleMotion, DampingAndStiffnessOfOneStrutChangeWhenTheyShould) {
  Vehicle vehicle = namedVehicle("ugv");
  vehicle.struts[1].damping_end_fraction = 0.6;
  vehicle.struts[1].ramp_start = vehicle.struts[1].ramp_end = 1.0;
  vehicle.struts[2].stiffness_end_fraction = 0.5;
  vehicle.struts[2].ramp_start = 1.0;
  vehicle.struts[2].ramp_end = 3.0;
  const std::vector<VehicleInstant> samples = driveVehicle(vehicle, vehicleDrive(4.0, 10.0));
  const auto& first = samples.front().truth.struts;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto& struts = samples[k].truth.struts;
    const double t = static_cast<double>(k) / 10.0;
    EXPECT_NEAR(struts[1].damping_to_mass / first[1].damping_to_mass, k < 10 ? 1.0 : 0.6, 1e-12) << t;
    const double left = t < 1.0 ? 1.0 : t > 3.0 ? 0.5 : 1.0 - 0.25 * (t - 1.0);
    EXPECT_NEAR(struts[2].stiffness_to_mass / first[2].stiffness_to_mass, left, 1e-12) << t;
    EXPECT_EQ(struts[0].damping_to_mass, first[0].damping_to_mass);
    EXPECT_EQ(struts[1].stiffness_to_mass, first[1].stiffness_to_mass);
    const double force = vehicle.struts[1].damping * (k < 10 ? 1.0 : 0.6) * struts[1].travel_rate +
                         vehicle.struts[1].stiffness * struts[1].travel;
    EXPECT_NEAR(samples[k].truth.forces[1], force, 1e-9);
  }
}

TEST(VehicleMotion, RunawayIsRefusedByTheNameOfTheEffect) {
  Vehicle vehicle = namedVehicle("sedan");
  vehicle.struts[2].hidden = {{findEffect(forceEffects(), "quadratic_damping"), -500.0, {}}};
  try {
    driveVehicle(vehicle, vehicleDrive(20.0));
    ADD_FAILURE() << "it ended";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("quadratic_damping = -500"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace suspension_health_monitor
