#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "csv.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"
#include "suspension_health_monitor/internal/identification/regression.h"

namespace suspension_health_monitor {
namespace {

// The settings of data/make_reference.py.
constexpr IntegralFilterOptions kFilter{30, 0.02, IntegrationRule::kTrapezoid};
constexpr RecursiveOptions kRecursive{0.98, 1e5,  InitialVariance::kAbsolute, 0, false, 150, SmallDivisor::kAbsolute,
                                      1e-8, false};

using Table = std::vector<std::vector<double>>;

// Columns as in the reference: time, psi, phi (2), LS (2), LA (2).
Table identify(const Table& input) {
  SuspensionRegression regression(kFilter);
  RecursiveLeastSquares ls(kNumStrutParameters, kRecursive);
  RecursiveLeastAbsolute la(kNumStrutParameters, kRecursive);
  Table result;
  for (const std::vector<double>& line : input) {
    const RegressionRow* row = regression.push({fromSeconds(line[0]), line[1], line[2]});
    if (row == nullptr) continue;
    ls.update(*row);
    la.update(*row);
    result.push_back({line[0], row->output, row->regressor[0], row->regressor[1], ls.parameters()[0],
                      ls.parameters()[1], la.parameters()[0], la.parameters()[1]});
  }
  return result;
}

double rms(const Table& table, std::size_t column) {
  double sum = 0.0;
  for (const std::vector<double>& line : table) sum += line[column] * line[column];
  return std::sqrt(sum / static_cast<double>(table.size()));
}

void expectEqual(const Table& actual, const Table& expected, std::size_t column, std::size_t first, std::size_t last,
                 double relative_tolerance) {
  for (std::size_t k = first; k < last; ++k)
    ASSERT_NEAR(actual[k][column], expected[k][column], relative_tolerance * std::abs(expected[k][column]))
        << "row " << k << ", column " << column;
}

class PaperReference : public testing::Test {
 protected:
  const Table expected_ = readCsv("reference_paper.csv");
  const Table actual_ = identify(readCsv("input_paper.csv"));
};

TEST_F(PaperReference, HasItsFirstRowAtSample2L) {
  ASSERT_EQ(actual_.size(), expected_.size());
  EXPECT_NEAR(actual_.front()[0], 60 * 0.02, 1e-12);
}

TEST_F(PaperReference, RowsEqualTheIndependentComputation) {
  for (const std::size_t column : {1, 2, 3}) {
    const double tolerance = 1e-10 * rms(expected_, column);
    for (std::size_t k = 0; k < expected_.size(); ++k)
      ASSERT_NEAR(actual_[k][column], expected_[k][column], tolerance) << "row " << k << ", column " << column;
  }
}

TEST_F(PaperReference, LeastSquaresEqualsTheIndependentComputation) {
  for (const std::size_t column : {4, 5}) expectEqual(actual_, expected_, column, 0, expected_.size(), 1e-6);
}

// After the loss of data, rows that are hit almost exactly (|epsilon| down to 5e-6 with eps_min = 1e-8) amplify
// rounding: the reference's own recursion in long double from exact rows is up to 4.1e-5 away from the reference.
TEST_F(PaperReference, LeastAbsoluteEqualsTheIndependentComputationUpToItsSensitivityToRounding) {
  const std::size_t sensitive = 1300;  // at 27.2 s, when the filters have left the loss behind
  for (const std::size_t column : {6, 7}) {
    expectEqual(actual_, expected_, column, 0, sensitive, 1e-6);
    expectEqual(actual_, expected_, column, sensitive, expected_.size(), 2e-4);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
