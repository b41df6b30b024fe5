// Whether rows tell of either parameter, by rows of noise.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/identification/excitation.h"

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 3.0, kB0 = 13.8;

// Rows of white noise with given standard deviations of the regressors and of what the model leaves.
class NoiseRows {
 public:
  explicit NoiseRows(double unit = 1.0) : unit_(unit) {}

  /// @return the row psi = phi' theta + error. Every second phi_0 is the one before, turned over: it has no mean.
  RegressionRow next(double damping, double stiffness, double error) {
    RegressionRow row;
    phi_0_ = turns_ ? -phi_0_ : normal_(engine_);
    turns_ = !turns_;
    row.regressor = Eigen::Vector2d(unit_ * damping * normal_(engine_), unit_ * stiffness * phi_0_);
    row.output = row.regressor.dot(theta) + unit_ * error * normal_(engine_);
    return row;
  }

  const Eigen::VectorXd theta = Eigen::Vector2d(kB1, kB0);

 private:
  double unit_, phi_0_ = 0.0;
  bool turns_ = false;
  std::mt19937_64 engine_{3};
  std::normal_distribution<double> normal_;
};

constexpr int kRowsOfTenBlocks = 640;

/// What is judged of noise rows, from a drive on that is worth being held.
struct Judged {
  explicit Judged(bool knows = true, double unit = 1.0) : rows(unit) {
    if (knows) excitation.know({kB1, kB0});
    add(1.0, 1.0, 0.5);
  }

  void add(const RegressionRow& row) { excitation.add(row, row.output, row.output); }

  void add(double damping, double stiffness, double error) {
    for (int k = 0; k < kRowsOfTenBlocks; ++k) add(rows.next(damping, stiffness, error));
  }

  std::pair<bool, bool> excited() const {
    return {excitation.excited(kDampingToMass), excitation.excited(kStiffnessToMass)};
  }

  NoiseRows rows;
  Excitation excitation{30, 0.99, RegressorNoise({30, 0.02, IntegrationRule::kBandLimited})};
};

// Drive, then a tenth of a thousandth of its information.
TEST(Excitation, OfEachParameterIsJudgedByItsOwnRegressor) {
  const std::pair both(true, true);
  for (const double unit : {1.0, 1e-6, 1e6}) {
    Judged judged(true, unit);
    EXPECT_EQ(judged.excited(), both) << unit;
    judged.add(0.01, 1.0, 0.5);
    EXPECT_EQ(judged.excited(), std::pair(false, true)) << unit;
    judged.add(1.0, 0.01, 0.5);
    EXPECT_EQ(judged.excited(), std::pair(true, false)) << unit;
    judged.add(0.01, 0.01, 0.5);
    EXPECT_EQ(judged.excited(), std::pair(false, false)) << unit;
    judged.add(1.0, 1.0, 0.5);
    EXPECT_EQ(judged.excited(), both) << unit;
  }
}

TEST(Excitation, ASmootherRoadThatIsClearOfTheNoiseGoesOnCounting) {
  Judged judged;
  judged.add(0.01, 0.01, 0.003);
  EXPECT_EQ(judged.excited(), std::pair(true, true));
}

TEST(Excitation, ARoughRoadThatTheModelDoesNotExplainGoesOnCounting) {
  Judged judged;
  judged.add(1.0, 1.0, 1000.0);
  EXPECT_EQ(judged.excited(), std::pair(true, true));
}

// A spike is no road: what comes after it is measured by what was before.
TEST(Excitation, AnOutlierDoesNotMakeTheDriveLookParked) {
  Judged judged;
  judged.add(judged.rows.next(1e9, 1e9, 0.5));
  judged.add(1.0, 1.0, 100.0);  // thrown off
  EXPECT_EQ(judged.excited(), std::pair(true, true));
}

// What the filter makes of white noise of both sensors, by its responses to an impulse of either.
class FilteredNoise {
 public:
  explicit FilteredNoise(const IntegralFilterOptions& options) {
    for (const bool of_body : {true, false}) {
      SuspensionRegression regression(options);
      std::vector<Eigen::Vector3d> response;
      for (int k = 0; k < kSamples; ++k) {
        const double impulse = k == kSamples / 2 ? 1.0 : 0.0;
        const RegressionRow* row = regression.push({Stamp{}, of_body ? impulse : 0.0, of_body ? 0.0 : impulse});
        if (row != nullptr) response.push_back({row->regressor[0], row->regressor[1], row->output});
      }
      responses_.push_back(response);
    }
  }

