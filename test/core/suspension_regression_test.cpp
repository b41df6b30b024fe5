#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "paper_drive.h"
#include "reference/batch_estimators.h"
#include "reference/general_regression.h"
#include "suspension_health_monitor/internal/identification/regression.h"

namespace suspension_health_monitor {
namespace {

constexpr IntegralFilterOptions kFilter{30, 0.02, IntegrationRule::kBandLimited};
const double kLate = 2 * HorizonIntegral::lateness(kFilter.rule) * kFilter.period;  // of a row [s]

TEST(SuspensionRegression, GivesItsFirstRowWhenTheFilterIsFullAndAgainAfterReset) {
  SuspensionRegression regression(kFilter);
  for (const int round : {0, 1}) {
    for (int k = 1; k < LinearIntegralFilter::window(2, kFilter); ++k)
      EXPECT_EQ(regression.push({Stamp{}, 1.0, 2.0}), nullptr) << "round " << round;
    EXPECT_NE(regression.push({Stamp{}, 1.0, 2.0}), nullptr);
    regression.reset();
  }
}

// y = a sin(omega t), u = w'' - y = c cos(omega t):
//   psi = second difference of y, phi = [difference of the integral of u, double integral of u], all in closed form.
TEST(SuspensionRegression, EqualsTheIntegralsOfASineInClosedForm) {
  const double omega = 2.5, a = 0.7, c = -1.3, h = 0.6;
  const auto y = [&](double t) { return a * std::sin(omega * t); };
  const auto u = [&](double t) { return c * std::cos(omega * t); };
  const auto first_integral = [&](double t) { return c / omega * std::sin(omega * t); };
  const auto second_integral = [&](double t) { return -c / (omega * omega) * std::cos(omega * t); };
  const auto secondDifference = [&](const auto& f, double t) { return f(t) - 2.0 * f(t - h) + f(t - 2.0 * h); };
  SuspensionRegression regression(kFilter);
  for (int k = 0; k < 200; ++k) {
    const double t = k * 0.02;
    const RegressionRow* row = regression.push({fromSeconds(t), y(t), y(t) + u(t)});
    if (row == nullptr) continue;
    EXPECT_NEAR(row->output, secondDifference(y, t - kLate), 1e-13);
    EXPECT_NEAR(row->regressor[kDampingToMass], secondDifference(first_integral, t - kLate), 1e-5);
    EXPECT_NEAR(row->regressor[kStiffnessToMass], secondDifference(second_integral, t - kLate), 1e-5);
  }
}

TEST(SuspensionRegression, RowsOfANoiseFreeDriveObeyEquation28) {
  for (const RegressionRow& row : strutRows(healthyPaperDrive(20.0, 0.0), kFilter))
    EXPECT_NEAR(row.output, kPaperB1 * row.regressor[kDampingToMass] + kPaperB0 * row.regressor[kStiffnessToMass],
                1e-4);
}

TEST(SuspensionRegression, DoesNotSeeGravityCommonToBothSensorsNorAnOffsetOfTheBodysSensorInPsi) {
  const std::vector<CornerSample> drive = healthyPaperDrive(5.0, 0.024);
  std::vector<CornerSample> with_gravity = drive, with_offset = drive;
  for (CornerSample& sample : with_gravity) {
    sample.sprung_acceleration += 9.81;
    sample.unsprung_acceleration += 9.81;
  }
  for (CornerSample& sample : with_offset) sample.sprung_acceleration += 0.5;
  const auto rows = strutRows(drive, kFilter);
  const auto gravity_rows = strutRows(with_gravity, kFilter);
  const auto offset_rows = strutRows(with_offset, kFilter);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_NEAR(gravity_rows[k].output, rows[k].output, 1e-13);
    EXPECT_NEAR((gravity_rows[k].regressor - rows[k].regressor).norm(), 0.0, 1e-13);
    EXPECT_NEAR(offset_rows[k].output, rows[k].output, 1e-13);
    EXPECT_NEAR(offset_rows[k].regressor[kDampingToMass], rows[k].regressor[kDampingToMass], 1e-13);
    EXPECT_NEAR(offset_rows[k].regressor[kStiffnessToMass], rows[k].regressor[kStiffnessToMass] - 0.5 * 0.6 * 0.6,
                1e-13);
  }
}

// A reading of the wheel that drifts by `step` in a row: the offset of the newest reading, less the step's part.
TEST(SuspensionRegression, AnOffsetThatDriftsIsItsTwoColumns) {
  constexpr double kOffset = 0.4, kStep = 1e-3, kB0 = 50.0;
  SuspensionRegression regression(kFilter, 0, true);
  for (int k = 0; k < 100; ++k) {
    const double offset = kOffset + k * kStep;
    const RegressionRow* row = regression.push({Stamp{}, 0.0, offset});
    if (row == nullptr) continue;
    const double taken_out = row->regressor[2] * -kB0 * offset + row->regressor[3] * -kB0 * kStep;
    EXPECT_NEAR(kB0 * row->regressor[kStiffnessToMass] + taken_out, 0.0, 1e-12);
  }
}

// The strut as a case of (7): y'' = -b1 y' - b0 y + b1 w''' + b0 w'', so that the rows of the two classes agree:
// -I_r^2 y + I_r^2 w'' = I_r^2 u.
TEST(SuspensionRegression, IsTheGeneralRegressionWithInputAndOutputTakenTogether) {
  GeneralRegression general(2, kFilter);
  SuspensionRegression strut(kFilter);
  for (const CornerSample& sample : healthyPaperDrive(5.0, 0.024)) {
    const RegressionRow* expected = general.push(sample.unsprung_acceleration, sample.sprung_acceleration);
    const RegressionRow* row = strut.push(sample);
    ASSERT_EQ(row == nullptr, expected == nullptr);
    if (row == nullptr) continue;
    EXPECT_NEAR(row->output, expected->output, 1e-13);
    for (const int i : {0, 1})
      EXPECT_NEAR(row->regressor[i], expected->regressor[i] + expected->regressor[2 + i], 1e-13);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
