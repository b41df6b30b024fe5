// The best strut within bounds, from second moments of rows, against a search of the bounds.
#include "suspension_health_monitor/internal/identification/row_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

struct Row {
  double phi_1, phi_0, psi;
};

double restOf(const std::vector<Row>& rows, double b1, double b0) {
  double sum = 0.0;
  for (const Row& row : rows) sum += std::pow(row.psi - b1 * row.phi_1 - b0 * row.phi_0, 2);
  return sum;
}

// The regressors are correlated, so that clipping the free optimum would not do.
std::vector<Row> rowsOf(const Eigen::Vector2d& theta, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  std::vector<Row> rows;
  for (int k = 0; k < 20; ++k) {
    const double phi_1 = normal(engine), phi_0 = 0.7 * phi_1 + 0.3 * normal(engine);
    rows.push_back({phi_1, phi_0, theta[0] * phi_1 + theta[1] * phi_0 + 0.1 * normal(engine)});
  }
  return rows;
}

RowMoments momentsOf(const std::vector<Row>& rows) {
  RowMoments moments;
  for (const Row& row : rows) moments.add(row.phi_1, row.phi_0, row.psi);
  return moments;
}

TEST(RowMoments, BestStrutIsTheBestOfAllWithinTheBounds) {
  std::mt19937_64 engine(5);
  const Eigen::Vector2d most(2.0, 6.0);
  for (const double b1 : {-1.0, 0.5, 1.9, 5.0}) {
    for (const double b0 : {-3.0, 1.0, 5.0, 20.0}) {
      const std::vector<Row> rows = rowsOf({b1, b0}, engine);
      double best = restOf(rows, 0.0, 0.0);
      constexpr int kSteps = 400;
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j)
          best = std::min(best, restOf(rows, most[0] * i / kSteps, most[1] * j / kSteps));
      const StrutFit fit = momentsOf(rows).bestStrut(most);
      EXPECT_LE(fit.rest, best + 1e-9) << b1 << ", " << b0;
      EXPECT_NEAR(fit.rest, best, 0.02 * best + 0.01) << b1 << ", " << b0;
      EXPECT_NEAR(fit.rest, restOf(rows, fit.theta[0], fit.theta[1]), 1e-9) << b1 << ", " << b0;
      EXPECT_TRUE((fit.theta.array() >= 0.0).all() && (fit.theta.array() <= most.array()).all()) << b1 << ", " << b0;
    }
  }
}

TEST(RowMoments, SumsAreThoseOfAllRows) {
  std::mt19937_64 engine(6);
  const std::vector<Row> first = rowsOf({1.0, 2.0}, engine), second = rowsOf({1.0, 3.0}, engine);
  std::vector<Row> all = first;
  all.insert(all.end(), second.begin(), second.end());
  RowMoments sum = momentsOf(first);
  sum += momentsOf(second);
  const RowMoments expected = momentsOf(all);
  EXPECT_DOUBLE_EQ(sum.damping_information, expected.damping_information);
  EXPECT_DOUBLE_EQ(sum.stiffness_information, expected.stiffness_information);
  EXPECT_DOUBLE_EQ(sum.between, expected.between);
  EXPECT_DOUBLE_EQ(sum.damping_output, expected.damping_output);
  EXPECT_DOUBLE_EQ(sum.stiffness_output, expected.stiffness_output);
  EXPECT_DOUBLE_EQ(sum.output, expected.output);
}

TEST(RowMoments, OfNothingLeaveNothing) {
  const StrutFit fit = RowMoments().bestStrut({2.0, 6.0});
  EXPECT_EQ(fit.rest, 0.0);
  EXPECT_EQ(fit.theta, Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace suspension_health_monitor
