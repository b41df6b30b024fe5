// What measured records ask of the search: laws that carry most of the force, effects that explain most but not all,
// coefficients that physics forbids, and drifts.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "hidden_effect.h"
#include "recorded_drive.h"
#include "suspension_health_monitor/internal/record/motion.h"
#include "suspension_health_monitor/internal/search/effect_search.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

using Names = std::vector<std::string>;

constexpr double kPeriod = 0.01, kNoise = 0.02;  // [s], [m/s^2]

/// A strut on a rig that shakes its lower end, integrated by the classical Runge-Kutta method in steps of 1/40 sample.
struct Rig {
  std::function<double(double d, double v, double s, double t)> force;  ///< z'' [m/s^2]
  std::function<double(double t)> shake;                                ///< w'' [m/s^2]
  std::function<double(double d, double s)> memory_rate = [](double, double) { return 0.0; };

  Drive drive(int samples) const {
    RandomStream random(7, RandomPurpose::kSprungNoise);
    Drive result;
    State x{};
    for (int k = 0; k < samples; ++k) {
      const double t = k * kPeriod;
      result.samples.push_back({fromSeconds(t), force(x.d, x.v, x.s, t) + kNoise * random.gaussian(),
                                shake(t) + kNoise * random.gaussian()});
      for (int i = 0; i < kSteps; ++i) step(t + i * kStep, x);
    }
    return result;
  }

 private:
  struct State {
    double d = 0.0, v = 0.0, s = 0.0;

    State moved(double by, const State& slope) const { return {d + by * slope.d, v + by * slope.v, s + by * slope.s}; }
  };
  static constexpr int kSteps = 40;
  static constexpr double kStep = kPeriod / kSteps;

  State slope(double t, const State& x) const {
    return {x.v, shake(t) - force(x.d, x.v, x.s, t), memory_rate(x.d, x.s)};
  }

  void step(double t, State& x) const {
    const State k1 = slope(t, x), k2 = slope(t + kStep / 2, x.moved(kStep / 2, k1));
    const State k3 = slope(t + kStep / 2, x.moved(kStep / 2, k2)), k4 = slope(t + kStep, x.moved(kStep, k3));
    x = x.moved(kStep / 6, k1).moved(kStep / 3, k2).moved(kStep / 3, k3).moved(kStep / 6, k4);
  }
};

SearchResult search(const std::vector<Drive>& drives, const StrutModel& start, EffectLibrary candidates) {
  const std::deque<DriveRecord> records = makeRecords(drives, kPeriod, start);
  DiagnoseOptions options;
  options.candidates = std::move(candidates);
  SearchResult result = searchEffects(pointersTo(records), start, options);
  EXPECT_TRUE(result);
  return result;
}

EffectLibrary withoutSensorFaultsOfOtherAxes() {
  EffectLibrary library = builtInEffects();
  library.readings.erase(library.readings.begin() + 3, library.readings.end());
  return library;
}

EffectLibrary only(const char* name) { return {{findEffect(forceEffects(), name)}, {}}; }

// A damper with 1.6 m/s^2 of dry friction: as heavy as all that is linear. Least squares sees a b1 of 100 for 20.
double frictionRig(double d, double v) { return 20.0 * v + 67.0 * d + 1.6 * std::tanh(v / 0.008); }

double twoSines(double t) { return 2.0 * std::sin(2.0 * M_PI * 0.9 * t) + 1.5 * std::sin(2.0 * M_PI * 1.37 * t + 1.0); }

const StrutModel kTooDamped{100.0, 120.0, {}, {}};

TEST(MeasuredRecordRules, FrictionThatCarriesMostOfTheForceIsFoundFromItsSecondStart) {
  const Rig rig{[](double d, double v, double, double) { return frictionRig(d, v); }, twoSines};
  const SearchResult result = search({rig.drive(6000)}, kTooDamped, withoutSensorFaultsOfOtherAxes());
  EXPECT_EQ(result.verdict, Verdict::kEffectFound);
  ASSERT_EQ(result.selected, Names{"coulomb_friction"});
  EXPECT_NEAR(result.final_fit->model.effects[0].coefficient, 1.6, 0.08);
  EXPECT_NEAR(result.final_fit->model.damping_to_mass, 20.0, 1.0);
}

TEST(MeasuredRecordRules, WhatExplainsMostButNotAllIsTheMainSuspectWithItsModel) {
  // Beside the friction a force that comes from elsewhere.
  const Rig rig{[](double d, double v, double, double t) {
                  return frictionRig(d, v) + 0.12 * std::sin(2.0 * M_PI * (2.1 * t + 0.7 * std::sin(0.31 * t)));
                },
                twoSines};
  SearchResult result = search({rig.drive(6000)}, kTooDamped, withoutSensorFaultsOfOtherAxes());
  EXPECT_NE(result.verdict, Verdict::kNothingMissing);
  ASSERT_EQ(result.selected, Names{"coulomb_friction"});
  EXPECT_GT(result.explained_share, 0.5);
  EXPECT_LT(result.explained_share, 1.0);
  ASSERT_TRUE(result.extended && result.final_fit);
  EXPECT_EQ(result.model().effects.at(0).effect.name, "coulomb_friction");
  EXPECT_NEAR(result.model().effects.at(0).coefficient, 1.6, 0.16);
}

