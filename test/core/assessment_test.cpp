#include "suspension_health_monitor/internal/health/assessment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kNominalB1 = 3.0, kNominalB0 = 13.8;

HealthThresholds options() {
  HealthThresholds result;
  result.nominal_damping_to_mass = kNominalB1;
  result.nominal_stiffness_to_mass = kNominalB0;
  result.confirm_time = 1.0;
  return result;
}

StrutEstimate estimate(double damping_change, double stiffness_change) {
  StrutEstimate result;
  result.damping_to_mass = kNominalB1 * (1.0 + damping_change);
  result.stiffness_to_mass = kNominalB0 * (1.0 + stiffness_change);
  result.doubt = EstimateDoubt::kNone;
  return result;
}

Stamp at(double seconds) { return fromSeconds(seconds); }

const HealthReport& update(HealthAssessment& assessment, Stamp stamp, const StrutEstimate& both) {
  return assessment.update(stamp, both, true);
}

// The report once the estimate has lasted: for ten memories, after which a trend is as certain as its estimates.
HealthReport judged(const StrutEstimate& of, const HealthThresholds& by = options()) {
  HealthAssessment assessment(by);
  for (int k = 0; k < 1000; ++k) update(assessment, at(0.01 * k), of);
  return assessment.report();
}

TEST(HealthAssessment, JudgesEachParameterByItsOwnThresholds) {
  HealthThresholds strict = options();
  strict.damping_warn = 0.1;
  strict.damping_error = 0.2;
  strict.stiffness_warn = 0.3;
  strict.stiffness_error = 0.4;
  const auto levels = [&](double damping_change, double stiffness_change) {
    const HealthReport report = judged(estimate(damping_change, stiffness_change), strict);
    return std::pair(report.damping_level, report.stiffness_level);
  };
  EXPECT_EQ(levels(0.09, -0.29), std::pair(HealthLevel::kOk, HealthLevel::kOk));
  EXPECT_EQ(levels(-0.11, 0.31), std::pair(HealthLevel::kWarn, HealthLevel::kWarn));
  EXPECT_EQ(levels(0.19, -0.39), std::pair(HealthLevel::kWarn, HealthLevel::kWarn));
  EXPECT_EQ(levels(-0.21, 0.41), std::pair(HealthLevel::kError, HealthLevel::kError));
}

TEST(HealthAssessment, AnEstimateThatCannotTellConfirmsNoAlarm) {
  HealthAssessment assessment(options());
  const StrutEstimate lost;  // not valid
  for (double t = 0.0; t <= 5.0; t += 0.02) update(assessment, at(t), estimate(0.0, 0.0));
  for (double t = 5.02; t <= 5.1; t += 0.02) update(assessment, at(t), estimate(-0.17, 0.0));
  for (double t = 5.12; t <= 6.05; t += 0.02)
    ASSERT_EQ(update(assessment, at(t), lost).level, HealthLevel::kOk) << "at " << t;
  for (double t = 6.14; t <= 9.0; t += 0.02)
    ASSERT_EQ(update(assessment, at(t), lost).level, HealthLevel::kStale) << "at " << t;
}

TEST(HealthAssessment, ReportsTheWorseOfTheTwoAndTheSignOfTheChange) {
  const HealthReport damper = judged(estimate(-0.31, 0.05));
  EXPECT_EQ(damper.level, HealthLevel::kError);
  EXPECT_NEAR(*damper.damping_change, -0.31, 1e-12);
  EXPECT_NEAR(*damper.stiffness_change, 0.05, 1e-12);
  EXPECT_EQ(judged(estimate(0.0, -0.2)).level, HealthLevel::kWarn);
  EXPECT_EQ(judged(estimate(0.1, -0.1)).level, HealthLevel::kOk);
}

TEST(HealthAssessment, ThresholdItselfIsTheHigherLevel) {
  HealthThresholds exact = options();
  exact.nominal_damping_to_mass = 4.0;
  exact.damping_warn = 0.25;
  exact.damping_error = 0.5;
  StrutEstimate value = estimate(0.0, 0.0);
  value.damping_to_mass = 3.0;
  EXPECT_EQ(judged(value, exact).level, HealthLevel::kWarn);
  value.damping_to_mass = 2.0;
  EXPECT_EQ(judged(value, exact).level, HealthLevel::kError);
}

TEST(HealthAssessment, JudgesOnlyWhatHasANominalValue) {
  HealthThresholds only_damping = options();
  only_damping.nominal_stiffness_to_mass.reset();
  const HealthReport report = judged(estimate(0.0, -0.9), only_damping);
  EXPECT_EQ(report.level, HealthLevel::kOk);
  EXPECT_FALSE(report.stiffness_change);
  EXPECT_EQ(judged(estimate(-0.9, -0.9), HealthThresholds{}).level, HealthLevel::kOk);
}

