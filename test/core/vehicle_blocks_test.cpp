// Blocks of a vehicle on drives of benchmark/vehicle_drive.h, which shares no code with the package. The long tables
// are those of benchmark/vehicle_blocks_table.cpp.
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "vehicle_told.h"

namespace suspension_health_monitor {
namespace {

using Sensor = VehicleReading::Sensor;

using vehicle_drive::Tracks;

void expectTruth(const vehicle_drive::Vehicle& vehicle, const Told& told, double tolerance) {
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
    SCOPED_TRACE(vehicle.name + " strut " + std::to_string(i));
    ASSERT_GT(told.estimates[i].size(), 30u);
    ASSERT_TRUE(told.over_the_drive[i]);
    EXPECT_NEAR(told.over_the_drive[i]->theta[kBlockDamping] / vehicle.b1(i), 1.0, tolerance);
    EXPECT_NEAR(told.over_the_drive[i]->theta[kBlockStiffness] / vehicle.b0(i), 1.0, tolerance);
    int inside = 0;
    for (const TopEstimate& each : told.estimates[i]) {
      const double b1 = vehicle.b1(i) / each.theta[0] - 1.0, b0 = vehicle.b0(i) / each.theta[1] - 1.0;
      inside += std::abs(b1) < 1.96 * each.relativeStddev(0) ? 1 : 0;
      inside += std::abs(b0) < 1.96 * each.relativeStddev(1) ? 1 : 0;
    }
    EXPECT_GT(inside, 0.8 * 2.0 * static_cast<double>(told.estimates[i].size())) << "of 95 %, windows overlap";
  }
}

TEST(VehicleBlocks, KnowsEveryStrutOfLinearVehicles) {
  for (const char* kind : {"half", "sedan", "robot"}) {
    const vehicle_drive::Vehicle vehicle = vehicle_drive::made(kind, 1);
    expectTruth(vehicle, tell(vehicle, shortDrive()), 0.02);
  }
}

TEST(VehicleBlocks, OneBodyImuIsEnough) {
  vehicle_drive::Drive drive = shortDrive();
  drive.imu = vehicle_drive::BodyImu{-0.1, 0.05};
  const vehicle_drive::Vehicle vehicle = vehicle_drive::made("robot", 1);
  expectTruth(vehicle, tell(vehicle, drive), 0.02);
}

TEST(VehicleBlocks, AMeasuredForceIsAColumn) {
  vehicle_drive::Drive drive = shortDrive();
  drive.pull = 600.0;
  drive.pull_x = 0.8;
  const vehicle_drive::Vehicle vehicle = vehicle_drive::made("sedan", 1);
  const Told told = tell(vehicle, drive);
  expectTruth(vehicle, told, 0.03);
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
    ASSERT_TRUE(told.over_the_drive[i]);
    const int at = kNumBlockParameters + 1;  // after friction
    const double stddev = std::sqrt(told.over_the_drive[i]->covariance(at, at));
    EXPECT_NEAR(told.over_the_drive[i]->theta[at], vehicle.mobility(i, drive.pull_x, drive.pull_y), 4.0 * stddev);
    EXPECT_LT(stddev, 0.05 * vehicle.mobility(i, vehicle.struts[i].x, vehicle.struts[i].y));
  }
}

TEST(VehicleBlocks, AWornStrutIsSeenThereAlone) {
  const vehicle_drive::Vehicle vehicle = vehicle_drive::made("robot", 1);
  vehicle_drive::Drive drive = shortDrive(80.0);
  constexpr double kWornAt = 40.0, kLost = 0.4;
  const double lost = kLost * vehicle.struts[1].damping;
  drive.hidden.resize(4);
  drive.hidden[1] = [=](double, double rate, double time) { return time > kWornAt ? -lost * rate : 0.0; };
  const Told told = tell(vehicle, drive);
  for (std::size_t i = 0; i < 4; ++i) {
    for (const TopEstimate& each : told.estimates[i]) {
      const double time = toSeconds(each.stamp) - 100.0, change = each.theta[0] / vehicle.b1(i) - 1.0;
      if (i != 1) {
        EXPECT_LT(std::abs(change), 5.0 * each.relativeStddev(0)) << "strut " << i << " at " << time;
        EXPECT_LT(std::abs(change), 0.1) << "strut " << i << " at " << time;
      } else if (time > kWornAt + 10.0) {
        EXPECT_NEAR(change, -kLost, 0.05) << time;
      }
    }
  }
}

TEST(VehicleBlocks, IdenticalTracksAreSaid) {
  vehicle_drive::Drive drive = shortDrive();
  drive.tracks = Tracks::kIdentical;
  const vehicle_drive::Vehicle vehicle = vehicle_drive::made("sedan", 1);
  const Told own = tell(vehicle, drive);
  for (std::size_t i = 0; i < 4; ++i)
    for (const TopEstimate& each : own.estimates[i]) {
      EXPECT_LT(std::abs(vehicle.b1(i) / each.theta[0] - 1.0), 4.0 * each.relativeStddev(0));
      EXPECT_LT(std::abs(vehicle.b0(i) / each.theta[1] - 1.0), 4.0 * each.relativeStddev(1));
    }
  drive.imu = vehicle_drive::BodyImu{-0.3, 0.1};
  const Told by_body = tell(vehicle, drive);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(by_body.estimates[i].empty());
    EXPECT_FALSE(by_body.over_the_drive[i]);
  }
  for (const Told& told : {own, by_body}) {
    EXPECT_EQ(told.mistake.kind, VehicleMistake::Kind::kAlike);
    const auto [first, second] = told.mistake.struts;
    EXPECT_NE(first, second);
    EXPECT_EQ(first / 2, second / 2) << "left and right of one axle";
  }
}

