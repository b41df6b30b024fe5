#include "suspension_health_monitor/internal/monitor/validity_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

EstimateFacts nothingAgainstIt() {
  EstimateFacts facts;
  facts.has_row = true;
  facts.rows = facts.fewest_rows = 50.0;
  facts.damping_stddev = facts.stiffness_stddev = kMostRelativeStddev;
  facts.explained = kMajority;
  facts.age = facts.oldest = 60.0;
  return facts;
}

struct Flaw {
  EstimateDoubt doubt;
  std::function<void(EstimateFacts&)> make;
};

// In the order of EstimateDoubt.
const std::vector<Flaw> kFlaws{
    {EstimateDoubt::kWrongPeriod, [](EstimateFacts& f) { f.period_fits = false; }},
    {EstimateDoubt::kWrongUnit, [](EstimateFacts& f) { f.unit_fits = false; }},
    {EstimateDoubt::kNoRows, [](EstimateFacts& f) { f.has_row = false; }},
    {EstimateDoubt::kFewRows, [](EstimateFacts& f) { f.rows = 49.9; }},
    {EstimateDoubt::kNotExcited, [](EstimateFacts& f) { f.damping_stddev = f.stiffness_stddev = 0.151; }},
    {EstimateDoubt::kDampingNotExcited, [](EstimateFacts& f) { f.damping_stddev = 0.151; }},
    {EstimateDoubt::kStiffnessNotExcited, [](EstimateFacts& f) { f.stiffness_stddev = 0.151; }},
    {EstimateDoubt::kNotExplained, [](EstimateFacts& f) { f.explained = kMajority - 1e-9; }},
    {EstimateDoubt::kNotAStrut, [](EstimateFacts& f) { f.is_physical = false; }},
    {EstimateDoubt::kVehicleFile,
     [](EstimateFacts& f) { f.absolute_stddev = std::numeric_limits<double>::infinity(); }},
    {EstimateDoubt::kOldData, [](EstimateFacts& f) { f.age = 60.1; }},
    {EstimateDoubt::kDisagrees, [](EstimateFacts& f) { f.agrees = false; }},
    {EstimateDoubt::kFreeRunFails, [](EstimateFacts& f) { f.free_run_fails = true; }},
    {EstimateDoubt::kModelError, [](EstimateFacts& f) { f.absolute_stddev = std::max(f.absolute_stddev, 0.151); }},
};

TEST(ValidityGate, PassesAnEstimateThatNothingSpeaksAgainst) {
  EXPECT_EQ(doubtOf(nothingAgainstIt()), EstimateDoubt::kNone);
}

TEST(ValidityGate, NamesEveryFlaw) {
  for (const Flaw& flaw : kFlaws) {
    EstimateFacts facts = nothingAgainstIt();
    flaw.make(facts);
    EXPECT_EQ(doubtOf(facts), flaw.doubt) << describe(flaw.doubt);
  }
}

// All but those of the excitation, of which the first includes the other two.
TEST(ValidityGate, NamesTheFirstOfSeveralFlaws) {
  for (std::size_t i = 0; i < kFlaws.size(); ++i)
    for (std::size_t j = i + 1; j < kFlaws.size(); ++j) {
      if (kFlaws[i].doubt == EstimateDoubt::kDampingNotExcited &&
          kFlaws[j].doubt == EstimateDoubt::kStiffnessNotExcited)
        continue;
      EstimateFacts facts = nothingAgainstIt();
      kFlaws[i].make(facts);
      kFlaws[j].make(facts);
      EXPECT_EQ(doubtOf(facts), kFlaws[i].doubt) << describe(kFlaws[i].doubt) << ", " << describe(kFlaws[j].doubt);
    }
}

TEST(ValidityGate, NumbersThatAreNoneAreFlaws) {
  EstimateFacts facts = nothingAgainstIt();
  facts.age = std::nan("");
  EXPECT_EQ(doubtOf(facts), EstimateDoubt::kOldData);
  facts.explained = std::nan("");
  EXPECT_EQ(doubtOf(facts), EstimateDoubt::kNotExplained);
  facts.stiffness_stddev = std::nan("");
  EXPECT_EQ(doubtOf(facts), EstimateDoubt::kStiffnessNotExcited);
  facts.rows = std::nan("");
  EXPECT_EQ(doubtOf(facts), EstimateDoubt::kFewRows);
}

TEST(ValidityGate, NoMoreRowsAreWantedThanNineTenthsOfTheMemory) {
  MonitorSettings settings;                                // memory 2 s
  EXPECT_DOUBLE_EQ(settings.fewestRows(1.5, 0.02), 45.0);  // of 0.6 s
  EXPECT_DOUBLE_EQ(settings.fewestRows(1.5, 0.001), 900.0);
  EXPECT_NEAR(settings.fewestRows(10.0, 0.001), 1800.0, 1e-6);
  settings.forgetting_factor = 0.98;
  EXPECT_NEAR(settings.fewestRows(2.0, 0.02), 45.0, 1e-9);
  settings.forgetting_factor = 1.0;
  EXPECT_DOUBLE_EQ(settings.fewestRows(2.0, 0.02), 60.0);
}

}  // namespace
}  // namespace suspension_health_monitor