TEST(HealthAssessment, EstimateThatIsNotValidIsStaleNeverHealthy) {
  StrutEstimate invalid = estimate(0.0, 0.0);
  invalid.doubt = EstimateDoubt::kNoRows;
  const HealthReport report = judged(invalid);
  EXPECT_EQ(report.level, HealthLevel::kStale);
  EXPECT_FALSE(report.damping_change);
  EXPECT_EQ(judged(invalid, HealthThresholds{}).level, HealthLevel::kStale);
  EXPECT_EQ(HealthAssessment(options()).report().level, HealthLevel::kStale);
}

TEST(HealthAssessment, NewLevelMustLastForTheConfirmTime) {
  HealthAssessment assessment(options());  // 1 s
  const auto level = [&](double seconds, double change) {
    return update(assessment, at(seconds), estimate(change, 0.0)).level;
  };
  EXPECT_EQ(level(5.0, 0.0), HealthLevel::kStale);
  EXPECT_EQ(level(5.999, 0.0), HealthLevel::kStale);
  EXPECT_EQ(level(6.0, 0.0), HealthLevel::kOk);
  EXPECT_EQ(level(7.0, -0.2), HealthLevel::kOk);
  EXPECT_EQ(level(7.9, -0.2), HealthLevel::kOk);
  EXPECT_EQ(level(7.95, 0.0), HealthLevel::kOk);  // back in time: nothing happened
  EXPECT_EQ(level(8.0, -0.2), HealthLevel::kOk);
  EXPECT_EQ(level(8.999, -0.2), HealthLevel::kOk);
  EXPECT_EQ(level(9.0, -0.2), HealthLevel::kWarn);
  EXPECT_EQ(level(9.5, -0.4), HealthLevel::kWarn);
  EXPECT_EQ(level(10.5, -0.4), HealthLevel::kError);
}

TEST(HealthAssessment, NoiseAtAThresholdHidesNothing) {
  HealthAssessment assessment(options());
  const auto alternate = [&](double first, double change, double other_change) {
    for (int k = 0; k <= 60; ++k)
      update(assessment, at(first + 0.02 * k), estimate(k % 2 ? change : other_change, 0.0));
    return assessment.report().level;
  };
  EXPECT_EQ(alternate(0.0, 0.0, 0.0), HealthLevel::kOk);
  EXPECT_EQ(alternate(10.0, -0.27, -0.31), HealthLevel::kWarn);
  EXPECT_EQ(alternate(20.0, -0.31, -0.31), HealthLevel::kError);
  EXPECT_EQ(alternate(30.0, -0.12, -0.16), HealthLevel::kWarn);
  EXPECT_EQ(alternate(40.0, -0.12, -0.16), HealthLevel::kWarn);
  EXPECT_EQ(alternate(50.0, -0.12, -0.12), HealthLevel::kOk);
  EXPECT_EQ(alternate(60.0, -0.12, -0.16), HealthLevel::kOk);
}

TEST(HealthAssessment, LevelEndsBelowItsThresholdLessTheHysteresis) {
  HealthThresholds quick = options();
  quick.confirm_time = 0.0;
  HealthAssessment assessment(quick);
  const auto level = [&](double change) { return update(assessment, at(1.0), estimate(change, 0.0)).level; };
  EXPECT_EQ(level(-0.149), HealthLevel::kOk);
  EXPECT_EQ(level(-0.151), HealthLevel::kWarn);
  EXPECT_EQ(level(-0.131), HealthLevel::kWarn);
  EXPECT_EQ(level(-0.129), HealthLevel::kOk);
  EXPECT_EQ(level(-0.301), HealthLevel::kError);
  EXPECT_EQ(level(-0.281), HealthLevel::kError);
  EXPECT_EQ(level(-0.279), HealthLevel::kWarn);
}

// One standard deviation, of the baseline, of 3 % is more than the 2 %.
TEST(HealthAssessment, LevelEndsNotBeforeAStandardDeviationBelowItsThreshold) {
  HealthAssessment assessment(options());
  Baseline baseline = assessment.baseline();
  baseline.damping_to_mass_stddev = 0.03 * kNominalB1;
  assessment.setBaseline(baseline);
  double t = 0.0, change = 0.0;
  const auto levelAt = [&](double end) {  // slowly, so that the trend does not overshoot
    for (const double step = (end - change) / 10000.0; std::abs(end - change) > std::abs(step) / 2.0; change += step) {
      StrutEstimate sure = estimate(change, 0.0);
      sure.damping_to_mass_stddev = sure.stiffness_to_mass_stddev = 1e-6;
      update(assessment, at(t += 0.01), sure);
    }
    return assessment.report().level;
  };
  EXPECT_EQ(levelAt(-0.145), HealthLevel::kOk);
  EXPECT_EQ(levelAt(-0.155), HealthLevel::kWarn);
  EXPECT_EQ(levelAt(-0.125), HealthLevel::kWarn);
  EXPECT_EQ(levelAt(-0.115), HealthLevel::kOk);
}

