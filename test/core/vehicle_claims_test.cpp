// What the data say against a vehicle file, on drives of benchmark/vehicle_drive.h.
#include "suspension_health_monitor/internal/vehicle/vehicle_claims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"
#include "vehicle_told.h"

namespace suspension_health_monitor {
namespace {

using Sensor = VehicleReading::Sensor;

using Kind = VehicleMistake::Kind;
using vehicle_drive::Record;

vehicle_drive::Drive byBody() {
  vehicle_drive::Drive drive = shortDrive();
  drive.imu = vehicle_drive::BodyImu{-0.1, 0.05};
  return drive;
}

void expectMistake(Kind kind, StrutPair struts, const vehicle_drive::Drive& drive,
                   const std::function<void(Record&, VehicleChannels&)>& change) {
  // A sedan's pitch and roll are little more than the gyro's noise.
  const std::vector<std::string> vehicles =
      drive.imu ? std::vector<std::string>{"robot"} : std::vector<std::string>{"robot", "sedan"};
  for (const std::string& made : vehicles) {
    const VehicleMistake found = tell(vehicle_drive::made(made, 1), drive, change).mistake;
    EXPECT_EQ(found.kind, kind) << made << ": " << describe(found, {"a", "b", "c", "d"});
    EXPECT_EQ(found.struts, struts) << made;
  }
}

TEST(VehicleClaims, OfVehiclesAsTheyAreAreNotContradicted) {
  for (const vehicle_drive::Drive& drive : {shortDrive(), byBody()})
    for (const char* made : {"half", "robot", "sedan", "truck"}) {
      const Told told = tell(vehicle_drive::made(made, 1), drive);
      EXPECT_EQ(told.mistake.kind, Kind::kNone) << made;
      EXPECT_LT(told.mistake.unexplained, 0.2) << made << ": noise of the gyro";
    }
}

TEST(VehicleClaims, NameWheelsThatAreSwappedAndOneThatIsUpsideDown) {
  for (const vehicle_drive::Drive& drive : {shortDrive(), byBody()}) {
    expectMistake(Kind::kSwapped, {0, 3}, drive,
                  [](Record& record, VehicleChannels&) { std::swap(record.wheel[0], record.wheel[3]); });
    expectMistake(Kind::kUpsideDown, {2, 2}, drive, [](Record& record, VehicleChannels&) {
      for (double& value : record.wheel[2]) value = -value;
    });
  }
  expectMistake(Kind::kSwapped, {1, 2}, shortDrive(),
                [](Record& record, VehicleChannels&) { std::swap(record.body[1], record.body[2]); });
}

TEST(VehicleClaims, NameTwoTopicsWithTheSameData) {
  expectMistake(Kind::kSameWheels, {1, 2}, shortDrive(),
                [](Record& record, VehicleChannels&) { record.wheel[1] = record.wheel[2]; });
  expectMistake(Kind::kSameTops, {0, 1}, shortDrive(),
                [](Record& record, VehicleChannels&) { record.body[1] = record.body[0]; });
}

TEST(VehicleClaims, NamePositionsOfTheWrongSign) {
  const auto turned = [](int axis) {
    return [axis](Record&, VehicleChannels& vehicle) {
      for (VehicleChannels::Strut& top : vehicle.struts) (*top.position)[axis] *= -1.0;
    };
  };
  expectMistake(Kind::kAhead, {0, 0}, byBody(), turned(0));
  expectMistake(Kind::kSide, {0, 0}, byBody(), turned(1));
  expectMistake(Kind::kAheadOfOne, {3, 3}, byBody(),
                [](Record&, VehicleChannels& vehicle) { vehicle.struts[3].position->x() *= -1.0; });
}

// What the readings before it were is what a late stream says.
void delay(std::vector<double>& stream, std::size_t samples) {
  std::rotate(stream.begin(), stream.end() - static_cast<std::ptrdiff_t>(samples), stream.end());
}

TEST(VehicleClaims, TellByHowMuchAStreamIsLate) {
  const auto late = [](const vehicle_drive::Drive& drive, const std::function<void(Record&)>& change) {
    return tell(vehicle_drive::made("robot", 1), drive, [&](Record& record, VehicleChannels&) { change(record); })
        .mistake;
  };
  const auto expectLate = [](const VehicleMistake& found, Kind kind, std::size_t strut, double seconds) {
    EXPECT_EQ(found.kind, kind);
    EXPECT_EQ(found.struts.first, strut);
    EXPECT_NEAR(found.size, seconds, 5e-4);
    EXPECT_LT(found.stddev, 5e-4);
    EXPECT_FALSE(found.isContradiction());
  };
  expectLate(late(shortDrive(), [](Record& record) { delay(record.wheel[1], 2); }), Kind::kWheelDelay, 1, 0.02);
  expectLate(late(shortDrive(), [](Record& record) { delay(record.body[2], 1); }), Kind::kTopDelay, 2, 0.01);
  expectLate(late(shortDrive(),
                  [](Record& record) {
                    for (auto& wheel : record.wheel) delay(wheel, 1);
                  }),
             Kind::kTopsDelay, 0, -0.01);
  expectLate(late(byBody(),
                  [](Record& record) {
                    for (auto& channel : record.imu) delay(channel, 1);
                  }),
             Kind::kBodyDelay, 0, 0.01);
}

// A delay that may be that of links, too, is not fitted.
TEST(VehicleClaims, TellWhatADelayThatMayBeOfLinksChanges) {
  for (const char* made : {"robot", "sedan"})
    for (const double late : {-5e-4, 5e-4}) {
      const vehicle_drive::Vehicle vehicle = vehicle_drive::made(made, 1);
      const Told told = tell(vehicle, shortDrive(), {}, late);
      EXPECT_EQ(told.mistake.kind, Kind::kNone);
      for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
        const WindowEstimate& estimate = *told.over_the_drive[i];
        const Eigen::Array2d truth(vehicle.b1(i), vehicle.b0(i)), own = estimate.theta.head<2>();
        const Eigen::Array2d variance =
            estimate.covariance.diagonal().head<2>().array() +
            (own * told.model_errors.row(static_cast<Eigen::Index>(i)).transpose()).square();
        EXPECT_TRUE(((own - truth).abs() < 3.0 * variance.sqrt()).all())
            << made << ' ' << late << ' ' << i << ": " << (own / truth).transpose() << " +- "
            << (variance.sqrt() / truth).transpose();
      }
    }
}

TEST(VehicleClaims, NameAPositionThoughAllWheelsAreALittleLate) {
  for (const double late : {-1e-3, -5e-4, 5e-4, 1e-3}) {
    const auto nearer = [](Record&, VehicleChannels& vehicle) { vehicle.struts[2].position->x() *= 0.8; };
    const VehicleMistake found = tell(vehicle_drive::made("robot", 1), byBody(), nearer, late).mistake;
    EXPECT_EQ(found.kind, Kind::kAheadOfOne) << late;
    EXPECT_EQ(found.struts.first, 2u) << late;
    EXPECT_NEAR(found.size, 1.0 / 0.8, 0.05) << late;
  }
}

TEST(VehicleClaims, TellWhatPositionsAreTimesTheFile) {
  for (const int axis : {0, 1}) {
    const VehicleMistake found =
        tell(vehicle_drive::made("robot", 1), byBody(), [&](Record&, VehicleChannels& vehicle) {
          for (VehicleChannels::Strut& top : vehicle.struts) (*top.position)[axis] *= 0.8;
        }).mistake;
    EXPECT_EQ(found.kind, axis == 0 ? Kind::kAhead : Kind::kSide);
    EXPECT_NEAR(found.size, 1.0 / 0.8, 0.03);
    EXPECT_TRUE(found.isContradiction());
  }
}

TEST(VehicleClaims, NameOnePositionThatChangesLessThanTheGyrosNoise) {
  vehicle_drive::Vehicle sedan = vehicle_drive::made("sedan", 1);
  sedan.roughness *= 16.0;  // class C
  for (const std::size_t strut : {0u, 3u}) {
    const VehicleMistake found = tell(sedan, byBody(), [&](Record&, VehicleChannels& vehicle) {
                                   vehicle.struts[strut].position->y() *= 0.8;
                                 }).mistake;
    EXPECT_EQ(found.kind, Kind::kSideOfOne);
    EXPECT_EQ(found.struts.first, strut);
    EXPECT_NEAR(found.size, 1.0 / 0.8, 4.0 * found.stddev);
    EXPECT_LT(found.stddev, 0.03);
  }
}

TEST(VehicleClaims, TellWhereTheBodysImuStands) {
  const VehicleMistake found = tell(vehicle_drive::made("robot", 1), byBody(), [](Record&, VehicleChannels& vehicle) {
                                 for (VehicleChannels::Strut& top : vehicle.struts) top.position->x() += 0.1;
                               }).mistake;
  EXPECT_EQ(found.kind, Kind::kShiftAhead);
  EXPECT_NEAR(found.size, -0.1, 0.01);
}

TEST(VehicleClaims, SayThatAStrutIsMissing) {
  for (const char* made : {"robot", "sedan"})
    for (const std::size_t known : {2u, 3u}) {
      vehicle_drive::Vehicle vehicle = vehicle_drive::made(made, 1);
      Record record = vehicle_drive::drive(vehicle, shortDrive());
      VehicleBlocks blocks(VehicleChannels::ofAccelerometers(known), 0.01);
      for (std::size_t k = 0; k < record.wheel.front().size(); ++k)
        for (std::size_t i = 0; i < known; ++i) {
          blocks.push({Sensor::kSprung, i, fromSeconds(0.01 * static_cast<double>(k)), {record.body[i][k]}});
          blocks.push({Sensor::kUnsprung, i, fromSeconds(0.01 * static_cast<double>(k)), {record.wheel[i][k]}});
        }
      VehicleClaims claims = blocks.claims();
      EXPECT_EQ(claims.find().kind, Kind::kOthers) << made << " " << known;
      EXPECT_GT(claims.modelErrors().minCoeff(), kWorthHaving) << made << " " << known;
    }
}

// Blocks last two seconds, one begins every second.
TEST(VehicleBlocks, KnowWithinABlockAndAHalfThatAnAxisOfTheGyroDies) {
  constexpr double kRate = 100.0, kDies = 40.0, kNoise = 1e-3;
  for (const char* made : {"robot", "sedan", "truck", "half"})
    for (const std::size_t axis : {0u, 1u, 2u}) {              // of Record::imu: rolling, pitching; 0: none dies
      if (axis == 1 && made == std::string("half")) continue;  // it does not roll
      vehicle_drive::Vehicle vehicle = vehicle_drive::made(made, 2);
      vehicle.roughness *= 16.0;
      const Told told = tell(vehicle, byBody(), [axis](Record& record, VehicleChannels&) {
        std::mt19937 random(3);
        std::normal_distribution<double> noise(0.0, kNoise);
        for (std::size_t k = kRate * kDies; axis > 0 && k < record.imu[axis].size(); ++k)
          record.imu[axis][k] = noise(random);
      });
      ASSERT_EQ(told.gyro_died.has_value(), axis > 0) << made << " " << axis;
      if (axis == 0) continue;
      EXPECT_NEAR(*told.gyro_died, kDies + 1.5, 1.6) << made << " " << axis;
    }
}

TEST(VehicleClaims, OfADeadGyroAreOfABodyThatDoesNotTurn) {
  enum How { kIsDead, kDies, kIsDeadBesideOwnSensor };
  for (const How how : {kIsDead, kDies, kIsDeadBesideOwnSensor})
    for (const std::size_t axis : {1u, 2u}) {  // of Record::imu: rolling, pitching
      const Told told = tell(vehicle_drive::made("robot", 1), byBody(), [&](Record& record, VehicleChannels& vehicle) {
        std::vector<double>& gyro = record.imu[axis];
        std::fill(gyro.begin() + (how == kDies ? static_cast<std::ptrdiff_t>(gyro.size() / 3) : 0), gyro.end(), 0.0);
        if (how == kIsDeadBesideOwnSensor) vehicle.struts.back().sprung = 0;
      });
      EXPECT_EQ(told.mistake.kind, Kind::kDeadGyro) << axis << " " << how;
    }
}

}  // namespace
}  // namespace suspension_health_monitor