  /// @param i  0: phi_1, 1: phi_0, 2: psi.
  /// @return autocorrelation of it so many rows apart.
  double correlation(int i, int rows) const { return covariance(i, rows) / covariance(i, 0); }

  /// @return standard deviation of a mean of squares of this many rows, relative.
  double deviation(int i, int rows) const {
    double squares = 1.0;
    for (int apart = 1; apart < kFar; ++apart) squares += 2.0 * std::pow(correlation(i, apart), 2);
    return std::sqrt(2.0 * squares / rows);
  }

  /// @return share of the variance that is left when the running mean with this factor a row is subtracted.
  double withoutMean(int i, double factor) const {
    double sum = 0.0;  // of the correlations with what the mean remembers
    for (int apart = 1; apart < kFar; ++apart) sum += std::pow(factor, apart) * correlation(i, apart);
    return 1.0 - 2.0 * (1.0 - factor) * (1.0 + sum) + (1.0 - factor) / (1.0 + factor) * (1.0 + 2.0 * sum);
  }

 private:
  static constexpr int kSamples = 400, kFar = 128;  // rows further apart have nothing in common

  double covariance(int i, int rows) const {
    double sum = 0.0;
    const auto apart = static_cast<std::size_t>(rows);
    for (const auto& response : responses_)
      for (std::size_t k = 0; k + apart < response.size(); ++k) sum += response[k][i] * response[k + apart][i];
    return sum;
  }

  std::vector<std::vector<Eigen::Vector3d>> responses_;
};

// Two sensors of equal noise, through the filter itself, in blocks long enough for chance to be small. Of phi_0 the
// mean of 400 rows is left out. The bounds are four standard deviations of the ratio of two mean squares.
TEST(Excitation, OfWhiteNoiseIsOne) {
  const IntegralFilterOptions options{30, 0.02, IntegrationRule::kBandLimited};
  constexpr int kBlock = 6400, kBlocks = 100, kRows = kBlock * kBlocks;
  const FilteredNoise filtered(options);
  for (const double unit : {1.0, 1e-5}) {
    SuspensionRegression regression(options);
    Excitation excitation(kBlock, 0.99, RegressorNoise(options));
    excitation.know({kB1, kB0});
    std::mt19937_64 engine(4);
    std::normal_distribution<double> noise(0.0, unit);
    double damping = 0.0, stiffness = 0.0;
    for (int k = 0; k < kBlock * kBlocks; ++k) {
      const RegressionRow* row = regression.push({Stamp{}, noise(engine), noise(engine)});
      if (row == nullptr || !excitation.add(*row, row->output, 0.0)) continue;
      damping += excitation.excitation(kDampingToMass) / kBlocks;
      stiffness += excitation.excitation(kStiffnessToMass) / kBlocks;
    }
    const double of_psi = filtered.deviation(2, kRows);
    EXPECT_NEAR(damping, 1.0, 4.0 * std::hypot(filtered.deviation(0, kRows), of_psi)) << unit;
    EXPECT_NEAR(stiffness, filtered.withoutMean(1, 0.9975), 4.0 * std::hypot(filtered.deviation(1, kRows), of_psi))
        << unit;
  }
}

TEST(Excitation, BeforeThereIsAnythingToHoldEverythingCounts) {
  Judged judged(false);
  judged.add(1e-6, 1e-6, 0.5);
  EXPECT_EQ(judged.excited(), std::pair(true, true));
}

// The constant is what two sensors of different offset leave in the twice integrated difference.
TEST(Excitation, AConstantOfTheStiffnessRegressorIsNone) {
  Judged judged;
  for (int k = 0; k < 5 * kRowsOfTenBlocks; ++k) {
    RegressionRow row = judged.rows.next(0.001, 0.001, 0.5);
    row.regressor[kStiffnessToMass] += 5.0;
    judged.add(row);
  }
  EXPECT_EQ(judged.excited(), std::pair(false, false));
}

}  // namespace
}  // namespace suspension_health_monitor
