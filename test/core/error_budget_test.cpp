#include "suspension_health_monitor/internal/monitor/error_budget.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

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
    budget.addSample({Stamp{}, body, 0.0});
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

}  // namespace
}  // namespace suspension_health_monitor