// What was certain once is not taken back because the road is poor for a while.
TEST(HealthAssessment, LevelLastsWhileHalfOfItsSignificanceIsLeft) {
  HealthAssessment assessment(options());
  double t = 0.0;
  const auto levelWith = [&](double relative_stddev) {
    StrutEstimate vague = estimate(-0.2, 0.0);  // ln 0.8 = -0.223
    vague.damping_to_mass_stddev = relative_stddev * vague.damping_to_mass;
    vague.stiffness_to_mass_stddev = 1e-6;
    for (int k = 0; k < 1000; ++k) update(assessment, at(t += 0.01), vague);
    return assessment.report().level;
  };
  EXPECT_EQ(levelWith(0.06), HealthLevel::kOk);     // 3.7 sigma: not yet
  EXPECT_EQ(levelWith(0.05), HealthLevel::kWarn);   // 4.5 sigma
  EXPECT_EQ(levelWith(0.06), HealthLevel::kWarn);   // 3.7 sigma
  EXPECT_EQ(levelWith(0.10), HealthLevel::kWarn);   // 2.2 sigma
  EXPECT_EQ(levelWith(0.13), HealthLevel::kStale);  // 1.7 sigma
}

TEST(HealthAssessment, AChangeThatIsNotSignificantIsNone) {
  StrutEstimate vague = estimate(-0.2, 0.0);  // ln 0.8 = -0.223
  const auto levelWith = [&](double relative_stddev) {
    vague.damping_to_mass_stddev = relative_stddev * vague.damping_to_mass;
    return judged(vague).level;
  };
  EXPECT_EQ(levelWith(0.05), HealthLevel::kWarn);   // 4.5 sigma
  EXPECT_EQ(levelWith(0.06), HealthLevel::kOk);     // 3.7 sigma
  EXPECT_EQ(levelWith(0.08), HealthLevel::kStale);  // 30 % would not be 4 sigma
  vague.damping_to_mass_stddev = 0.08 * vague.damping_to_mass;
  EXPECT_NE(describe(judged(vague)).find("too uncertain"), std::string::npos);
  HealthAssessment by_baseline(options());  // the baseline's own uncertainty counts as well
  Baseline baseline = by_baseline.baseline();
  baseline.damping_to_mass_stddev = 0.06 * kNominalB1;
  by_baseline.setBaseline(baseline);
  vague.damping_to_mass_stddev = vague.stiffness_to_mass_stddev = 1e-3;
  for (int k = 0; k < 1000; ++k) update(by_baseline, at(0.01 * k), vague);
  EXPECT_EQ(by_baseline.report().level, HealthLevel::kOk);
}

TEST(HealthAssessment, ConfirmTimeZeroReportsAtOnce) {
  HealthThresholds quick = options();
  quick.confirm_time = 0.0;
  HealthAssessment assessment(quick);
  EXPECT_EQ(update(assessment, at(5.0), estimate(-0.4, 0.0)).level, HealthLevel::kError);
  EXPECT_EQ(update(assessment, at(5.0), estimate(0.0, 0.0)).level, HealthLevel::kOk);
}

TEST(HealthAssessment, ClockThatGoesBackRestartsTheConfirmation) {
  HealthAssessment assessment(options());
  update(assessment, at(100.0), estimate(-0.2, 0.0));
  update(assessment, at(50.0), estimate(-0.2, 0.0));
  EXPECT_EQ(update(assessment, at(50.9), estimate(-0.2, 0.0)).level, HealthLevel::kStale);
  EXPECT_EQ(update(assessment, at(51.0), estimate(-0.2, 0.0)).level, HealthLevel::kWarn);
}

TEST(HealthAssessment, RefusesAnErrorThresholdBelowItsWarning) {
  HealthThresholds wrong = options();
  wrong.stiffness_error = 0.1;
  try {
    HealthAssessment assessment(wrong);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("health/stiffness_error = 0.1"), std::string::npos) << message;
    EXPECT_NE(message.find("health/stiffness_warn = 0.15"), std::string::npos) << message;
  }
  wrong = options();
  wrong.damping_error = wrong.damping_warn;
  EXPECT_NO_THROW(requireConsistent(wrong));
  wrong.damping_warn = 0.5;
  EXPECT_THROW(requireConsistent(wrong), std::invalid_argument);
}

