// The trend of a parameter: a straight line of discounted least squares, against sums over all values.
#include "suspension_health_monitor/internal/health/parameter_trend.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

// A value that lags a ramp by the lag: the trend is the ramp itself, once it has seen it for some memories.
TEST(ParameterTrend, FollowsARampWithoutLag) {
  constexpr double kLag = 20.0, kSlope = 0.001;
  ParameterTrend trend(20.0, kLag);
  EXPECT_FALSE(trend.now());
  for (int k = 0; k < 400; ++k) trend.follow(3.0 + kSlope * (k - kLag), 1e-8);
  EXPECT_NEAR(trend.now()->value, 3.0 + kSlope * 399, 1e-4);
  const double stddev = trend.now()->stddev;
  for (int k = 400; k < 450; ++k) trend.pass();
  EXPECT_NEAR(trend.now()->value, 3.0 + kSlope * 449, 1e-4);
  EXPECT_GT(trend.now()->stddev, 3.0 * stddev);  // carried on for 50 steps, and e^-2.5 of the weight left
}

TEST(ParameterTrend, DoesNotOvershootAStep) {
  ParameterTrend trend(20.0, 20.0);
  for (int k = 0; k < 200; ++k) trend.follow(3.0, 1e-4);
  for (int k = 0; k < 200; ++k) {
    trend.follow(2.0, 1e-4);
    ASSERT_NEAR(trend.now()->value, 2.0, 1e-9);
  }
}

TEST(ParameterTrend, PoorValuesHardlyCount) {
  ParameterTrend trend(20.0, 20.0);
  for (int k = 0; k < 200; ++k) trend.follow(3.0, 1e-4);
  for (int k = 0; k < 10; ++k) trend.follow(1.0, 1.0);
  EXPECT_NEAR(trend.now()->value, 3.0, 0.01);
  trend.follow(std::nan(""), 1e-4);
  trend.follow(1.0, std::nan(""));
  EXPECT_NEAR(trend.now()->value, 3.0, 0.01);
}

// Errors as those of a forgetting estimator: e <- e exp(-1 / lag) + white noise. The values are one lag old, which a
// parameter that stays does not show. 4000 lags hold about 1000 independent values, which know a variance to 5 %.
TEST(ParameterTrend, KnowsItsStandardDeviation) {
  constexpr double kStddev = 0.03;
  for (const double lag : {10.0, 40.0}) {
    const double memory = 2.0 * lag, kept = std::exp(-1.0 / lag);
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0.0, kStddev * std::sqrt(1.0 - kept * kept));
    ParameterTrend trend(memory, lag);
    double error = 0.0, squares = 0.0, said = 0.0;
    const int steps = static_cast<int>(4000 * lag);
    for (int k = 0; k < steps; ++k) {
      error = kept * error + noise(random);
      trend.follow(3.0 + error, kStddev * kStddev);
      squares += std::pow(trend.now()->value - 3.0, 2) / steps;
      said += std::pow(trend.now()->stddev, 2) / steps;
    }
    EXPECT_NEAR(std::sqrt(squares / said), 1.0, 0.1) << lag;
  }
}

// The sums of the line over all values, with what is left of each, so that nothing is recursive.
class Values {
 public:
  explicit Values(double memory) : memory_(memory) {}

  void setMemory(double memory) { memory_ = memory; }

  void follow(double value, double variance) {
    pass();
    all_.push_back({0.0, 1.0 / variance, value});
  }

  void pass() {
    for (Value& one : all_) one = {one.age + 1.0, one.weight * (1.0 - 1.0 / memory_), one.value};
  }

  /// @return sum of weight age^power.
  double sum(int power) const {
    double sum = 0.0;
    for (const Value& one : all_) sum += one.weight * std::pow(one.age, power);
    return sum;
  }

  /// @return (level, slope) of the line at the newest step, without what is known of the slope beforehand.
  Eigen::Vector2d line() const {
    Eigen::Vector2d right(0.0, 0.0);
    for (const Value& one : all_) right += one.weight * one.value * Eigen::Vector2d(1.0, -one.age);
    return normal().inverse() * right;
  }

  /// @return variance of the line so many steps ahead, for uncorrelated values.
  double varianceAhead(double steps) const {
    const Eigen::Vector2d ahead(1.0, steps);
    return ahead.dot(normal().inverse() * ahead);
  }

