// What sensors as they are do to the estimate over a whole drive, by blocks.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "paper_drive.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"
#include "suspension_health_monitor/vehicle.h"
#include "vehicle_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 6.0, kB0 = 63.3;  // [1/s], [1/s^2]

/// A car on a class B road at 100 Hz.
class CarDrive {
 public:
  CarDrive() {
    SimulationOptions options;
    options.scenario = "iso_road";
    options.iso_class = "B";
    options.speed = 15.0;  // shakes up to 42 Hz
    options.damping_to_mass = kB1;
    options.stiffness_to_mass = kB0;
    options.rate = 1000.0;
    options.duration = 300.0;
    options.noise = 0.0;
    DriveSimulator simulator(options);
    while (const auto sample = simulator.next())
      fine_.push_back({sample->stamp, sample->sprung->acceleration, sample->unsprung->acceleration});
  }

  /// @param late  milliseconds by which the wheel's readings are stamped too late.
  /// @param drift  amplitude of the wheel's offset, over ten minutes [m/s^2].
  IdentifyResult identified(std::size_t late, double drift) const {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 0.03);
    Drive drive;
    for (std::size_t k = late; k < fine_.size(); k += 10) {
      const double offset = drift * std::sin(2.0 * M_PI * toSeconds(fine_[k].stamp) / 600.0);
      drive.samples.push_back({fine_[k].stamp, fine_[k].sprung_acceleration + noise(random),
                               fine_[k - late].unsprung_acceleration + offset + noise(random)});
    }
    IdentifyOptions options;
    options.horizon_samples = 40;
    return identify({drive}, options);
  }

 private:
  std::vector<CornerSample> fine_;
};

void expectTruth(const StrutEstimate& strut) {
  EXPECT_TRUE(strut.valid()) << describe(strut.doubt);
  EXPECT_LT(std::abs(strut.damping_to_mass - kB1), 3.0 * strut.damping_to_mass_stddev);
  EXPECT_LT(std::abs(strut.stiffness_to_mass - kB0), 3.0 * strut.stiffness_to_mass_stddev);
  EXPECT_NEAR(strut.damping_to_mass, kB1, 0.01 * kB1);
  EXPECT_NEAR(strut.stiffness_to_mass, kB0, 0.01 * kB0);
}

TEST(WholeDrive, IsThatOfReadingsThatBelongTogether) {
  const CarDrive car;
  for (const std::size_t late : {0u, 2u, 6u, 11u, 13u, 16u}) {
    SCOPED_TRACE(late);
    const IdentifyResult found = car.identified(late, 0.0);
    expectTruth(found.estimate);
    EXPECT_TRUE(found.isSteady());
  }
}

/// @return of a drive of two minutes, after as many seconds of which the strut becomes another one.
IdentifyResult identifiedWithChange(double seconds, double damping_left, double stiffness_left, int seed) {
  SimulationOptions options;
  options.scenario = "iso_road";
  options.damping_to_mass = kB1;
  options.stiffness_to_mass = kB0;
  options.rate = 100.0;
  options.seed = 2 * seed;
  options.duration = seconds;
  const std::vector<CornerSample> before = simulate(options);
  options.seed += 1;
  options.duration = 120.0 - seconds;
  *options.damping_to_mass *= damping_left;
  *options.stiffness_to_mass *= stiffness_left;
  return identify({Drive{before}, Drive{simulate(options)}});
}

TEST(WholeDrive, IsNotSteadyWhereverTheStrutChanges) {
  for (const double seconds : {12.0, 20.0, 108.0})
    for (const auto& [damping, stiffness] : {std::pair(0.81, 1.0), std::pair(1.0, 0.85), std::pair(0.85, 0.85)}) {
      SCOPED_TRACE(seconds);
      const IdentifyResult found = identifiedWithChange(seconds, damping, stiffness, 1);
      ASSERT_TRUE(found.estimate.change);
      EXPECT_FALSE(found.isSteady());
      ASSERT_EQ(found.warnings.size(), 1u);
      const auto& [from, to, of_damping, of_stiffness] = *found.estimate.change;
      EXPECT_TRUE(std::abs((from > 1.0 ? from : to) - seconds) < 10.0) << from << " to " << to;
      const bool is_first = from <= 1.0;
      EXPECT_NEAR(is_first ? 1.0 / (1.0 + of_damping) : 1.0 + of_damping, damping, 0.04);
      EXPECT_NEAR(is_first ? 1.0 / (1.0 + of_stiffness) : 1.0 + of_stiffness, stiffness, 0.04);
    }
}

TEST(WholeDrive, OfOneStrutIsSteady) {
  for (int seed = 1; seed <= 4; ++seed)
    EXPECT_TRUE(identifiedWithChange(60.0, 1.0, 1.0, seed).isSteady()) << "seed " << seed;
}

TEST(WholeDrive, DoesNotFeelAnOffsetThatDrifts) { expectTruth(CarDrive().identified(0, 0.3).estimate); }

// A vehicle's struts are taken apart by all sensors, so that body and wheel of a strut have noise in common.
TEST(WholeDrive, IsFreeOfTheNoiseThatStrutsHaveInCommon) {
  double squares[2] = {0.0, 0.0}, count = 0.0;
  for (const char* name : {"sedan", "truck"}) {
    Vehicle vehicle = namedVehicle(name);
    vehicle.iso_class = "A";
    for (const bool has_body_imu : {false, true}) {
      const VehicleDriveOptions options = vehicleDrive(300.0);
      VehicleDrive drive;
      if (has_body_imu)
        drive = bodyImuDrive(vehicle, options);
      else
        drive.struts = strutDrives(vehicle, options);
      const VehicleIdentification found = identifyVehicle({drive}, strutNames(vehicle));
      ASSERT_TRUE(found) << name << ": " << found.coupling.reason;
      for (std::size_t i = 0; i < found.struts.size(); ++i) {
        const VehicleStrut& strut = vehicle.struts[i];
        const double own = vehicle.mobility(strut, strut);
        const StrutEstimate& estimate = found.struts[i].estimate;
        squares[0] += std::pow((estimate.damping_to_mass - own * strut.damping) / estimate.damping_to_mass_stddev, 2);
        squares[1] +=
            std::pow((estimate.stiffness_to_mass - own * strut.stiffness) / estimate.stiffness_to_mass_stddev, 2);
        count += 1.0;
      }
    }
  }
  EXPECT_EQ(count, 16.0);
  for (const double sum : squares) EXPECT_LT(sum, 32.0);  // chi^2 of 16: beyond it in 1 % of cases
}

}  // namespace
}  // namespace suspension_health_monitor
