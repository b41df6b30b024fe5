// Faults of the body's sensor are found as such, by the search with the whole library.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "body_drive.h"
#include "suspension_health_monitor/internal/search/effect_search.h"

namespace suspension_health_monitor {
namespace {

using Names = std::vector<std::string>;

SearchResult search(const DriveRecord& record, EffectLibrary library = builtInEffects()) {
  takeUntestable(library, {&record});
  DiagnoseOptions options;
  options.candidates = std::move(library);
  options.most_effects = 2;
  SearchResult result = searchEffects({&record}, {4.4, 44.0, {}, {}}, options);
  EXPECT_TRUE(result);
  return result;
}

/// @param tolerance  of the coefficients, in their unit.
void expectFound(const ActiveMeasurementEffect& hidden, double tolerance) {
  SimulationOptions options = swayingDrive("ugv", 4);
  options.hidden_faults = {hidden};
  const SearchResult result = search(recordedWithBody(options));
  EXPECT_EQ(result.verdict, Verdict::kEffectFound);
  ASSERT_EQ(result.selected, Names{hidden.effect.name});
  EXPECT_TRUE(result.final_fit->model.effects.empty());
  EXPECT_NEAR(result.final_fit->model.damping_to_mass, 4.0, 0.05);
  EXPECT_NEAR(result.final_fit->model.stiffness_to_mass, 40.0, 0.5);
  const std::vector<double>& found = result.final_fit->model.reading.at(0).coefficients;
  ASSERT_EQ(found.size(), hidden.coefficients.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], hidden.coefficients[i], tolerance) << i;
}

TEST(ReadingSearch, ClockOffsetIsFound) { expectFound(fault("clock_offset", {0.006}), 3e-4); }

TEST(ReadingSearch, BiasIsFound) { expectFound(fault("accelerometer_bias", {0.1}), 0.005); }

TEST(ReadingSearch, TiltIsFound) { expectFound(fault("mount_tilt", {0.06, -0.04}), 0.003); }

TEST(ReadingSearch, LeverArmIsFound) { expectFound(fault("lever_arm", {-0.15, 0.3}), 0.01); }

TEST(ReadingSearch, NothingIsProposedWhereTheBodySwaysAndNothingIsHidden) {
  const SearchResult result = search(recordedWithBody(swayingDrive("ugv", 5)));
  EXPECT_EQ(result.verdict, Verdict::kNothingMissing);
  EXPECT_TRUE(result.selected.empty());
}

TEST(ReadingSearch, OneLiveAxisIsEnoughForATilt) {
  SimulationOptions options = swayingDrive("ugv", 4);
  options.hidden_faults = {fault("mount_tilt", {0.06, 0.0})};
  Drive record_drive;
  for (const DriveSample& sample : drive(options)) {
    record_drive.samples.push_back({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
    record_drive.body.push_back({sample.sprung->stamp, {sample.body.acceleration[0], 0.0}, {0.0, 0.0}});
  }
  const DriveRecord record(record_drive, 0.01, 1);
  const SearchResult result = search(record);
  EXPECT_EQ(result.verdict, Verdict::kEffectFound);
  ASSERT_EQ(result.selected, Names{"mount_tilt"});
  const StrutModel& found = result.final_fit->model;
  EXPECT_NEAR(found.reading.at(0).coefficients.at(0), 0.06, 0.003);
  EXPECT_EQ(found.reading.at(0).coefficients.at(1), 0.0);
  for (const double deviation : result.final_fit->stddev) EXPECT_TRUE(std::isfinite(deviation));
  EXPECT_FALSE(findUntestable(found, {&record}));
  StrutModel both = found;
  both.reading[0].coefficients[1] = 0.01;  // nothing is known of that axis
  EXPECT_TRUE(findUntestable(both, {&record}));
}

TEST(ReadingSearch, WithoutTheChannelsTheFaultHasNoName) {
  SimulationOptions options = swayingDrive("ugv", 4);
  options.hidden_faults = {fault("lever_arm", {-0.15, 0.3})};
  Drive record_drive;
  for (const DriveSample& sample : drive(options))
    record_drive.samples.push_back({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
  const DriveRecord record(record_drive, 0.01, 1);
  const SearchResult result = search(record);
  EXPECT_EQ(result.verdict, Verdict::kUnexplained);
  EXPECT_TRUE(result.selected.empty());
}

}  // namespace
}  // namespace suspension_health_monitor
