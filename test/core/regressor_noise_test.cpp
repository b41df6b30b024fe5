#include "suspension_health_monitor/internal/identification/regressor_noise.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

IntegralFilterOptions filterOptions() {
  IntegralFilterOptions options;
  options.period = 0.01;
  options.horizon_samples = 30;
  return options;
}

const Eigen::Vector2d kStrut(4.0, 60.0);  // b1 [1/s], b0 [1/s^2]
constexpr std::size_t kSamples = 1 << 16;

/// Noise whose samples in body and wheel are these combinations of two independent white series.
std::vector<CornerSample> noiseOf(double own, double shared) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::vector<CornerSample> noise(kSamples);
  for (CornerSample& sample : noise) {
    const double common = shared * normal(engine);
    sample.sprung_acceleration = own * normal(engine) + common;
    sample.unsprung_acceleration = own * normal(engine) + common;
  }
  return noise;
}

// Of 65536 rows some 1000 are independent of each other, 60 being alike: squares are known to sqrt(2 / 1000).
constexpr double kSquaresKnown = 4.0 * 0.045;

TEST(RegressorNoise, OfAWhiteSeriesIsThatOfTwoSensors) {
  const IntegralFilterOptions options = filterOptions();
  const RegressorNoise closed(options), measured(options, noiseOf(1.0, 0.0));
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(measured.regressorGain(i) / closed.regressorGain(i), 1.0, kSquaresKnown) << i;
  EXPECT_NEAR(measured.residualGain(kStrut) / closed.residualGain(kStrut), 1.0, kSquaresKnown);
  EXPECT_NEAR(measured.changeGain(kStrut) / closed.changeGain(kStrut), 1.0, kSquaresKnown);
  EXPECT_NEAR(measured.meanGain(kStrut) / closed.meanGain(kStrut), 1.0, kSquaresKnown);
  const Eigen::Vector2d expected = closed.moment(kStrut, 0.09), got = measured.moment(kStrut, 0.09);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(got[i] / expected[i], 1.0, kSquaresKnown) << i;
}

// The residual of psi - b1 phi_1 - b0 phi_0 has the variance v' C v, v = (1, -b1, -b0).
TEST(RegressorNoise, CovarianceIsThatOfPsiAndBothRegressors) {
  const RegressorNoise noise(filterOptions());
  for (const Eigen::Vector2d& strut : {kStrut, Eigen::Vector2d(-3.0, 20.0), Eigen::Vector2d(0.0, 0.0)}) {
    const Eigen::Vector3d v(1.0, -strut[0], -strut[1]);
    EXPECT_NEAR(v.dot(noise.covariance() * v) / noise.residualGain(strut), 1.0, 1e-12);
  }
  for (int i = 0; i < 2; ++i) EXPECT_DOUBLE_EQ(noise.covariance()(1 + i, 1 + i), noise.regressorGain(i));
  EXPECT_TRUE(noise.covariance().isApprox(noise.covariance().transpose()));
}

// What both sensors have in common is no travel: it is in psi alone, and pulls nothing.
TEST(RegressorNoise, ThatBothSensorsShareIsInTheOutputAlone) {
  const IntegralFilterOptions options = filterOptions();
  const RegressorNoise shared(options, noiseOf(0.0, 1.0));
  const double rounding = 1e-20;
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT(shared.regressorGain(i), rounding);
    EXPECT_NEAR(shared.moment(kStrut, 1.0)[i], 0.0, 1e-10);
  }
  // The output of a strut that does nothing is that of the body's sensor alone.
  const double of_body = RegressorNoise(options).residualGain(Eigen::Vector2d::Zero());
  EXPECT_NEAR(shared.residualGain(kStrut) / of_body, 1.0, kSquaresKnown);
}

TEST(RegressorNoise, OfTooShortASeriesIsThatOfTwoSensors) {
  const IntegralFilterOptions options = filterOptions();
  EXPECT_EQ(RegressorNoise(options, {}).residualGain(kStrut), RegressorNoise(options).residualGain(kStrut));
  EXPECT_EQ(RegressorNoise(options, std::vector<CornerSample>(100)).residualGain(kStrut),
            RegressorNoise(options).residualGain(kStrut));
}

}  // namespace
}  // namespace suspension_health_monitor
