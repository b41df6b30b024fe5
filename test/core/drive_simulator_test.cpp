#include "suspension_health_monitor/simulation/drive_simulator.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "suspension_health_monitor/pi.h"

namespace suspension_health_monitor {
namespace {

SimulationOptions scenario(const std::string& name, double duration = 120.0) {
  SimulationOptions options;
  options.scenario = name;
  options.duration = duration;
  return options;
}

std::vector<DriveSample> drive(const SimulationOptions& options) {
  DriveSimulator simulator(options);
  std::vector<DriveSample> samples;
  while (std::optional<DriveSample> sample = simulator.next()) samples.push_back(*sample);
  return samples;
}

std::vector<double> sprungNoise(const SimulationOptions& options) {
  std::vector<double> noise;
  for (const DriveSample& s : drive(options)) noise.push_back(s.sprung->acceleration - s.truth.sprung_acceleration);
  return noise;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double standardDeviationOf(const std::vector<double>& values) {
  const double mean = meanOf(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(DriveSimulator, SamplesBothEndsOfTheDrive) {
  const std::vector<DriveSample> samples = drive(scenario("paper_clean", 2.0));
  ASSERT_EQ(samples.size(), 101u);
  EXPECT_EQ(samples.front().stamp, Stamp(0));
  EXPECT_EQ(samples[1].stamp, std::chrono::milliseconds(20));
  EXPECT_EQ(samples.back().stamp, std::chrono::seconds(2));
  EXPECT_EQ(samples.back().sprung->stamp, samples.back().stamp);
  EXPECT_EQ(samples.front().truth.travel, 0.0);
  EXPECT_EQ(samples.front().truth.travel_rate, 0.0);
}

TEST(DriveSimulator, AgreesWithAnIndependentSimulationOfThePaper) {
  std::ifstream file(TEST_DATA_DIR "/input_paper.csv");
  ASSERT_TRUE(file);
  std::string header;
  std::getline(file, header);
  DriveSimulator simulator(scenario("paper_outliers"));
  const double half_width = 0.024 * std::sqrt(3.0);
  std::vector<double> sprung, unsprung;
  double t, y, w;
  for (char comma; file >> t >> comma >> y >> comma >> w;) {
    const std::optional<DriveSample> sample = simulator.next();
    ASSERT_TRUE(sample);
    ASSERT_NEAR(toSeconds(sample->stamp), t, 1e-9);
    if (t >= 25.0 && t <= 26.0) continue;
    sprung.push_back(y - sample->truth.sprung_acceleration);
    unsprung.push_back(w - sample->truth.unsprung_acceleration);
    // The file's noise is uniform; the rest is for the integration error of both sides.
    EXPECT_LE(std::abs(sprung.back()), half_width + 1e-8) << "sprung, at " << t << " s";
    EXPECT_LE(std::abs(unsprung.back()), half_width + 1e-8) << "unsprung, at " << t << " s";
  }
  ASSERT_EQ(sprung.size(), 2001u - 51u);
  const double mean_tolerance = 4.0 * 0.024 / std::sqrt(1950.0);
  EXPECT_NEAR(meanOf(sprung), 0.0, mean_tolerance);
  EXPECT_NEAR(meanOf(unsprung), 0.0, mean_tolerance);
  // Of a uniform variable the sample deviation scatters by sqrt(0.8 / N) / 2 = 1 %.
  EXPECT_NEAR(standardDeviationOf(sprung), 0.024, 0.04 * 0.024);
}

// Steady response to the road (31), from the state-space matrices: height to z'' and w''.
Eigen::Vector2d steadyAccelerations(const RoadDrivenForm& form, double t) {
  const double amplitudes[] = {0.01, 0.02, 0.03, 0.04}, periods[] = {1.3, 1.9, 2.5, 2.8};
  Eigen::Vector2d sum(0.0, 0.0);
  for (int i = 0; i < 4; ++i) {
    const std::complex<double> s(0.0, 2.0 * kPi / periods[i]);
    const Eigen::Matrix4cd resolvent = s * Eigen::Matrix4cd::Identity() - form.a.cast<std::complex<double>>();
    const Eigen::Vector4cd states = resolvent.partialPivLu().solve(form.b.cast<std::complex<double>>());
    const std::complex<double> road = -amplitudes[i] * std::exp(s * t);
    sum += (s * s * road * states.head<2>()).real();
  }
  return sum;
}

TEST(DriveSimulator, SettlesToTheTransferFunctionOfTheFullForm) {
  SimulationOptions options = scenario("paper_clean", 40.0);
  options.vehicle = "ugv";
  options.damping_ramp = false;
  const RoadDrivenForm form = roadDrivenForm(makeScenario(options).vehicle);
  for (const DriveSample& sample : drive(options)) {
    const double t = toSeconds(sample.stamp);
    if (t < 20.0) continue;  // b1 / 2 = 2 1/s: the start has decayed by exp(-40)
    const Eigen::Vector2d expected = steadyAccelerations(form, t);
    ASSERT_NEAR(sample.truth.sprung_acceleration, expected[0], 1e-7) << "at " << t << " s";
    ASSERT_NEAR(sample.truth.unsprung_acceleration, expected[1], 1e-7) << "at " << t << " s";
  }
}

TEST(DriveSimulator, RelativeAccelerationIsTheSecondDerivativeOfTravel) {
  for (const char* vehicle : {"paper", "golden_car", "rover", "ugv"}) {
    SimulationOptions options = scenario("iso_road", 5.0);
    options.vehicle = vehicle;
    options.rate = 2000.0;
    const std::vector<DriveSample> samples = drive(options);
    double error = 0.0, square = 0.0;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
      const DriveTruth& here = samples[i].truth;
      const double difference = samples[i + 1].truth.travel - 2.0 * here.travel + samples[i - 1].truth.travel;
      const double relative = here.unsprung_acceleration - here.sprung_acceleration;
      error += std::pow(difference * 2000.0 * 2000.0 - relative, 2);
      square += relative * relative;
      const double slope = (samples[i + 1].truth.travel - samples[i - 1].truth.travel) * 1000.0;
      ASSERT_NEAR(slope, here.travel_rate, 1e-3);
      ASSERT_DOUBLE_EQ(here.sprung_acceleration,
                       here.damping_to_mass * here.travel_rate + here.stiffness_to_mass * here.travel);
    }
    // (omega h)^2 / 12 = 0.15 % at the fastest, 42.5 Hz.
    EXPECT_LT(std::sqrt(error / square), 2e-3) << vehicle;
  }
}

TEST(DriveSimulator, DampingFallsAlongThePapersRamp) {
  for (const DriveSample& sample : drive(scenario("paper_clean"))) {
    const double t = toSeconds(sample.stamp);
    const double expected = t < 40.0 ? 3.0 : t > 100.0 ? 2.0 : 3.0 - (t - 40.0) / 60.0;
    ASSERT_NEAR(sample.truth.damping_to_mass, expected, 1e-12) << "at " << t << " s";
    ASSERT_NEAR(sample.truth.stiffness_to_mass, 13.8, 1e-12);
  }
}

TEST(DriveSimulator, DampingRampFalseIsAHealthyDrive) {
  for (const char* name : {"paper_saturation", "iso_road"}) {
    SimulationOptions options = scenario(name, 110.0);
    options.rate = 1.0;
    options.damping_end_fraction = 0.5;
    options.damping_ramp = false;
    EXPECT_DOUBLE_EQ(drive(options).back().truth.damping_to_mass, makeScenario(options).vehicle.dampingToMass());
  }
}

TEST(DriveSimulator, IsoRoadLosesDampingOnlyWhenAsked) {
  SimulationOptions options = scenario("iso_road", 30.0);
  options.rate = 10.0;
  options.ramp_start = 10.0;
  options.ramp_end = 20.0;
  EXPECT_DOUBLE_EQ(drive(options).back().truth.damping_to_mass, 6.0);
  options.damping_end_fraction = 0.5;
  const std::vector<DriveSample> samples = drive(options);
  EXPECT_DOUBLE_EQ(samples.front().truth.damping_to_mass, 6.0);
  EXPECT_DOUBLE_EQ(samples[150].truth.damping_to_mass, 4.5);
  EXPECT_DOUBLE_EQ(samples.back().truth.damping_to_mass, 3.0);
}

TEST(DriveSimulator, BothReadingsAreZeroInTheLossWindowsOnly) {
  int lost = 0;
  for (const DriveSample& sample : drive(scenario("paper_outliers"))) {
    const double t = toSeconds(sample.stamp);
    const bool expected = (t >= 25.0 && t <= 26.0) || (t >= 65.0 && t <= 66.0);
    ASSERT_EQ(sample.sprung->acceleration == 0.0, expected) << "at " << t << " s";
    ASSERT_EQ(sample.unsprung->acceleration == 0.0, expected) << "at " << t << " s";
    if (!expected) continue;
    EXPECT_GT(std::abs(sample.truth.unsprung_acceleration), 1e-6) << "only the readings are lost";
    ++lost;
  }
  EXPECT_EQ(lost, 2 * 51);
}

TEST(DriveSimulator, BumpsAndNothingElseReachTheEndStops) {
  const std::vector<DriveSample> clean = drive(scenario("paper_clean"));
  const std::vector<DriveSample> saturated = drive(scenario("paper_saturation"));
  int beyond[2] = {0, 0};
  for (std::size_t i = 0; i < saturated.size(); ++i) {
    const DriveTruth& truth = saturated[i].truth;
    const double t = toSeconds(saturated[i].stamp);
    if (t < 83.0) {
      ASSERT_NEAR(truth.travel, clean[i].truth.travel, 1e-8) << "at " << t << " s";
    }
    const double linear = truth.damping_to_mass * truth.travel_rate + truth.stiffness_to_mass * truth.travel;
    const double stops = truth.sprung_acceleration - linear;
    if (std::abs(truth.travel) <= 0.09) {
      ASSERT_NEAR(stops, 0.0, 1e-12);
      continue;
    }
    ASSERT_NEAR(stops, std::copysign(1000.0 * (std::abs(truth.travel) - 0.09), truth.travel), 1e-9);
    ASSERT_TRUE(std::abs(t - 85.0) < 2.0 || std::abs(t - 110.0) < 2.0) << "end stop at " << t << " s";
    ++beyond[t < 100.0 ? 0 : 1];
  }
  EXPECT_GT(beyond[0], 0);
  EXPECT_GT(beyond[1], 0);
}

TEST(DriveSimulator, EndStopsLimitTheTravelByTheirEnergy) {
  SimulationOptions options = scenario("paper_saturation");
  options.rate = 500.0;
  double farthest = 0.0, fastest_arrival = 0.0, previous = 0.0;
  for (const DriveSample& sample : drive(options)) {
    const double travel = std::abs(sample.truth.travel);
    if (travel > 0.09 && previous <= 0.09) {
      fastest_arrival = std::max(fastest_arrival, std::abs(sample.truth.travel_rate));
    }
    farthest = std::max(farthest, travel);
    previous = travel;
  }
  // Beyond the gap x'' <= A - 1000 x with A = 7.6 m/s^2, the most that road and bump push, so a stop that is met at v
  // gives way by x with 1000 x^2 / 2 <= v^2 / 2 + A x.
  const double give = (7.6 + std::sqrt(7.6 * 7.6 + 1000.0 * fastest_arrival * fastest_arrival)) / 1000.0;
  EXPECT_GT(farthest, 0.09);
  EXPECT_LT(farthest, 0.09 + give);
}

TEST(DriveSimulator, StopsPushTheBodyAwayFromThem) {
  const EndStops stops{0.09, 1000.0};
  EXPECT_DOUBLE_EQ(stops.forcePerMass(0.05), 0.0);
  EXPECT_NEAR(stops.forcePerMass(0.10), 10.0, 1e-12);
  EXPECT_NEAR(stops.forcePerMass(-0.11), -20.0, 1e-12);
}

TEST(DriveSimulator, SameOptionsGiveIdenticalSamples) {
  SimulationOptions options = scenario("iso_road", 5.0);
  options.dropout = 0.1;
  options.stamp_jitter = 0.005;
  options.noise_distribution = "gaussian";
  const std::vector<DriveSample> first = drive(options), second = drive(options);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].sprung.has_value(), second[i].sprung.has_value());
    if (!first[i].sprung) continue;
    ASSERT_EQ(first[i].sprung->stamp, second[i].sprung->stamp);
    ASSERT_EQ(first[i].sprung->acceleration, second[i].sprung->acceleration);
  }
}

TEST(DriveSimulator, NoiseBelongsToTheSeedAlone) {
  SimulationOptions healthy = scenario("paper_clean", 60.0);
  healthy.damping_ramp = false;
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

TEST(DriveSimulator, NoiseHasTheStatedDeviationAndShape) {
  for (const char* distribution : {"uniform", "gaussian"}) {
    SimulationOptions options = scenario("paper_clean");
    options.noise_distribution = distribution;
    std::vector<double> sprung, unsprung, product;
    for (const DriveSample& s : drive(options)) {
      sprung.push_back(s.sprung->acceleration - s.truth.sprung_acceleration);
      unsprung.push_back(s.unsprung->acceleration - s.truth.unsprung_acceleration);
      product.push_back(sprung.back() * unsprung.back() / (0.024 * 0.024));
    }
    const double root = std::sqrt(static_cast<double>(sprung.size()));
    for (const std::vector<double>& noise : {sprung, unsprung}) {
      EXPECT_NEAR(meanOf(noise), 0.0, 4.0 * 0.024 / root) << distribution;
      // A sample deviation scatters by at most sqrt(2 / N) / 2 of itself (normal; uniform less).
      EXPECT_NEAR(standardDeviationOf(noise), 0.024, 4.0 * 0.024 * std::sqrt(0.5) / root) << distribution;
      const double largest = *std::max_element(noise.begin(), noise.end());
      // Of 6001 values the largest uniform one lies within 0.5 % of the edge, the largest normal one beyond 2.8 sigma.
      if (options.noise_distribution == "uniform") {
        EXPECT_LE(largest, 0.024 * std::sqrt(3.0));
        EXPECT_GT(largest, 0.024 * std::sqrt(3.0) * 0.995);
      } else {
        EXPECT_GT(largest, 0.024 * 2.8);
      }
    }
    EXPECT_NEAR(meanOf(product), 0.0, 4.0 / root) << "the two sensors' noises must be independent";
  }
}

TEST(DriveSimulator, LosesTheStatedShareOfMessagesOfEachSensor) {
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

TEST(DriveSimulator, JitterDelaysStampsButKeepsTheirOrder) {
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

TEST(DriveSimulator, SprungClockRunsAheadAsAsked) {
  SimulationOptions options = scenario("paper_clean", 100.0);
  options.clock_offset = 0.015;
  options.clock_skew = 2e-4;
  const DriveSample last = drive(options).back();
  EXPECT_EQ(last.unsprung->stamp, std::chrono::seconds(100));
  EXPECT_NEAR(toSeconds(last.sprung->stamp), 100.0 + 0.015 + 100.0 * 2e-4, 1e-9);
}

TEST(DriveSimulator, VehiclesHaveTheirPublishedRatios) {
  SimulationOptions options = scenario("iso_road", 0.0);
  const QuarterCar golden = makeScenario(options).vehicle;
  EXPECT_NEAR(golden.dampingToMass(), 6.0, 1e-12);
  EXPECT_NEAR(golden.stiffnessToMass(), 63.3, 1e-12);
  EXPECT_NEAR(golden.unsprung_mass / golden.sprung_mass, 0.15, 1e-12);
  EXPECT_NEAR(*golden.tyre_stiffness / golden.sprung_mass, 653.0, 1e-9);
  options.vehicle = "rover";
  options.damping_to_mass = 7.0;
  options.stiffness_to_mass = 90.0;
  const DriveTruth truth = drive(options).front().truth;
  EXPECT_NEAR(truth.damping_to_mass, 7.0, 1e-12);
  EXPECT_NEAR(truth.stiffness_to_mass, 90.0, 1e-12);
}

TEST(DriveSimulator, VehiclesHaveTheirOwnRoadAndSpeedUnlessToldOtherwise) {
  SimulationOptions options = scenario("iso_road", 0.0);
  options.vehicle = "rover";
  const RoadPoint own = makeScenario(options).road(3.0);
  options.iso_class = "E";
  options.speed = 2.0;
  EXPECT_EQ(makeScenario(options).road(3.0).height, own.height);
  options.iso_class = "F";
  EXPECT_NEAR(makeScenario(options).road(3.0).height, 2.0 * own.height, 1e-12);
  options.speed = 6.0;
  EXPECT_NEAR(makeScenario(options).road(1.0).height, 2.0 * own.height, 1e-12);
}

TEST(SimulationOptions, AreRefusedByNameAndValue) {
  const auto complaint = [](auto change) -> std::string {
    SimulationOptions options;
    change(options);
    try {
      DriveSimulator simulator(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const auto expectWords = [](const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << "got: " << message;
  };
  expectWords(complaint([](SimulationOptions& o) { o.scenario = "paper"; }), "scenario = \"paper\"");
  expectWords(complaint([](SimulationOptions& o) { o.iso_class = "I"; }), "iso_class = \"I\"");
  expectWords(complaint([](SimulationOptions& o) { o.rate = -50.0; }), "rate = -50");
  expectWords(complaint([](SimulationOptions& o) { o.noise = std::nan(""); }), "noise = nan");
  expectWords(complaint([](SimulationOptions& o) { o.stamp_jitter = 0.02; }), "stamp_jitter = 0.02");
  expectWords(complaint([](SimulationOptions& o) { o.ramp_end = 30.0; }), "ramp_end = 30");
  expectWords(complaint([](SimulationOptions& o) { o.speed = 0.0; }), "speed = 0");
}

TEST(SimulationOptions, DefaultsAreThePapersAndEveryOptionIsInTheTable) {
  SimulationOptions options;
  EXPECT_NO_THROW(validate(options));
  OptionMap values{{"scenario", "iso_road"}, {"seed", 7}, {"damping_ramp", false}, {"speed", 3}};
  takeOptions(values, kSimulationFields, options);
  EXPECT_TRUE(values.empty());
  EXPECT_EQ(options.scenario, "iso_road");
  EXPECT_EQ(options.seed, 7);
  EXPECT_FALSE(options.damping_ramp);
  EXPECT_DOUBLE_EQ(*options.speed, 3.0);
}

}  // namespace
}  // namespace suspension_health_monitor
