// What a gap leaves of the judgement of rows: what was held stays so, and no block of before it counts.
#include <gtest/gtest.h>

#include <utility>

#include "suspension_health_monitor/internal/identification/excitation.h"

namespace suspension_health_monitor {
namespace {

constexpr int kRows = 64;        // of a block
constexpr double kNoise = 0.05;  // of psi, where a drive has sqrt(199)
const std::pair kBoth(true, true), kNone(false, false), kStiffnessOnly(false, true);

// Rows whose regressors and error are orthogonal over every block, so that nothing is by chance.
class ExactBlocks {
 public:
  ExactBlocks() { excitation.know(Eigen::Vector2d(3.0, 13.8)); }

  /// @return whether the last of these rows has closed a block.
  bool add(double size, double error, int rows = kRows) {
    bool closed = false;
    for (int k = 0; k < rows; ++k) {
      RegressionRow row;
      row.regressor = Eigen::Vector2d(k & 1 ? -size : size, k & 2 ? -size : size);
      row.output = row.regressor.dot(theta) + (k & 4 ? -error : error);
      closed = excitation.add(row, row.output, row.output);
    }
    return closed;
  }

  void drive(int blocks) { add(1.0, kNoise, blocks * kRows); }
  void rest() { add(1e-3 * kNoise, kNoise); }
  void driveToRest() {
    drive(4);
    for (int block = 0; block < 2; ++block) rest();
  }

  /// The model explains 199 of 199 + 5^2 of psi^2.
  void driveBadly() { add(1.0, 5.0); }

  std::pair<bool, bool> excited() const {
    return {excitation.excited(kDampingToMass), excitation.excited(kStiffnessToMass)};
  }

  const Eigen::VectorXd theta = Eigen::Vector2d(3.0, 13.8);
  Excitation excitation{30, 0.99, RegressorNoise(IntegralFilterOptions{30, 0.02, IntegrationRule::kBandLimited})};
};

// The damping's excitation is 5.75, above 36 / n from seven blocks on; the stiffness' is above it as soon as psi is.
void expectReleaseByBlocksSinceNow(ExactBlocks& rows, int stiffness_after, const char* when) {
  for (int n = 1; n <= 7; ++n) {
    rows.driveBadly();
    EXPECT_EQ(rows.excited(), n == 7 ? kBoth : n >= stiffness_after ? kStiffnessOnly : kNone) << when << ' ' << n;
  }
  EXPECT_NEAR(rows.excitation.excitation(kDampingToMass), 5.75, 0.05);
}

TEST(ExcitationReset, HoldsOnWithTheBlocksAfterItOnly) {
  ExactBlocks without;
  without.driveToRest();
  expectReleaseByBlocksSinceNow(without, 1, "no gap");
  for (const double error : {5.0, 50.0})  // as those that come, or such as no strut explains
    for (int before = 0; before <= 6; ++before) {
      ExactBlocks rows;
      rows.driveToRest();
      for (int block = 0; block < before; ++block) rows.add(1.0, error);
      const auto excited = rows.excited();
      rows.excitation.reset();
      EXPECT_EQ(rows.excited(), excited) << error << ' ' << before;
      expectReleaseByBlocksSinceNow(rows, excited == kNone ? 1 : 0, "gap");
    }
}

TEST(ExcitationReset, BeginsABlockAnew) {
  ExactBlocks rows;
  rows.driveToRest();
  rows.add(1.0, kNoise, kRows - 1);  // one more would release both
  rows.excitation.reset();
  EXPECT_FALSE(rows.add(1e-3 * kNoise, kNoise, kRows - 1));
  EXPECT_TRUE(rows.add(1e-3 * kNoise, kNoise, 1));
  EXPECT_EQ(rows.excited(), kNone);
}

TEST(ExcitationReset, OneBlockOfRestOnEitherSideOfAGapHoldsNothing) {
  ExactBlocks rows;
  rows.drive(4);
  rows.rest();
  rows.excitation.reset();
  rows.rest();
  EXPECT_EQ(rows.excited(), kBoth);
  rows.rest();
  EXPECT_EQ(rows.excited(), kNone);
}

TEST(ExcitationReset, TheNewestBlockIsJudgedWithoutTheOneBeforeTheGap) {
  ExactBlocks rows, badly;
  rows.drive(4);
  badly.drive(4);
  rows.excitation.reset();
  rows.driveBadly();
  for (int block = 0; block < 2; ++block) badly.driveBadly();
  for (const StrutParameter i : {kDampingToMass, kStiffnessToMass})
    EXPECT_NEAR(rows.excitation.excitation(i) / badly.excitation.excitation(i), 1.0, 0.01) << i;
}

}  // namespace
}  // namespace suspension_health_monitor
