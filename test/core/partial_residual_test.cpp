#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hidden_effect.h"
#include "recorded_drive.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"

namespace suspension_health_monitor {
namespace {

using Variables = std::vector<ForceVariable>;

constexpr std::size_t kFewest = 60;         // samples in a bin that tell enough of its mean
const std::vector<double> kFriction{0.02};  // vs [m/s]

DriveRecord drivenWith(const std::string& name, double coefficient, std::vector<double> shapes) {
  SimulationOptions options = carDrive(30.0, 0.0);
  options.hidden = {{findEffect(forceEffects(), name), coefficient, std::move(shapes)}};
  return recorded(options);
}

std::vector<PartialResidual> residualsBy(const StrutModel& model, const DriveRecord& record,
                                         const std::vector<StrutState>& initial) {
  const std::optional<ComparedDrives> compared = compareSegments({&record}, model, initial);
  EXPECT_TRUE(compared);
  return partialResiduals(compared->segments, compared->motion, model);
}

/// By a model of the car with one effect.
PartialResidual seen(const DriveRecord& record, const std::string& name, double coefficient,
                     std::vector<double> shapes) {
  const StrutModel model{6.0, 63.3, {{findEffect(forceEffects(), name), coefficient, std::move(shapes)}}, {}};
  const std::optional<std::vector<StrutState>> initial = estimateInitialStates({&record}, model);
  EXPECT_TRUE(initial);
  const std::vector<PartialResidual> forces = residualsBy(model, record, *initial);
  EXPECT_EQ(forces.size(), 1U);
  return forces.empty() ? PartialResidual{} : forces.front();
}

const DriveRecord& carRecord() {
  static const DriveRecord record = recorded(carDrive(30.0, 0.0));
  return record;
}

TEST(PartialResidual, IsTheTrueForceWhateverTheModelSays) {
  constexpr double truth = 0.3;  // [m/s^2]
  const DriveRecord record = drivenWith("coulomb_friction", truth, kFriction);
  for (const double coefficient : {truth, 0.5 * truth, 1e-6}) {
    const PartialResidual force = seen(record, "coulomb_friction", coefficient, kFriction);
    ASSERT_GT(force.curve.size(), 15U);
    for (const PartialResidualBin& bin : force.curve) {
      if (std::abs(bin.at) < 0.1 || bin.count < kFewest) continue;
      EXPECT_NEAR(bin.mean, std::copysign(truth, bin.at), 0.15 * truth) << bin.at;
      EXPECT_NEAR(bin.law, std::copysign(coefficient, bin.at), 1e-3 * coefficient);
    }
  }
}

TEST(PartialResidual, IsNothingWhereTheModelHasTooMuch) {
  for (const PartialResidualBin& bin : seen(carRecord(), "coulomb_friction", 0.3, kFriction).curve)
    EXPECT_NEAR(bin.mean, 0.0, 0.045) << bin.at;
}

TEST(PartialResidual, KnowsWhatTheLawDependsOn) {
  EXPECT_EQ(seen(carRecord(), "progressive_spring", 4e4, {3.0}).variables, Variables{ForceVariable::kTravel});
  EXPECT_EQ(seen(carRecord(), "quadratic_damping", 1.0, {}).variables, Variables{ForceVariable::kTravelRate});
  EXPECT_EQ(seen(carRecord(), "bump_stop", 100.0, {0.012}).variables, Variables{ForceVariable::kTravel});
  EXPECT_EQ(seen(carRecord(), "position_dependent_damping", 1e3, {}).variables,
            (Variables{ForceVariable::kTravel, ForceVariable::kTravelRate}));
  EXPECT_EQ(seen(carRecord(), "damping_drift", 0.01, {}).variables,
            (Variables{ForceVariable::kTravelRate, ForceVariable::kTime}));
}

TEST(PartialResidual, LawIsTheCurveThroughTheBins) {
  const PartialResidual force = seen(carRecord(), "progressive_spring", 4e4, {3.0});
  EXPECT_DOUBLE_EQ(force.lawAt(0.01), 4e4 * 1e-6);
  EXPECT_DOUBLE_EQ(force.lawAt(-0.01), -4e4 * 1e-6);
  for (const PartialResidualBin& bin : force.curve) EXPECT_NEAR(bin.law, force.lawAt(bin.at), 0.02);
}

TEST(PartialResidual, FillsThePlaneOfTwoVariables) {
  const PartialResidual force = seen(carRecord(), "position_dependent_damping", 1e3, {});
  const PartialResidualGrid& grid = force.grid;
  EXPECT_TRUE(force.curve.empty());
  ASSERT_EQ(grid.cells.size() + 1, grid.first_edges.size());
  std::size_t samples = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    ASSERT_EQ(grid.cells[i].size() + 1, grid.second_edges.size());
    for (std::size_t j = 0; j < grid.cells[i].size(); ++j) {
      const PartialResidualBin& cell = grid.cells[i][j];
      if (cell.count == 0) continue;
      samples += cell.count;
      const double farthest = std::max(std::abs(grid.first_edges[i]), std::abs(grid.first_edges[i + 1]));
      const double low = std::min(0.0, grid.second_edges[j]), high = std::max(0.0, grid.second_edges[j + 1]);
      EXPECT_GE(cell.law, 1e3 * farthest * farthest * low);
      EXPECT_LE(cell.law, 1e3 * farthest * farthest * high);
    }
  }
  EXPECT_GT(samples, 0.95 * static_cast<double>(carRecord().numSamples()));
}

TEST(PartialResidual, ShowsTheLoopOfALawWithMemory) {
  const PartialResidual force = seen(carRecord(), "hysteresis", 0.5, {0.004});
  EXPECT_TRUE(force.hasMemory());
  ASSERT_FALSE(force.curve.empty());
  ASSERT_FALSE(force.back.empty());
  double compressing = 0.0, extending = 0.0;
  for (const PartialResidualBin& bin : force.curve) compressing += bin.law / static_cast<double>(force.curve.size());
  for (const PartialResidualBin& bin : force.back) extending += bin.law / static_cast<double>(force.back.size());
  EXPECT_GT(compressing, 0.1);  // friction resists the motion: it pushes the body up while the strut compresses
  EXPECT_LT(extending, -0.1);
}

TEST(PartialResidual, AModelWithoutEffectsHasNone) {
  EXPECT_TRUE(residualsBy({6.0, 63.3, {}, {}}, carRecord(), {StrutState{}}).empty());
}

}  // namespace
}  // namespace suspension_health_monitor
