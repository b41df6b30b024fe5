#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/internal/signal/stream_gate.h"

namespace suspension_health_monitor {
namespace {

constexpr double kG = 9.81;

enum class Of { kBody, kWheel };

/// What an ideal sensor measures on a rough ISO road, gravity included.
std::vector<double> measured(Of side, double rate = 100.0, const std::string& vehicle = "ugv", double noise = 0.024) {
  SimulationOptions options = scenario("iso_road", 60.0);
  options.vehicle = vehicle;
  options.rate = rate;
  options.noise = noise;
  std::vector<double> readings;
  for (const DriveSample& sample : drive(options))
    readings.push_back(kG + (side == Of::kBody ? sample.sprung : sample.unsprung)->acceleration);
  return readings;
}

/// Nearest multiple of the resolution; 0: none.
double quantised(double reading, double resolution) {
  return resolution > 0.0 ? resolution * std::round(reading / resolution) : reading;
}

/// @return readings that are kept out as clipped when each comes `repeats` times.
std::uint64_t clippedOf(const std::vector<double>& readings, int repeats = 1) {
  StreamGate gate(std::chrono::milliseconds(10));
  int k = 0;
  for (const double reading : readings)
    for (int i = 0; i < repeats; ++i) gate.judge(++k * std::chrono::milliseconds(10), reading);
  return gate.rejected().count(RejectReason::kClipped);
}

struct Cut {
  double height;  // of the limits from the mean, in standard deviations
  bool below;     // a lower limit as well
  double gravity, resolution;
};

void expectFound(const Cut& cut, std::vector<double> readings) {
  SCOPED_TRACE("cut at " + std::to_string(cut.height) + ", below " + std::to_string(cut.below) + ", gravity " +
               std::to_string(cut.gravity) + ", resolution " + std::to_string(cut.resolution));
  const double distance = cut.height * standardDeviationOf(readings);
  for (double& reading : readings) {
    const double upper = quantised(cut.gravity + distance, cut.resolution);
    const double lower = quantised(cut.below ? cut.gravity - distance : -1e9, cut.resolution);
    reading = std::clamp(quantised(reading - kG + cut.gravity, cut.resolution), lower, upper);
  }
  const double highest = *std::max_element(readings.begin(), readings.end());
  const double lowest = *std::min_element(readings.begin(), readings.end());
  StreamGate gate(std::chrono::milliseconds(10));
  int at_limit = 0, found = 0;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const auto stamp = static_cast<int>(k) * std::chrono::milliseconds(10);
    const bool passes = gate.judge(stamp, readings[k]) != StreamGate::Verdict::kRejected;
    const bool limited = readings[k] == highest || (cut.below && readings[k] == lowest);
    EXPECT_TRUE(passes || limited) << k;
    if (k < readings.size() / 3) continue;  // it has learned the limits by then
    at_limit += limited ? 1 : 0;
    found += limited && !passes ? 1 : 0;
  }
  EXPECT_GT(at_limit, 50);
  EXPECT_EQ(found, at_limit);
}

TEST(Clipping, IsFoundHoweverHeavyItIs) {
  for (const Of side : {Of::kBody, Of::kWheel}) {
    const std::vector<double> readings = measured(side);
    for (const double height : {0.2, 0.36, 0.7, 1.0, 1.5})
      for (const bool below : {false, true})
        for (const double gravity : {kG, 0.0, -kG}) expectFound({height, below, gravity, 0.0}, readings);
  }
}

TEST(Clipping, OfASensorThatQuantisesIsFound) {
  const std::vector<double> readings = measured(Of::kBody);
  for (const double height : {0.36, 0.7, 1.0})
    for (const double resolution : {0.0006, 0.0048, 0.0096})  // 16 bit of +-2 g and +-16 g, 12 bit of +-2 g
      expectFound({height, true, kG, resolution}, readings);
}

TEST(Clipping, OfABodyThatIsSlowerThanTheSensorIsNoSensorThatIsStuck) {
  std::vector<double> readings = measured(Of::kBody, 1000.0);
  int above = 0;
  for (double& reading : readings) {
    above += reading > kG + 0.4 ? 1 : 0;
    reading = std::min(reading, kG + 0.4);
  }
  EXPECT_GT(clippedOf(readings), 0.8 * above);
}

TEST(Clipping, IsNotSeenInHealthyDrives) {
  for (const char* name : {"paper_clean", "paper_outliers", "paper_saturation", "iso_road"})
    for (const char* vehicle : {"paper", "golden_car", "rover", "ugv"}) {
      if (name != std::string("iso_road") && vehicle != std::string("paper")) continue;
      SimulationOptions options = scenario(name, 60.0);
      options.rate = 200.0;
      options.vehicle = vehicle;
      const std::vector<DriveSample> samples = drive(options);
      for (const double resolution : {0.0, 0.0006, 0.0096, 0.04, 0.15, 0.5}) {
        SCOPED_TRACE(std::string(name) + " " + vehicle + " " + std::to_string(resolution));
        std::vector<double> body, wheel;
        for (const DriveSample& sample : samples) {
          body.push_back(quantised(kG + sample.sprung->acceleration, resolution));
          wheel.push_back(quantised(kG + sample.unsprung->acceleration, resolution));
        }
        EXPECT_EQ(clippedOf(body), 0u);
        EXPECT_EQ(clippedOf(wheel), 0u);
      }
    }
}

TEST(Clipping, IsNotSeenInASensorWithoutNoiseThatQuantisesASlowMotion) {
  for (const double resolution : {0.0006, 0.0048, 0.0096, 0.04, 0.07, 0.15})
    for (const double top : {3.0, 3.02, 3.04, 3.07}) {
      SCOPED_TRACE(std::to_string(resolution) + " " + std::to_string(top));
      std::vector<double> swing;
      for (int k = 0; k < 60000; ++k) swing.push_back(quantised(kG + top * std::sin(0.00629 * k), resolution));
      EXPECT_EQ(clippedOf(swing), 0u);
    }
  const std::vector<double> measured_road = measured(Of::kBody, 1000.0, "ugv", 0.0);
  for (const double resolution : {0.0048, 0.0096, 0.04, 0.15}) {
    std::vector<double> road = measured_road;
    for (double& reading : road) reading = quantised(reading, resolution);
    EXPECT_EQ(clippedOf(road), 0u) << resolution;
  }
}

TEST(Clipping, IsNotSeenInADriverThatRepeatsReadings) {
  const std::vector<double> body = measured(Of::kBody), wheel = measured(Of::kWheel);
  for (const int repeats : {2, 3, 5, 10}) {
    EXPECT_EQ(clippedOf(body, repeats), 0u) << repeats;
    EXPECT_EQ(clippedOf(wheel, repeats), 0u) << repeats;
  }
}

TEST(Clipping, IsNotSeenInAVehicleThatIsParked) {
  std::mt19937 generator(4);
  std::normal_distribution<double> noise(0.0, 0.003);
  for (const double resolution : {0.0, 0.0001, 0.0006, 0.0048, 0.0096}) {
    std::vector<double> readings;
    for (int k = 0; k < 20000; ++k) readings.push_back(quantised(kG + noise(generator), resolution));
    for (const double reading : measured(Of::kBody)) readings.push_back(quantised(reading, resolution));
    for (int k = 0; k < 20000; ++k) readings.push_back(quantised(kG + noise(generator), resolution));
    EXPECT_EQ(clippedOf(readings), 0u) << resolution;
  }
}

TEST(Clipping, IsNotSeenInASensorThatSticksNearItsHighestReading) {
  std::vector<double> readings = measured(Of::kBody);
  const auto highest = std::max_element(readings.begin() + 1000, readings.end());
  std::fill(highest, std::min(highest + 500, readings.end()), *highest);
  EXPECT_LE(clippedOf(readings), 17u);  // from the third equal reading until it is too long for a top: not told before
  for (const double constant : {0.0, kG, -3.0}) EXPECT_EQ(clippedOf(std::vector<double>(5000, constant)), 0u);
}

}  // namespace
}  // namespace suspension_health_monitor