TEST(HealthReport, SaysInOneSentenceWhatChanged) {
  EXPECT_EQ(describe(judged(estimate(-0.31, 0.0))), "damping 31 % below nominal, stiffness at nominal");
  EXPECT_EQ(describe(judged(estimate(0.002, 0.204))), "damping at nominal, stiffness 20 % above nominal");
  HealthThresholds only_stiffness = options();
  only_stiffness.nominal_damping_to_mass.reset();
  EXPECT_EQ(describe(judged(estimate(-0.31, -0.16), only_stiffness)), "stiffness 16 % below nominal");
  HealthThresholds nothing;
  nothing.learn_time = 0.0;
  EXPECT_EQ(describe(judged(estimate(0.0, 0.0), nothing)), "estimates valid; no nominal values given to judge them by");
  EXPECT_EQ(describe(HealthReport{}), "cannot tell: too few readings since a start or a gap");
}

// ln 0.69 = -0.371, +- 1.96 * 0.05: 1 - exp(-0.273), 1 - exp(-0.469).
TEST(HealthReport, GivesTheSizeOfAChangeWithItsInterval) {
  StrutEstimate worn = estimate(-0.31, 0.0);
  worn.damping_to_mass_stddev = 0.05 * worn.damping_to_mass;
  EXPECT_EQ(describe(judged(worn)), "damping 31 % below nominal (24 to 37 %), stiffness at nominal");
  StrutEstimate stiff = estimate(0.0, 0.25);
  stiff.stiffness_to_mass_stddev = 0.05 * stiff.stiffness_to_mass;
  EXPECT_EQ(describe(judged(stiff)), "damping at nominal, stiffness 25 % above nominal (13 to 38 %)");
  stiff = estimate(0.0, 0.026);
  stiff.stiffness_to_mass_stddev = 0.05 * stiff.stiffness_to_mass;
  EXPECT_EQ(describe(judged(stiff)), "damping at nominal, stiffness 3 % above nominal (7 % below to 13 % above)");
}

TEST(StrutEstimate, SaysHowMuchLongerToDrive) {
  StrutEstimate known = estimate(0.0, 0.0);
  known.window = 10.0;
  known.damping_to_mass_stddev = 0.05 * known.damping_to_mass;
  known.stiffness_to_mass_stddev = 0.01 * known.stiffness_to_mass;
  EXPECT_DOUBLE_EQ(known.knownTo(), 1.96 * 0.05);
  EXPECT_NEAR(known.secondsUntil(1.96 * 0.025), 30.0, 1e-9) << "half the deviation takes four times the drive";
  EXPECT_EQ(known.secondsUntil(0.1), 0.0);
  known.doubt = EstimateDoubt::kDampingNotExcited;
  EXPECT_EQ(
      describeDoubt(known, 1.96 * 0.025),
      "too little motion to know damping: drive on, or use a rougher road; damping and stiffness are known to 10 %, "
      "about 30 s more on this road to 5 %");
  known.roughest = 3.0;
  EXPECT_EQ(
      describeDoubt(known, 1.96 * 0.025),
      "too little motion to know damping: drive on, or use a rougher road; damping and stiffness are known to 10 %, "
      "about 30 s more on this road to 5 % (10 s on a road as rough as the roughest quarter so far)");
  known.doubt = EstimateDoubt::kOldData;
  EXPECT_EQ(describeDoubt(known, 0.05), describe(EstimateDoubt::kOldData));
  EXPECT_TRUE(std::isnan(StrutEstimate().knownTo()));
}

TEST(HealthReport, SaysThatANewLevelIsBeingConfirmed) {
  HealthAssessment assessment(options());
  for (double t = 0.0; t <= 2.0; t += 0.02) update(assessment, at(t), StrutEstimate());
  for (double t = 2.02; t <= 2.5; t += 0.02) update(assessment, at(t), estimate(0.0, 0.0));
  EXPECT_EQ(assessment.report().level, HealthLevel::kStale);
  EXPECT_EQ(describe(assessment.report()), "cannot tell yet: a new level must last for health/confirm_time");
}

// Before "cannot tell" is confirmed, the last judgement stands, with its reasons.
TEST(HealthReport, KeepsItsReasonsAsLongAsItsLevel) {
  HealthAssessment assessment(options());
  update(assessment, at(0.0), estimate(-0.4, 0.0));
  update(assessment, at(1.0), estimate(-0.4, 0.0));
  StrutEstimate invalid = estimate(-0.4, 0.0);
  invalid.doubt = EstimateDoubt::kNoRows;
  const HealthReport unconfirmed = update(assessment, at(1.5), invalid);
  EXPECT_EQ(unconfirmed.level, HealthLevel::kError);
  EXPECT_EQ(unconfirmed.damping_level, HealthLevel::kError);
  EXPECT_EQ(describe(unconfirmed), "damping 40 % below nominal, stiffness at nominal");
  const HealthReport stale = update(assessment, at(2.5), invalid);
  EXPECT_EQ(stale.level, HealthLevel::kStale);
  EXPECT_FALSE(stale.damping_change);
}

}  // namespace
}  // namespace suspension_health_monitor
