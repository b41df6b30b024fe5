#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/internal/simulation/sensors.h"

namespace suspension_health_monitor {
namespace {

std::vector<double> sprungNoise(const SimulationOptions& options) {
  std::vector<double> noise;
  for (const DriveSample& s : drive(options)) noise.push_back(s.sprung->acceleration - s.truth.sprung_acceleration);
  return noise;
}

TEST(Accelerometer, NoiseBelongsToTheSeedAlone) {
  SimulationOptions healthy = scenario("paper_clean", 60.0);
  healthy.damping_end_fraction = 1.0;
  const std::vector<double> reference = sprungNoise(healthy);
  SimulationOptions other_seed = healthy;
  other_seed.seed = 2;
  EXPECT_GT(std::abs(sprungNoise(other_seed)[10] - reference[10]), 1e-6);
  const std::vector<double> faulty = sprungNoise(scenario("paper_saturation", 60.0));
  SimulationOptions elsewhere = scenario("iso_road", 60.0);
  elsewhere.stamp_jitter = 0.004;
  elsewhere.vehicle = "rover";
  const std::vector<double> on_iso_road = sprungNoise(elsewhere);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    ASSERT_NEAR(faulty[i], reference[i], 1e-13);
    ASSERT_NEAR(on_iso_road[i], reference[i], 1e-13);
  }
}

TEST(Accelerometer, NoiseHasTheStatedDeviationAndShape) {
  for (const bool gaussian : {false, true}) {
    SCOPED_TRACE(gaussian ? "gaussian" : "uniform");
    SimulationOptions options = scenario("paper_clean");
    options.gaussian_noise = gaussian;
    std::vector<double> sprung, unsprung, product;
    for (const DriveSample& s : drive(options)) {
      sprung.push_back(s.sprung->acceleration - s.truth.sprung_acceleration);
      unsprung.push_back(s.unsprung->acceleration - s.truth.unsprung_acceleration);
      product.push_back(sprung.back() * unsprung.back() / (0.024 * 0.024));
    }
    const double root = std::sqrt(static_cast<double>(sprung.size()));
    for (const std::vector<double>& noise : {sprung, unsprung}) {
      EXPECT_NEAR(meanOf(noise), 0.0, 4.0 * 0.024 / root);
      // A sample deviation scatters by at most sqrt(2 / N) / 2 of itself (normal; uniform less).
      EXPECT_NEAR(standardDeviationOf(noise), 0.024, 4.0 * 0.024 * std::sqrt(0.5) / root);
      const double largest = *std::max_element(noise.begin(), noise.end());
      // Of 6001 values the largest uniform one lies within 0.5 % of the edge, the largest normal one beyond 2.8 sigma.
      if (gaussian) {
        EXPECT_GT(largest, 0.024 * 2.8);
      } else {
        EXPECT_LE(largest, 0.024 * std::sqrt(3.0));
        EXPECT_GT(largest, 0.024 * std::sqrt(3.0) * 0.995);
      }
    }
    EXPECT_NEAR(meanOf(product), 0.0, 4.0 / root) << "the two sensors' noises must be independent";
  }
}

TEST(Accelerometer, LosesTheStatedShareOfMessagesOfEachSensor) {
  SimulationOptions options = scenario("paper_clean");
  const std::vector<DriveSample> complete = drive(options);
  options.dropout = 0.2;
  const std::vector<DriveSample> samples = drive(options);
  double sprung = 0.0, unsprung = 0.0, both = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sprung += !samples[i].sprung;
    unsprung += !samples[i].unsprung;
    both += !samples[i].sprung && !samples[i].unsprung;
    if (samples[i].sprung) {
      ASSERT_EQ(samples[i].sprung->acceleration, complete[i].sprung->acceleration);
    }
  }
  const double n = static_cast<double>(samples.size());
  const auto tolerance = [n](double share) { return 4.0 * std::sqrt(share * (1.0 - share) / n); };
  EXPECT_NEAR(sprung / n, 0.2, tolerance(0.2));
  EXPECT_NEAR(unsprung / n, 0.2, tolerance(0.2));
  EXPECT_NEAR(both / n, 0.04, tolerance(0.04));
}

TEST(Accelerometer, JitterDelaysStampsButKeepsTheirOrder) {
  SimulationOptions options = scenario("paper_clean");
  options.stamp_jitter = 0.019;
  std::vector<double> delays;
  Stamp last{-1};
  for (const DriveSample& sample : drive(options)) {
    delays.push_back(toSeconds(sample.unsprung->stamp - sample.stamp));
    EXPECT_GT(sample.unsprung->stamp, last);
    last = sample.unsprung->stamp;
  }
  EXPECT_GE(*std::min_element(delays.begin(), delays.end()), 0.0);
  EXPECT_LE(*std::max_element(delays.begin(), delays.end()), 0.019);
  const double deviation = 0.019 / std::sqrt(12.0);
  EXPECT_NEAR(meanOf(delays), 0.0095, 4.0 * deviation / std::sqrt(static_cast<double>(delays.size())));
}

TEST(Accelerometer, SprungClockRunsAheadAsAsked) {
  SimulationOptions options = scenario("paper_clean", 100.0);
  options.clock_offset = 0.015;
  options.clock_skew = 2e-4;
  const DriveSample last = drive(options).back();
  EXPECT_EQ(last.unsprung->stamp, std::chrono::seconds(100));
  EXPECT_NEAR(toSeconds(last.sprung->stamp), 100.0 + 0.015 + 100.0 * 2e-4, 1e-9);
}

}  // namespace
}  // namespace suspension_health_monitor