TEST(VehicleBlocks, OrderBetweenStreamsDoesNotMatter) {
  const vehicle_drive::Vehicle vehicle = vehicle_drive::made("half", 2);
  const vehicle_drive::Drive drive = shortDrive(40.0);
  const vehicle_drive::Record record = vehicle_drive::drive(vehicle, drive);
  std::vector<BlockVector> last;
  for (const std::size_t burst : {1, 70}) {  // readings of a sensor at once
    VehicleBlocks blocks(channelsOf(vehicle, drive), 1.0 / drive.rate);
    for (std::size_t from = 0; from < record.wheel[0].size(); from += burst)
      for (const bool is_wheel : {false, true})
        for (std::size_t i = 0; i < 2; ++i)
          for (std::size_t k = from; k < std::min(from + burst, record.wheel[0].size()); ++k) {
            const Stamp stamp = fromSeconds(static_cast<double>(k) / drive.rate);
            if (is_wheel)
              blocks.push({Sensor::kUnsprung, i, stamp, {record.wheel[i][k]}});
            else
              blocks.push({Sensor::kSprung, i, stamp, {record.body[i][k]}});
          }
    ASSERT_NE(blocks.estimate(1), nullptr);
    last.push_back(blocks.estimate(1)->theta);
  }
  // Friction's direction comes from the estimate of the time.
  EXPECT_NEAR(last[0][kBlockDamping], last[1][kBlockDamping], 0.01 * last[0][kBlockDamping]);
  EXPECT_NEAR(last[0][kBlockStiffness], last[1][kBlockStiffness], 0.01 * last[0][kBlockStiffness]);
}

TEST(VehicleBlocks, GapsCostBlocksOnly) {
  const vehicle_drive::Vehicle vehicle = vehicle_drive::made("half", 1);
  const vehicle_drive::Drive drive = shortDrive();
  const vehicle_drive::Record record = vehicle_drive::drive(vehicle, drive);
  VehicleBlocks blocks(channelsOf(vehicle, drive), 1.0 / drive.rate);
  for (std::size_t k = 0; k < record.wheel[0].size(); ++k) {
    const Stamp stamp = fromSeconds(static_cast<double>(k) / drive.rate);
    for (std::size_t i = 0; i < 2; ++i) {
      if (i == 1 && k > 2000 && k < 2700) continue;  // its top is silent for 7 s
      blocks.push({Sensor::kSprung, i, stamp, {record.body[i][k]}});
    }
    for (std::size_t i = 0; i < 2; ++i) blocks.push({Sensor::kUnsprung, i, stamp, {record.wheel[i][k]}});
  }
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_NE(blocks.estimate(i), nullptr);
    EXPECT_NEAR(blocks.estimate(i)->theta[kBlockDamping] / vehicle.b1(i), 1.0, 0.05);
    EXPECT_GT(toSeconds(blocks.estimate(i)->stamp), 57.0);
  }
}

TEST(VehicleBlocks, RowsAreThoseOfTheBody) {
  const vehicle_drive::Vehicle vehicle = vehicle_drive::made("sedan", 2);
  const vehicle_drive::Drive drive = shortDrive();
  const vehicle_drive::Record record = vehicle_drive::drive(vehicle, drive);
  VehicleBlocks blocks(channelsOf(vehicle, drive), 1.0 / drive.rate);
  for (std::size_t k = 0; k < record.wheel[0].size(); ++k)
    for (std::size_t i = 0; i < 4; ++i) {
      const Stamp stamp = fromSeconds(static_cast<double>(k) / drive.rate);
      blocks.push({Sensor::kSprung, i, stamp, {record.body[i][k]}});
      blocks.push({Sensor::kUnsprung, i, stamp, {record.wheel[i][k]}});
    }
  BodyRows rows;
  ASSERT_TRUE(blocks.rows(rows));
  EXPECT_EQ(blocks.rowsOfHalves().size(), 2u);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      const double truth = vehicle.mobility(i, j) * vehicle.struts[j].damping;
      EXPECT_NEAR(rows.rate(row, column), truth, 5.0 * std::sqrt(rows.covariance[i](column, column)));
    }
}

TEST(VehicleBlocks, RefusesWhatIsNoVehicle) {
  VehicleChannels channels;
  EXPECT_THROW(VehicleBlocks(channels, 0.01), std::invalid_argument);
  channels.struts.resize(2);
  channels.struts[0].sprung = 0;
  EXPECT_THROW(VehicleBlocks(channels, 0.01), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
