// Dry friction beside the linear strut: heard from what least squares leaves, and what health makes of it.
#include <gtest/gtest.h>

#include <cmath>

#include "suspension_health_monitor/internal/health/assessment.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 4.0, kB0 = 50.0, kRate = 200.0;

/// A travel of which every derivative is known, in modes that beat, and the two readings of a strut that makes
/// b1 v + b0 d + f sgn(v) + q v |v| of it: no equation is integrated.
struct KnownStrut {
  double size = 0.01;        // of the travel [m]
  double friction = 0.0;     // f [m/s^2]
  double quadratic = 0.0;    // q [1/m]
  double body_offset = 0.0;  // [m/s^2]

  CornerSample at(double t) const {
    double d = 0.0, v = 0.0, a = 0.0;
    for (const double omega : {8.3, 9.7, 11.9, 14.1, 17.7, 20.3}) {
      const double phase = omega * t + omega * omega;
      d += size * std::sin(phase);
      v += size * omega * std::cos(phase);
      a -= size * omega * omega * std::sin(phase);
    }
    const double body = kB1 * v + kB0 * d + friction * (v > 0.0 ? 1.0 : -1.0) + quadratic * v * std::abs(v);
    return {fromSeconds(t), body + body_offset, body + a};
  }
};

StrutEstimate estimateOf(const KnownStrut& strut) {
  MonitorOptions options;
  options.sample_period = 1.0 / kRate;
  SuspensionMonitor monitor(options);
  for (int k = 0; k < 120 * kRate; ++k) monitor.addSample(strut.at(k / kRate));
  EXPECT_TRUE(monitor.report().ls.valid()) << describe(monitor.report().ls.doubt);
  EXPECT_TRUE(monitor.report().ls.friction);
  return monitor.report().ls;
}

TEST(DryFriction, IsHeardWithItsSizeAndWhatItMakesOfTheDamping) {
  for (const double size : {0.01, 0.03})
    for (const double friction : {0.1, 0.3}) {
      SCOPED_TRACE(std::to_string(size) + " m, " + std::to_string(friction) + " m/s^2");
      const StrutEstimate estimate = estimateOf({size, friction});
      EXPECT_NEAR(estimate.friction->force, friction, 0.15 * friction);
      const double made = estimate.damping_to_mass - kB1;
      EXPECT_GT(made, 0.05);
      EXPECT_NEAR(estimate.friction->force * estimate.friction->damping_gain, made, 0.3 * made);
    }
}

TEST(DryFriction, MakesTheMoreOfTheDampingTheSmallerTheMotion) {
  const double small = estimateOf({0.01, 0.1}).friction->damping_gain;
  const double large = estimateOf({0.03, 0.1}).friction->damping_gain;
  EXPECT_NEAR(small / large, 3.0, 0.1);
}

TEST(DryFriction, IsNoneInALinearStrutAndBelowZeroInAProgressiveDamper) {
  const DryFriction none = *estimateOf({}).friction;
  EXPECT_NEAR(none.force, 0.0, 0.005);
  KnownStrut progressive;
  progressive.quadratic = 2.0;
  EXPECT_LT(estimateOf(progressive).friction->force, -0.01);
}

TEST(DryFriction, IsHeardBesideGravityInOneSensor) {
  KnownStrut upright{0.01, 0.2};
  upright.body_offset = 9.81;
  EXPECT_NEAR(estimateOf(upright).friction->force, estimateOf({0.01, 0.2}).friction->force, 0.005);
}

Baseline learnedBaseline() {
  Baseline baseline;
  baseline.damping_to_mass = 8.0;
  baseline.stiffness_to_mass = 40.0;
  baseline.damping_to_mass_stddev = 0.3;
  baseline.friction = DryFriction{0.2, 0.01, 20.0, -50.0};
  baseline.learned = true;
  return baseline;
}

TEST(HealthyValues, AreThoseOfThePresentRoad) {
  const HealthyValues healthy = onThisRoad(learnedBaseline(), DryFriction{0.2, 0.01, 5.0, -10.0}, 5.0);
  EXPECT_NEAR(healthy.damping->value, 8.0 + 0.2 * (5.0 - 20.0), 1e-12);
  EXPECT_NEAR(healthy.damping->stddev, std::sqrt(0.3 * 0.3 + 0.6 * 0.6 + 0.15 * 0.15 / 2.0), 1e-12);
  EXPECT_NEAR(healthy.stiffness->value, 40.0 + 0.2 * (50.0 - 10.0), 1e-12);
  EXPECT_NEAR(healthy.stiffness->stddev, std::sqrt(1.6 * 1.6 + 0.4 * 0.4 / 2.0), 1e-12);
}

