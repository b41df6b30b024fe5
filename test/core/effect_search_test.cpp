#include "suspension_health_monitor/internal/search/effect_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hidden_effect.h"
#include "recorded_drive.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"

namespace suspension_health_monitor {
namespace {

using Names = std::vector<std::string>;

constexpr double kNoise = 0.03;  // [m/s^2]

SearchResult search(const DriveRecord& record) {
  DiagnoseOptions options;
  options.most_effects = 2;
  SearchResult result = searchEffects({&record}, {6.6, 60.0, {}, {}}, options);
  EXPECT_TRUE(result);
  return result;
}

SimulationOptions driveWith(const std::vector<std::pair<std::string, std::vector<double>>>& hidden) {
  SimulationOptions options = carDrive(120.0, kNoise);
  std::vector<ActiveEffect> effects;
  for (const auto& [name, shapes] : hidden) effects.push_back(hiddenEffect(options, name, shapes, 0.15));
  options.hidden = effects;
  return options;
}

// What the true model leaves of a free run, after the start: noise of both sensors, and what sampling loses of w''.
double leftByTheTruth(const SimulationOptions& options, const DriveRecord& record) {
  const DriveSegment& segment = record.segments().front();
  std::vector<double> predicted;
  EXPECT_TRUE(runFree({6.0, 63.3, options.hidden, {}}, segment, {}, predicted));
  constexpr std::size_t settled = 300;
  double square = 0.0;
  for (std::size_t k = settled; k < predicted.size(); ++k) square += std::pow(segment.sprung[k] - predicted[k], 2);
  return std::sqrt(square / static_cast<double>(predicted.size() - settled));
}

class HiddenEffect : public testing::TestWithParam<std::pair<const char*, std::vector<double>>> {};

TEST_P(HiddenEffect, IsNamedAndTakesTheErrorToWhatTheTruthLeaves) {
  const auto& [name, shapes] = GetParam();
  const SimulationOptions options = driveWith({{name, shapes}});
  const DriveRecord record = recorded(options);
  const SearchResult result = search(record);
  const double left = leftByTheTruth(options, record);
  EXPECT_EQ(result.verdict, Verdict::kEffectFound);
  EXPECT_EQ(result.selected, Names{name});
  ASSERT_TRUE(result.extended && result.final_fit);
  EXPECT_GT(result.base.held_out_rmse, 1.3 * left);
  EXPECT_NEAR(result.extended->held_out_rmse, left, 0.1 * left);
  EXPECT_TRUE(result.extended->significant);
  EXPECT_GT(result.extended->significance, 0.0);
  EXPECT_GT(result.extended_fit_percent, result.base_fit_percent);
  const ActiveEffect& found = result.final_fit->model.effects.at(0);
  EXPECT_NEAR(found.coefficient, options.hidden[0].coefficient, 0.2 * options.hidden[0].coefficient);
  EXPECT_NEAR(result.final_fit->model.damping_to_mass, 6.0, 0.1 * 6.0);
  EXPECT_NEAR(result.final_fit->model.stiffness_to_mass, 63.3, 0.1 * 63.3);
  for (std::size_t i = 1; i < result.ranking.size(); ++i)
    EXPECT_LE(result.ranking[i - 1].held_out_rmse, result.ranking[i].held_out_rmse);
}

// Travel has an rms of 0.008 m, its rate of 0.19 m/s.
INSTANTIATE_TEST_SUITE_P(Force, HiddenEffect,
                         testing::Values(std::make_pair("bump_stop", std::vector<double>{0.012}),
                                         std::make_pair("coulomb_friction", std::vector<double>{0.008}),
                                         std::make_pair("asymmetric_damping", std::vector<double>{}),
                                         std::make_pair("stiffness_drift", std::vector<double>{})),
                         [](const auto& test) { return std::string(test.param.first); });

TEST(EffectSearch, NothingIsMissingFromALinearDrive) {
  const SearchResult result = search(recorded(driveWith({})));
  EXPECT_EQ(result.verdict, Verdict::kNothingMissing);
  EXPECT_TRUE(result.selected.empty());
  EXPECT_TRUE(result.indistinguishable.empty());
  EXPECT_FALSE(result.extended);
  EXPECT_LT(result.base.held_out_rmse, 1.12 * kNoise);
  EXPECT_EQ(result.ranking.size(), forceEffects().size() + 3);  // the faults that need no other axes of the IMU
}

TEST(EffectSearch, TwoEffectsAreBothNamed) {
  const SearchResult result = search(recorded(driveWith({{"asymmetric_damping", {}}, {"bump_stop", {0.012}}})));
  EXPECT_EQ(result.verdict, Verdict::kEffectFound);
  Names selected = result.selected;
  std::sort(selected.begin(), selected.end());
  EXPECT_EQ(selected, (Names{"asymmetric_damping", "bump_stop"}));
}

// A force on the body from elsewhere, an engine or a load that swings: the body moves by it, the wheel hardly.
SearchResult searchWithDisturbance(double (*force)(double t)) {
  Drive record_drive;
  const double b1 = 6.0, b0 = 63.3;
  double z = 0.0, z_rate = 0.0;  // what the force adds to the body's motion: z'' = F/M - b1 z' - b0 z
  for (const DriveSample& sample : drive(carDrive(120.0, kNoise))) {
    const double t = toSeconds(sample.stamp);
    const double added = force(t) - b1 * z_rate - b0 * z;
    record_drive.samples.push_back({sample.stamp, sample.sprung->acceleration + added, sample.unsprung->acceleration});
    constexpr int steps = 50;
    for (int i = 0; i < steps; ++i) {
      const double h = 0.01 / steps;
      z_rate += h * (force(t + i * h) - b1 * z_rate - b0 * z);
      z += h * z_rate;
    }
  }
  const DriveRecord record(record_drive, 0.01, 1);
  return search(record);
}

TEST(EffectSearch, AForceFromElsewhereStaysUnexplained) {
  const SearchResult sine = searchWithDisturbance([](double t) { return 0.4 * std::sin(2.0 * M_PI * 3.3 * t); });
  EXPECT_EQ(sine.verdict, Verdict::kUnexplained);
  EXPECT_TRUE(sine.selected.empty());
  EXPECT_FALSE(sine.extended);
  EXPECT_GT(sine.structured_share, 0.5);
  const SearchResult bursts = searchWithDisturbance([](double t) {
    return 0.6 * std::sin(2.0 * M_PI * (0.9 * t + 0.7 * std::sin(0.31 * t))) * std::sin(0.17 * t * t);
  });
  EXPECT_EQ(bursts.verdict, Verdict::kUnexplained);
  EXPECT_TRUE(bursts.selected.empty());
}

TEST(EffectSearch, ReportsItsProgressUpToOne) {
  const DriveRecord record = recorded(carDrive(30.0, kNoise));
  std::vector<double> shares;
  DiagnoseOptions options;
  options.candidates = {{findEffect(forceEffects(), "asymmetric_spring")}, {}};
  options.threads = options.most_effects = 1;
  options.progress = [&](double share) { shares.push_back(share); };
  ASSERT_TRUE(searchEffects({&record}, {6.6, 60.0, {}, {}}, options));
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(EffectSearch, ADriveThatIsTooShortHasNoResult) {
  const DriveRecord record = recorded(carDrive(3.0, kNoise));
  EXPECT_EQ(searchEffects({&record}, {6.0, 63.3, {}, {}}).shortcoming, Shortcoming::kTooShort);
  EXPECT_EQ(searchEffects({}, {6.0, 63.3, {}, {}}).shortcoming, Shortcoming::kTooShort);
}

// The law breaks once the choice is made, as a solver may at the edge of stability.
TEST(EffectSearch, AFinalFitThatFailsLeavesTheModelThatWasJudged) {
  const DriveRecord record = recorded(driveWith({{"asymmetric_spring", {}}}));
  bool broken = false;
  DiagnoseOptions options;
  options.candidates = {
      {{"breaking_spring", "c |d|", "1/s^2", "a spring", "",
        [&](const StrutMotion& m, const double*) { return broken ? std::nan("") : std::abs(m.travel); }}},
      {}};
  options.threads = options.most_effects = 1;
  options.progress = [&](double share) { broken = share > 0.1 + 0.85 - 1e-9; };
  const SearchResult result = searchEffects({&record}, {6.6, 60.0, {}, {}}, options);
  ASSERT_EQ(result.verdict, Verdict::kEffectFound);
  ASSERT_TRUE(result.extended && result.final_fit);
  EXPECT_FALSE(result.final_fit->all_samples);
  EXPECT_EQ(result.final_fit->model.effects.at(0).coefficient, result.extended->model.effects.at(0).coefficient);
  EXPECT_EQ(result.final_fit->stddev.size(), numbersOf(result.model()).size());
}

}  // namespace
}  // namespace suspension_health_monitor