  /// @return covariance of two lines carried on by so many steps, `apart` steps apart, over the variance of a value:
  /// errors have the correlation exp(-steps / lag), and all values are as good.
  double covarianceAhead(double steps, double lag, double apart = 0.0) const {
    std::vector<double> shares;
    const Eigen::Vector2d ahead = normal().inverse() * Eigen::Vector2d(1.0, steps);
    for (const Value& one : all_) shares.push_back(one.weight * (ahead[0] - ahead[1] * one.age));
    double sum = 0.0;
    for (std::size_t i = 0; i < all_.size(); ++i)
      for (std::size_t j = 0; j < all_.size(); ++j)
        sum += shares[i] * shares[j] * std::exp(-std::abs(all_[i].age - all_[j].age + apart) / lag);
    return sum;
  }

 private:
  struct Value {
    double age, weight, value;
  };

  Eigen::Matrix2d normal() const { return (Eigen::Matrix2d() << sum(0), -sum(1), -sum(1), sum(2)).finished(); }

  double memory_;
  std::vector<Value> all_;
};

constexpr double kMemory = 12.0, kLag = 10.0;
constexpr double kVariance = 1e-10;  // so small that what is known of the slope beforehand counts for nothing

// What correlation makes of the variance, by a trend that has seen nothing but good values.
double correlatedOver(double memory, double lag) {
  ParameterTrend trend(memory, lag);
  Values values(memory);
  for (int k = 0; k < 50; ++k) {
    trend.follow(3.0, kVariance);
    values.follow(3.0, kVariance);
  }
  return std::pow(trend.now()->stddev, 2) / values.varianceAhead(lag);
}

void expectSame(const ParameterTrend& trend, const Values& values, double lag, double correlated) {
  const Eigen::Vector2d line = values.line();
  EXPECT_NEAR(trend.now()->value, line[0] + lag * line[1], 1e-9);
  EXPECT_NEAR(std::pow(trend.now()->stddev, 2) / (correlated * values.varianceAhead(lag)), 1.0, 1e-5);
}

// Sums of a geometric series: weight m, age m (m - 1), age^2 m (m - 1) (2 m - 1), so that the variance t steps ahead is
// [2 m - 1 + 2 t + t^2 / (m - 1)] / m^2 of that of a value, and of p steps later (m / (m - 1))^p times that of t + p.
TEST(ParameterTrend, OfAStraightLineIsTheClosedFormAlsoAfterStepsWithoutAValue) {
  constexpr double kSlope = 1e-3;
  const auto share = [](double t) {
    return (2.0 * kMemory - 1.0 + 2.0 * t + t * t / (kMemory - 1.0)) / (kMemory * kMemory);
  };
  const double correlated = correlatedOver(kMemory, kLag);
  ParameterTrend trend(kMemory, kLag);
  for (int k = -600; k <= 0; ++k) trend.follow(3.0 + kSlope * (k - kLag), kVariance);
  for (int passed = 0; passed <= 20; ++passed) {
    EXPECT_NEAR(trend.now()->value, 3.0 + kSlope * passed, 1e-7) << passed;
    const double grown = std::pow(kMemory / (kMemory - 1.0), passed);
    EXPECT_NEAR(std::pow(trend.now()->stddev, 2) / (correlated * kVariance * grown * share(kLag + passed)), 1.0, 1e-5)
        << passed;
    trend.pass();
  }
}

// By the double sum over all pairs of values. The trend takes it for an integral: half a step of the lag apart.
TEST(ParameterTrend, StandardDeviationIsThatOfCorrelatedValues) {
  for (const double lag : {20.0, 40.0})
    for (const double memories : {0.5, 1.5, 3.0}) {
      ParameterTrend trend(memories * lag, lag);
      Values values(memories * lag);
      for (int k = 0; k < 12 * memories * lag; ++k) {
        trend.follow(3.0, kVariance);
        values.follow(3.0, kVariance);
      }
      const double ratio = std::pow(trend.now()->stddev, 2) / (kVariance * values.covarianceAhead(lag, lag));
      EXPECT_NEAR(ratio, 1.0, 0.5 / lag) << lag << ' ' << memories;
    }
}

// By the sum of covariances. Their integrals differ from sums as above.
TEST(ParameterTrend, VarianceOfMeansIsThatOfTheLinesCorrelations) {
  constexpr double kFarLag = 40.0, kSteps = 30.0;
  for (const double memory : {30.0, 60.0}) {
    Values values(memory);
    for (int k = 0; k < 12 * memory; ++k) values.follow(3.0, kVariance);
    double sum = 0.0;
    for (double apart = kSteps; apart < 12.0 * memory; apart += kSteps)
      sum += values.covarianceAhead(kFarLag, kFarLag, apart);
    const double expected = 1.0 + 2.0 * sum / values.covarianceAhead(kFarLag, kFarLag);
    EXPECT_NEAR(ParameterTrend::varianceOfMeans(memory, kFarLag, kSteps) / expected, 1.0, 0.5 / kFarLag) << memory;
  }
}

