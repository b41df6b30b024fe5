#include "reference/general_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "paper_drive.h"
#include "random_rows.h"
#include "reference/batch_estimators.h"

namespace suspension_health_monitor {
namespace {

using Complex = std::complex<double>;

// y''' = -a2 y'' - a1 y' - a0 y + b2 u'' + b1 u' + b0 u with poles -1 and -0.5 +- 2 i.
constexpr double kA2 = 2.0, kA1 = 5.25, kA0 = 4.25, kB2 = 0.8, kB1 = -1.5, kB0 = 3.0;
constexpr double kFrequencies[] = {0.4, 1.0, 1.9, 3.1, 4.7};  // [rad/s], as many as a row needs to be rich enough

Complex transfer(Complex s) { return (kB2 * s * s + kB1 * s + kB0) / (s * s * s + kA2 * s * s + kA1 * s + kA0); }

double input(double t) {
  double sum = 0.0;
  for (const double omega : kFrequencies) sum += std::cos(omega * t);
  return sum;
}

// Forced and free response in closed form: no integrator, no initial state known to the regression.
double output(double t) {
  double sum = 2.0 * std::exp(-t) + std::exp(-0.5 * t) * std::cos(2.0 * t + 0.3);
  for (const double omega : kFrequencies)
    sum += (transfer(Complex(0.0, omega)) * std::exp(Complex(0.0, omega * t))).real();
  return sum;
}

std::vector<RegressionRow> rowsOf(GeneralRegression& regression, double period, double duration) {
  std::vector<RegressionRow> rows;
  for (int k = 0; k * period < duration; ++k)
    if (const RegressionRow* row = regression.push(input(k * period), output(k * period))) rows.push_back(*row);
  return rows;
}

TEST(GeneralRegression, RecoversAThirdOrderModelWithItsInitialConditionsUnknown) {
  GeneralRegression regression(3, {40, 0.02, IntegrationRule::kBandLimited});
  const auto theta = batchLeastSquares(stack(rowsOf(regression, 0.02, 60.0)));
  ASSERT_TRUE(theta.has_value());
  EXPECT_LT((*theta - vectorOf({kA2, kA1, kA0, kB2, kB1, kB0})).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(GeneralRegression, GivesItsFirstRowAtSampleOrderTimesLAndAgainAfterReset) {
  GeneralRegression regression(3, {7, 0.02, IntegrationRule::kTrapezoid});
  for (const int round : {0, 1}) {
    EXPECT_EQ(rowsOf(regression, 1.0, 21.0).size(), 0u) << "round " << round;
    EXPECT_EQ(rowsOf(regression, 1.0, 1.0).size(), 1u);
    regression.reset();
  }
}

// dy/dt = -2 y + 5 u with u = 1 from rest: y = 2.5 (1 - exp(-2 t)), psi = y(t) - y(t - h) = -2 int y + 5 int u.
TEST(GeneralRegression, OrdersAndSignsTheColumnsAsInEquation11) {
  GeneralRegression regression(1, {50, 0.01, IntegrationRule::kBandLimited});
  const auto y = [](double t) { return 2.5 * (1.0 - std::exp(-2.0 * t)); };
  const RegressionRow* row = nullptr;
  const int late = HorizonIntegral::lateness(IntegrationRule::kBandLimited);
  for (int k = -late; k <= 50 + late; ++k) row = regression.push(1.0, y(k * 0.01));
  ASSERT_NE(row, nullptr);
  EXPECT_NEAR(row->output, y(0.5), 1e-14);
  EXPECT_NEAR(row->regressor[1], 0.5, 1e-14);
  EXPECT_NEAR(row->regressor[0], -(2.5 * 0.5 - y(0.5) / 2.0), 1e-8);
}

}  // namespace
}  // namespace suspension_health_monitor
