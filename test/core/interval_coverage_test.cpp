#include "interval_coverage.h"

#include <gtest/gtest.h>

#include "suspension_health_monitor/internal/identification/regressor_noise.h"
#include "suspension_health_monitor/internal/identification/score_covariance.h"

namespace suspension_health_monitor {
namespace {

// Two vehicles, three horizons, twelve measurements each. Intervals three memories of LS apart, one memory of LA's, are
// taken as half as many independent ones: 95 % of n/2 has a standard deviation of 0.6 % here; 92 % and 98 % are the
// claim.
TEST(IntervalCoverage, OfEstimatesAndTheirStandardDeviationsIs95Percent) {
  Coverages all;
  for (const char* vehicle : {"rover", "paper"}) {
    SimulationOptions simulation;
    simulation.scenario = "iso_road";
    simulation.vehicle = vehicle;
    simulation.rate = vehicle == std::string("rover") ? 200.0 : 100.0;
    simulation.duration = 120.0;
    const CleanDrive drive = cleanDrive(simulation);
    const int proposed = proposedHorizon(drive, 0.03);
    for (const double horizon : {0.6, 1.0, 1.6}) {
      MonitorSettings options;
      options.integration_horizon = horizon * proposed / simulation.rate;
      all += coverageOf(drive, 0.03, options, 24);
    }
  }
  for (const auto& estimator : all)
    for (const Coverage& coverage : estimator) {
      EXPECT_GT(coverage.intervals, 2000);
      EXPECT_GT(coverage.share(), 0.92);
      EXPECT_LT(coverage.share(), 0.98);
    }
}

/// Rows with regressors and residuals that are moving sums of white noise over `window` rows.
class CorrelatedRows {
 public:
  explicit CorrelatedRows(int window) : window_(static_cast<std::size_t>(window)) {}

  RegressionRow next() {
    RegressionRow row;
    row.regressor = Eigen::VectorXd::Constant(1, sum(regressors_));
    row.output = sum(residuals_);
    return row;
  }

 private:
  double sum(std::vector<double>& newest) {
    newest.push_back(normal_(generator_));
    if (newest.size() > window_) newest.erase(newest.begin());
    double total = 0.0;
    for (const double value : newest) total += value;
    return total;
  }

  std::size_t window_;
  std::vector<double> regressors_, residuals_;
  std::mt19937 generator_{5};
  std::normal_distribution<double> normal_;
};

// phi and e are moving sums over w rows, so the autocovariance of phi e is the square of a triangle: relative to lag 0
// the sum over lags |m| < w of (1 - |m|/w)^2 is (2 w^2 + 1) / (3 w), for a memory far longer than w.
void expectSquaredTriangle(const RowWeight& weight, int wrong_in_a_thousand) {
  constexpr int kWindow = 10;
  CorrelatedRows rows(kWindow);
  ScoreCovariance scores(1, kWindow, 1.0 - 1e-4);
  const Eigen::VectorXd truth = Eigen::VectorXd::Zero(1);
  for (int k = 0; k < 400000; ++k) {
    RegressionRow row = rows.next();
    if (k % 1000 >= 1000 - wrong_in_a_thousand) row.output = 100.0 * kWindow;
    scores.add(row, truth, weight, row.output);
  }
  const double expected = (2.0 * kWindow * kWindow + 1.0) / (3.0 * kWindow);
  // 1 / (1 + lambda) of it, since an estimate that forgets rests on sum lambda^2i. Of 400 000 rows there are 25 000
  // blocks, the newest 10 000 of which count, each as large as the sum itself: 2 %.
  EXPECT_NEAR(2.0 * scores.inflation(0, 1e4), expected, 0.1 * expected);
}

TEST(ScoreCovariance, OfMovingSumsIsThatOfTheSquaredTriangle) { expectSquaredTriangle({}, 0); }

// Bursts of ten rows in a thousand that are a hundred times as large say nothing of how the others are correlated.
TEST(ScoreCovariance, RowsThatStandOutTeachNothing) {
  expectSquaredTriangle({1e-3, 1e3}, 10);  // weighted as LA's rows, but for a divisor that no residual exceeds
}

// Whatever the window.
TEST(ScoreCovariance, GoesOnLearning) {
  for (int window = 0; window <= 20; ++window) {
    CorrelatedRows rows(10);
    ScoreCovariance scores(1, window, 0.99);
    const Eigen::VectorXd truth = Eigen::VectorXd::Zero(1);
    const auto learn = [&](int num_rows) {
      for (int k = 0; k < num_rows; ++k) {
        const RegressionRow row = rows.next();
        scores.add(row, truth, {}, row.output);
      }
      return scores.inflation(0, 100.0);
    };
    const double before = learn(20000);
    EXPECT_NE(learn(20000), before) << window;
    scores.restart();
    const double anew = learn(20000);
    EXPECT_NE(learn(20000), anew) << window;
  }
}

TEST(ScoreCovariance, OfWhiteRowsIsThatOfTheTextbook) {
  CorrelatedRows rows(1);
  ScoreCovariance scores(1, 0, 0.99);
  const Eigen::VectorXd truth = Eigen::VectorXd::Zero(1);
  EXPECT_DOUBLE_EQ(scores.inflation(0, 0.0), 2.0 * 2.0 / 1.99);  // nothing known: twice that
  for (int k = 0; k < 100000; ++k) {
    const RegressionRow row = rows.next();
    scores.add(row, truth, {}, row.output);
  }
  EXPECT_NEAR(scores.inflation(0, 100.0), 1.0 / 1.99, 0.1);
  EXPECT_NEAR(scores.inflation(0, 1.0) / scores.inflation(0, 100.0), 1.99, 1e-12);  // of one row all counts
}

// A pure signal ratio: with b1 = b0 = 0 the residual is psi's noise alone, and regressors share -n_z with it.
TEST(RegressorNoise, IsTheCovarianceOfWhatTheFiltersMakeOfSensorNoise) {
  IntegralFilterOptions options;
  options.horizon_samples = 12;
  options.period = 0.01;
  const Eigen::Vector2d theta(2.0, 150.0);
  LinearIntegralFilter sprung(2, options), relative(2, options);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double variance = 0.0;
  constexpr int kCount = 400000;
  for (int k = 0; k < kCount; ++k) {
    const double z = normal(generator), w = normal(generator);
    sprung.push(z);
    relative.push(w - z);
    const Eigen::Vector2d phi(relative.output(1), relative.output(0));
    const double residual = sprung.output(2) - phi.dot(theta);
    moment += phi * residual / kCount;
    variance += residual * residual / kCount;
  }
  const Eigen::Vector2d expected =
      RegressorNoise(options).moment(theta, variance / RegressorNoise(options).residualGain(theta));
  EXPECT_NEAR(moment[0] / expected[0], 1.0, 0.05);
  EXPECT_NEAR(moment[1] / expected[1], 1.0, 0.05);
}

}  // namespace
}  // namespace suspension_health_monitor