// b1 = b - k r on a road of rate r has, along g = 1 / r, the slope f = k r^2 there, for roads that are not far apart.
TEST(HealthyValues, FollowADamperThatIsSofterTheFasterItMoves) {
  const double b = 6.0, k = 1.0;
  const auto on = [&](double rate) { return DryFriction{k * rate * rate, 0.0, 1.0 / rate, 0.0}; };
  Baseline baseline = learnedBaseline();
  baseline.damping_to_mass = b - k * 1.0;
  baseline.friction = on(1.0);
  EXPECT_NEAR(onThisRoad(baseline, on(1.5), 4.0).damping->value, b - k * 1.5, 0.1 * 0.5);
}

TEST(HealthyValues, AreTheLearnedOnesOnTheSameRoadAndWhereFrictionIsNotKnown) {
  const Baseline baseline = learnedBaseline();
  Baseline without = baseline;
  without.friction.reset();
  for (const HealthyValues& healthy : {onThisRoad(baseline, {}, 4.0), onThisRoad(baseline, baseline.friction, 4.0),
                                       onThisRoad(without, baseline.friction, 4.0)}) {
    EXPECT_EQ(healthy.damping->value, 8.0);
    EXPECT_EQ(healthy.damping->stddev, 0.3);
    EXPECT_EQ(healthy.stiffness->value, 40.0);
  }
  EXPECT_FALSE(onThisRoad({}, baseline.friction, 4.0).damping);
}

TEST(HealthyValues, CannotBeToldWhereNearlyAllOfThemWasFriction) {
  Baseline baseline = learnedBaseline();
  baseline.friction->force = 0.5;
  EXPECT_TRUE(std::isinf(onThisRoad(baseline, DryFriction{0.5, 0.0, 2.0, -50.0}, 4.0).damping->stddev));
}

StrutEstimate estimate(double damping, const DryFriction& friction) {
  StrutEstimate of;
  of.damping_to_mass = damping;
  of.stiffness_to_mass = 40.0;
  of.damping_to_mass_stddev = 0.05;
  of.stiffness_to_mass_stddev = 0.4;
  of.friction = friction;
  of.doubt = EstimateDoubt::kNone;
  return of;
}

HealthReport reportAfter(const Baseline& baseline, const StrutEstimate& of) {
  HealthOptions options;
  options.confirm_time = 1.0;
  HealthAssessment assessment(options);
  assessment.setBaseline(baseline);
  for (int k = 0; k < 1000; ++k) assessment.update(fromSeconds(0.01 * k), of, of);
  return assessment.report();
}

TEST(HealthAssessment, ARougherRoadIsNoLossOfDamping) {
  Baseline baseline = learnedBaseline();
  baseline.damping_to_mass_stddev = 0.05;
  baseline.friction = DryFriction{0.1, 0.0, 30.0, 0.0};
  const DryFriction rough{0.1, 0.0, 15.0, 0.0};
  EXPECT_EQ(reportAfter(baseline, estimate(6.5, rough)).level, HealthLevel::kOk);
  EXPECT_EQ(reportAfter(baseline, estimate(3.0, rough)).level, HealthLevel::kError);
  baseline.friction.reset();
  EXPECT_EQ(reportAfter(baseline, estimate(6.5, rough)).level, HealthLevel::kWarn);
}

TEST(HealthAssessment, SaysThatFrictionIsWhyItCannotTell) {
  Baseline baseline = learnedBaseline();
  baseline.friction = DryFriction{0.2, 0.0, 30.0, 0.0};
  const DryFriction rough{0.2, 0.0, 10.0, 0.0};
  const HealthReport report = reportAfter(baseline, estimate(4.0, rough));
  EXPECT_EQ(report.level, HealthLevel::kStale);
  EXPECT_TRUE(report.friction_doubt);
  EXPECT_NE(describe(report).find("dry friction"), std::string::npos) << describe(report);
  StrutEstimate vague = estimate(8.0, *baseline.friction);
  vague.damping_to_mass_stddev = 2.0;
  const HealthReport other = reportAfter(baseline, vague);
  EXPECT_EQ(other.level, HealthLevel::kStale);
  EXPECT_FALSE(other.friction_doubt);
}

TEST(BaselineLearner, TakesAnotherRoadForNoChangeOfTheStrut) {
  const DryFriction smooth{0.2, 0.01, 10.0, 0.0}, rough{0.2, 0.01, 5.0, 0.0};
  BaselineLearner learner(4000.0, 100.0);
  std::optional<Baseline> learned;
  for (int k = 0; k < 400; ++k)
    learned = learner.add(fromSeconds(k), k < 200 ? estimate(6.0, smooth) : estimate(5.0, rough), 10.0);
  ASSERT_TRUE(learned);
  EXPECT_NEAR(*learned->damping_to_mass, 5.5, 1e-9);
  EXPECT_NEAR(learned->friction->force, 0.2, 1e-9);
  EXPECT_NEAR(learned->friction->damping_gain, 7.5, 1e-9);
  EXPECT_NEAR(learned->friction->stddev, 0.01 * std::sqrt(2.0 * 100.0 / 4000.0), 1e-9);
}

}  // namespace
}  // namespace suspension_health_monitor