TEST(ParameterTrend, OfAParameterThatStaysKeepsItsValueWhileItPasses) {
  ParameterTrend trend(kMemory, kLag);
  trend.pass();
  EXPECT_FALSE(trend.now());
  for (int k = 0; k < 30; ++k) trend.follow(-3.0, 1e-2);
  double stddev = trend.now()->stddev;
  for (int k = 0; k < 100; ++k) {
    trend.pass();
    ASSERT_NEAR(trend.now()->value, -3.0, 1e-9) << k;
    ASSERT_GT(trend.now()->stddev, stddev) << k;
    stddev = trend.now()->stddev;
  }
}

TEST(ParameterTrend, AValueThatTellsNothingIsAStepWithoutAValue) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const UncertainValue& nothing : {UncertainValue{std::nan(""), 1e-4},
                                        {kInfinite, 1e-4},
                                        {2.0, 0.0},
                                        {2.0, -1e-4},
                                        {2.0, std::nan("")},
                                        {2.0, kInfinite}}) {
    ParameterTrend told(kMemory, kLag), passed(kMemory, kLag);
    for (int k = 0; k < 30; ++k) {
      told.follow(3.0 + 1e-3 * k, 1e-4);
      passed.follow(3.0 + 1e-3 * k, 1e-4);
    }
    told.follow(nothing.value, nothing.stddev);
    passed.pass();
    EXPECT_EQ(told.now()->value, passed.now()->value);
    EXPECT_EQ(told.now()->stddev, passed.now()->stddev);
  }
}

// Of values that know next to nothing: the mean of them, m - 1 steps old, and from there on the slope beforehand.
TEST(ParameterTrend, OfPoorValuesHasTheSlopeThatIsKnownBeforehand) {
  constexpr double kPoor = 1e5, kSlope = 0.1 * 3.0 / kMemory;  // a tenth of the parameter per memory
  ParameterTrend trend(kMemory, kLag);
  for (int k = 0; k < 600; ++k) trend.follow(3.0, kPoor);
  EXPECT_NEAR(trend.now()->value, 3.0, 1e-9);
  const double of_level = correlatedOver(kMemory, kLag) * kPoor / kMemory;
  const double of_slope = std::pow(kSlope * (kMemory - 1.0 + kLag), 2);
  EXPECT_NEAR(std::pow(trend.now()->stddev, 2) - of_level, of_slope, 0.01 * of_slope);
}

// Not on a line, of unequal variance, over steps without a value and two changes of the memory.
TEST(ParameterTrend, WhatWasTakenInKeepsItsWeightWhenTheMemoryChanges) {
  ParameterTrend trend(kMemory, kLag);
  Values values(kMemory);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(1.0, 4.0);
  const auto drive = [&](int steps, double lag, double correlated) {
    for (int k = 0; k < steps; ++k) {
      const double variance = kVariance * uniform(random), value = 3.0 + 1e-5 * uniform(random);
      if (k % 5 == 0) {
        trend.pass();
        values.pass();
      } else {
        trend.follow(value, variance);
        values.follow(value, variance);
      }
    }
    expectSame(trend, values, lag, correlated);
  };
  drive(12, kLag, correlatedOver(kMemory, kLag));
  trend.setMemory(5.0, 4.0);
  values.setMemory(5.0);
  drive(3, 4.0, correlatedOver(5.0, 4.0));
  trend.setMemory(30.0, 7.0);
  values.setMemory(30.0);
  drive(1, 7.0, correlatedOver(30.0, 7.0));
  drive(50, 7.0, correlatedOver(30.0, 7.0));
}

TEST(ParameterTrend, TheMemoryThatItHasChangesNothing) {
  ParameterTrend trend(kMemory, kLag), same(kMemory, kLag);
  for (int k = 0; k < 40; ++k) {
    trend.follow(3.0 + 1e-3 * k, 1e-4);
    same.setMemory(kMemory, kLag);
    same.follow(3.0 + 1e-3 * k, 1e-4);
  }
  EXPECT_EQ(trend.now()->value, same.now()->value);
  EXPECT_EQ(trend.now()->stddev, same.now()->stddev);
}

// Memory and lag are the same where L (1 - lambda) is 9, as with 300 samples and 0.97.
TEST(ParameterTrend, MeansVaryAlikeWhereMemoryAndLagMeet) {
  const auto variance = [](double memory) { return ParameterTrend::varianceOfMeans(memory, 2.0, 3.0); };
  const double beside = (variance(1.9) + variance(2.1)) / 2.0;
  for (const double off : {0.0, 4e-16, -4e-16, 1e-12, 1e-6, -1e-4, 1e-2})
    EXPECT_NEAR(variance(2.0 + off), beside, 0.01 * beside) << off;
}

}  // namespace
}  // namespace suspension_health_monitor
