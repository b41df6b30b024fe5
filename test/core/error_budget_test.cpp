#include "suspension_health_monitor/internal/monitor/error_budget.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "random_rows.h"

namespace suspension_health_monitor {
namespace {

constexpr double kForgetting = 0.99, kPeriod = 0.02;
const IntegralFilterOptions kFilter{30, kPeriod, IntegrationRule::kBandLimited};

double squareDifference(double larger, double smaller) { return larger * larger - smaller * smaller; }

// The mean of phi phi' by hand: R^-1 turns the moment of wrong times into a shift, of which a third of the square
// counts. It is the true strut, the estimate less that shift, that makes the moment. Readings that go up and down
// between -1 and 1 have the rate 2 / T throughout.
TEST(ErrorBudget, TimesAndWhatTheInputIsOffByAddAsSquares) {
  RecursiveOptions recursive;
  recursive.forgetting_factor = kForgetting;
  PairedEstimators estimators(SensorColumns::kNone, recursive, {});
  const RegressorNoise noise(kFilter);
  ErrorBudget budget(kFilter, noise, kNumStrutParameters, kForgetting, false);
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  double weight = 0.0, body = 1.0;
  for (const RegressionRow& row : randomRows(vectorOf({3.0, 13.8}), 3000, 0.1, 1)) {
    estimators.update(row);
    sum = kForgetting * sum + row.regressor * row.regressor.transpose();
    weight = kForgetting * weight + 1.0;
    budget.addSample({Stamp{}, body, 0.0}, true);
    body = -body;
  }
  const Eigen::Vector2d strut = estimators.leastAbsolute().parameters();
  const auto stddevs = [&]() -> Eigen::Array2d {
    StrutEstimate ls, la;
    la.damping_to_mass = strut[0];
    la.stiffness_to_mass = strut[1];
    la.effective_rows = weight;
    budget.describe(estimators, nullptr, ls, la);
    return {la.damping_to_mass_stddev, la.stiffness_to_mass_stddev};
  };
  const Eigen::Array2d plain = stddevs();
  const Eigen::Vector2d input(0.02, 0.03);
  budget.setInputStddevs(input);
  const Eigen::Array2d with_input = stddevs();
  constexpr double kStampError = 1e-3;
  budget.setResamplingErrors({{kStampError, 0.0}, {0.0, 0.0}});
  const Eigen::Array2d with_stamps = stddevs();
  const double of_body = std::pow(kStampError * 2.0 / kPeriod, 2);
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int i = 0; i < 20; ++i) shift = weight * sum.inverse() * noise.momentOf(strut - shift, {of_body, 0.0});
  for (int i = 0; i < kNumStrutParameters; ++i) {
    EXPECT_NEAR(squareDifference(with_input[i], plain[i]), input[i] * input[i], 1e-9 * input[i] * input[i]);
    EXPECT_NEAR(squareDifference(with_stamps[i], with_input[i]), shift[i] * shift[i] / 3.0, 1e-6 * shift[i] * shift[i]);
  }
}

// What rows that were made with a skew of 2 ms too much shift, by hand: of (R^-1 m)_i, m = sum x phi.
struct SkewedRows {
  static constexpr double kTooMuch = 2e-3;

  explicit SkewedRows() {
    recursive.forgetting_factor = kForgetting;
    estimators.emplace(SensorColumns::kNone, recursive, LeastAbsoluteOptions{});
  }

  void take(const RegressionRow& row, double skew) {
    const WheelRow wheel{0.7 * row.regressor[1], 0.4 * row.regressor[0], 0.0};
    const Eigen::Vector2d strut = estimators->leastAbsolute().parameters();
    right.addSkew(row, wheel, 0.0, estimators->leastAbsolute());
    skewed.addSkew(row, wheel, skew, estimators->leastAbsolute());
    const double x = strut[0] * wheel.output + strut[1] * wheel.damping;
    moment = kForgetting * moment + x * Eigen::Vector2d(row.regressor);
    information = kForgetting * information + row.regressor * row.regressor.transpose();
    estimators->update(row);
  }

  // Beside a clock of which nothing is known yet, so that its skew is 0, certainly.
  StrutEstimate describe(ErrorBudget& budget) {
    StrutEstimate ls, la;
    la.damping_to_mass = estimators->leastAbsolute().parameters()[kDampingToMass];
    la.stiffness_to_mass = estimators->leastAbsolute().parameters()[kStiffnessToMass];
    la.effective_rows = estimators->leastAbsolute().effectiveRows();
    budget.describe(*estimators, &clock, ls, la);
    return la;
  }

  Eigen::Array2d shift() {
    const StrutEstimate with = describe(skewed), without = describe(right);
    return {std::sqrt(squareDifference(with.damping_to_mass_stddev, without.damping_to_mass_stddev)),
            std::sqrt(squareDifference(with.stiffness_to_mass_stddev, without.stiffness_to_mass_stddev))};
  }

  RegressorNoise noise{kFilter};
  SkewProfile clock{WheelHistory(kFilter, SkewProfile::mostSkew(kFilter)), kFilter, noise, kForgetting};
  ErrorBudget right{kFilter, noise, kNumStrutParameters, kForgetting, false}, skewed = right;
  RecursiveOptions recursive;
  std::optional<PairedEstimators> estimators;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
};

TEST(ErrorBudget, RowsOfAnotherSkewAreOffByWhatItShifts) {
  SkewedRows rows;
  for (const RegressionRow& row : randomRows(vectorOf({3.0, 13.8}), 3000, 0.1, 1)) rows.take(row, SkewedRows::kTooMuch);
  const Eigen::Vector2d expected = SkewedRows::kTooMuch * rows.information.inverse() * rows.moment;
  const Eigen::Array2d found = rows.shift();
  for (int i = 0; i < kNumStrutParameters; ++i)
    EXPECT_NEAR(found[i], std::abs(expected[i]), 1e-6 * std::abs(expected[i]));
}

// Then come rows that tell of the damping only, and are right: what the stiffness is off by is still that of the rows
// that it is from, also when it is held no longer. By chance the entries of a hundred rows are correlated by a tenth,
// so that a tenth of the damping's shift, two to three times as large, comes or goes.
TEST(ErrorBudget, WhatIsKnownOfAHeldParameterStays) {
  SkewedRows rows;
  for (const RegressionRow& row : randomRows(vectorOf({3.0, 13.8}), 3000, 0.1, 1)) rows.take(row, SkewedRows::kTooMuch);
  const Eigen::Array2d before = rows.shift();
  rows.estimators->hold(false, true);
  for (const RegressionRow& row : randomRows(vectorOf({3.0, 13.8}), 3000, 0.1, 2)) rows.take(row, 0.0);
  EXPECT_TRUE(std::isnan(rows.describe(rows.skewed).stiffness_to_mass_stddev));  // not written
  rows.estimators->hold(false, false);
  const Eigen::Array2d after = rows.shift();
  EXPECT_LT(after[kDampingToMass], 0.2 * before[kDampingToMass]);
  EXPECT_NEAR(after[kStiffnessToMass], before[kStiffnessToMass], 0.3 * before[kStiffnessToMass]);
}

}  // namespace
}  // namespace suspension_health_monitor