TEST(MeasuredRecordRules, ACoefficientThatPhysicsForbidsNamesNothing) {
  SimulationOptions options = carDrive(120.0, kNoise);
  ActiveEffect wrong = hiddenEffect(options, "quadratic_damping", {}, 0.15);
  wrong.coefficient *= -1.0;
  options.hidden = {wrong};
  const DriveRecord record = recorded(options);
  DiagnoseOptions searching;
  searching.candidates = only("quadratic_damping");
  const SearchResult result = searchEffects({&record}, {6.6, 60.0, {}, {}}, searching);
  EXPECT_EQ(result.verdict, Verdict::kUnexplained);
  EXPECT_TRUE(result.selected.empty());
  ASSERT_EQ(result.ranking.size(), 1u);
  EXPECT_FALSE(result.ranking[0].fitted);
  EXPECT_EQ(result.ranking[0].failure, FitFailure::kWrongSign);
  EXPECT_EQ(result.ranking[0].held_out_rmse, result.base.held_out_rmse);
  EXPECT_STRNE(reasonOf(result.ranking[0].failure), "");
}

TEST(MeasuredRecordRules, AShapeAtTheEndOfItsRangeNamesNothingUnlessTheEndIsOpen) {
  const MotionScale scale{0.02, 0.5, 0.1};
  const auto at = [&](const char* name, double shape) {
    return hasShapeAtEnd({findEffect(forceEffects(), name), 1.0, {shape}}, scale);
  };
  EXPECT_TRUE(at("bump_stop", 0.2 * 0.02));
  EXPECT_TRUE(at("bump_stop", 4.0 * 0.02));
  EXPECT_FALSE(at("bump_stop", 0.02));
  EXPECT_FALSE(at("coulomb_friction", 0.01 * 0.5));  // friction that turns at once is friction
  EXPECT_TRUE(at("coulomb_friction", 0.5 * 0.5));    // and that turns slowly is damping
  EXPECT_FALSE(hasShapeAtEnd({findEffect(forceEffects(), "asymmetric_spring"), 1.0, {}}, scale));
}

TEST(MeasuredRecordRules, ADriftGoesOnFromDriveToDrive) {
  constexpr double duration = 60.0;
  const auto roughRoad = [](double t) {
    double sum = 0.0;
    for (int i = 0; i < 12; ++i) sum += std::sin(2.0 * M_PI * (0.7 + 0.83 * i) * t + 1.7 * i * i);
    return 0.8 * sum;
  };
  const auto wearing = [&](double before) {
    const Rig rig{
        [before](double d, double v, double, double t) { return (6.0 - 0.025 * (before + t)) * v + 63.0 * d; },
        roughRoad};
    return rig.drive(static_cast<int>(duration / kPeriod));
  };
  const StrutModel start{5.0, 60.0, {}, {}};
  const SearchResult goes_on = search({wearing(0.0), wearing(duration)}, start, only("damping_drift"));
  EXPECT_EQ(goes_on.verdict, Verdict::kEffectFound);
  ASSERT_EQ(goes_on.selected, Names{"damping_drift"});
  EXPECT_NEAR(goes_on.final_fit->model.effects[0].coefficient, -0.025, 0.001);
  const SearchResult anew = search({wearing(0.0), wearing(0.0)}, start, only("damping_drift"));
  EXPECT_NE(anew.verdict, Verdict::kEffectFound);
}

TEST(MeasuredRecordRules, ASweepTellsNoDriftFromAnAnswerToFrequency) {
  // A mount in series: the damping falls with the frequency, which rises with time from 0.5 to 6 Hz.
  constexpr double duration = 120.0;
  const Rig rig{[](double d, double v, double s, double) { return 4.0 * v + 63.0 * d + 40.0 * (d - s); },
                [](double t) { return 4.0 * std::sin(2.0 * M_PI * (0.5 * t + 5.5 / (2.0 * duration) * t * t)); },
                [](double d, double s) { return (d - s) / 0.1; }};
  const std::vector<Drive> sweep{rig.drive(static_cast<int>(duration / kPeriod))};
  const StrutModel start{6.0, 70.0, {}, {}};
  const SearchResult drift_only = search(sweep, start, only("damping_drift"));
  EXPECT_TRUE(drift_only.selected.empty());
  const SearchResult all = search(sweep, start, withoutSensorFaultsOfOtherAxes());
  EXPECT_EQ(all.verdict, Verdict::kEffectFound);
  EXPECT_EQ(all.selected, Names{"viscoelastic_mount"});
}

}  // namespace
}  // namespace suspension_health_monitor
