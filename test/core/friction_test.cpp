// Dry friction beside the linear strut: estimated in blocks, and what health makes of it.
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
  EXPECT_TRUE(monitor.report().estimate.valid()) << describe(monitor.report().estimate.doubt);
  EXPECT_TRUE(monitor.report().estimate.friction);
  return monitor.report().estimate;
}

TEST(DryFriction, IsEstimatedWithItsSizeAndIsNoPartOfTheDamping) {
  for (const double size : {0.01, 0.03})
    for (const double friction : {0.1, 0.3}) {
      SCOPED_TRACE(std::to_string(size) + " m, " + std::to_string(friction) + " m/s^2");
      const StrutEstimate estimate = estimateOf({size, friction});
      EXPECT_NEAR(estimate.friction->force, friction, 0.15 * friction);
      EXPECT_NEAR(estimate.damping_to_mass, kB1, 0.02 * kB1);
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

TEST(DryFriction, IsEstimatedBesideGravityInOneSensor) {
  KnownStrut upright{0.01, 0.2};
  upright.body_offset = 9.81;
  EXPECT_NEAR(estimateOf(upright).friction->force, estimateOf({0.01, 0.2}).friction->force, 0.005);
}

Baseline learnedBaseline() {
  Baseline baseline;
  baseline.damping_to_mass = 8.0;
  baseline.stiffness_to_mass = 40.0;
  baseline.damping_to_mass_stddev = 0.3;
  baseline.friction = DryFriction{0.2, 0.01, 20.0, -0.002};
  baseline.learned = true;
  return baseline;
}

StrutEstimate estimate(double damping, const DryFriction& friction) {
  StrutEstimate of;
  of.damping_to_mass = damping;
  of.stiffness_to_mass = 40.0;
  of.damping_to_mass_stddev = 0.05;
  of.stiffness_to_mass_stddev = 0.4;
  of.window = 4.0;
  of.friction = friction;
  of.doubt = EstimateDoubt::kNone;
  return of;
}

// Both dampers as they act where friction has the mean gain of the two roads, 12.5: 0.2 m/s^2 is 2.5 1/s there.
TEST(ChangeFrom, IsThatOnARoadBetweenThePresentOneAndTheBaselines) {
  const Baseline baseline = learnedBaseline();
  const DryFriction now{0.1, 0.02, 5.0, -0.0005};
  const MeasuredChange changed = changeFrom(baseline, estimate(7.0, now));
  const Measured& damping = *changed.damping;
  EXPECT_NEAR(damping.value, std::log((7.0 + 1.25) / (8.0 + 2.5)), 1e-12);
  const auto variance = [](double stddev, double law, const DryFriction& friction) {
    return stddev * stddev - law * law + 2.0 * 12.5 * friction.damping_covariance + std::pow(12.5 * friction.stddev, 2);
  };
  // Of friction's law a tenth of what it acts as is not known; between both roads, half of what it changes by.
  const double learned = variance(0.3, 0.1 * 0.2 * 20.0, *baseline.friction);
  const double present = variance(0.05, 0.1 * 0.1 * 5.0, now) + std::pow((0.2 - 0.1) * (20.0 - 5.0) / 2.0, 2);
  EXPECT_NEAR(damping.stddev, std::sqrt(std::max(0.0, learned) / std::pow(10.5, 2) + present / std::pow(8.25, 2)),
              1e-9);
  EXPECT_TRUE(changed.is_mostly_friction);
  EXPECT_NEAR(changed.stiffness->value, 0.0, 1e-12);
  EXPECT_NEAR(changed.stiffness->stddev, 0.01, 1e-12);
}

TEST(ChangeFrom, IsThatOfTheDampersWhereFrictionIsNotKnown) {
  const Baseline baseline = learnedBaseline();
  Baseline without = baseline;
  without.friction.reset();
  StrutEstimate now = estimate(6.0, {});
  now.friction.reset();
  for (const Baseline& healthy : {baseline, without}) {
    const MeasuredChange changed = changeFrom(healthy, now);
    EXPECT_NEAR(changed.damping->value, std::log(6.0 / 8.0), 1e-12);
    EXPECT_NEAR(changed.damping->stddev, std::hypot(0.05 / 6.0, 0.3 / 8.0), 1e-12);
    EXPECT_FALSE(changed.is_mostly_friction);
  }
  EXPECT_FALSE(changeFrom({}, now).damping);
  now.damping_to_mass = -1.0;
  EXPECT_FALSE(changeFrom(baseline, now).damping);
}

HealthReport reportAfter(const Baseline& baseline, const StrutEstimate& of) {
  HealthThresholds options;
  options.confirm_time = 1.0;
  HealthAssessment assessment(options);
  assessment.setBaseline(baseline);
  for (int k = 0; k < 1000; ++k) assessment.update(fromSeconds(0.01 * k), of, true);
  return assessment.report();
}

// Where friction makes a part of the damping, the same damper has less of it on a rougher road: b1 + f g counts.
TEST(HealthAssessment, FrictionThatTheEstimateTookOutOfTheDampingIsNoLossOfDamping) {
  Baseline baseline = learnedBaseline();  // of a road on which all was taken for damping
  baseline.damping_to_mass_stddev = 0.05;
  baseline.friction = DryFriction{0.0, 0.0, 15.0, 0.0};
  const DryFriction found{0.1, 0.0, 15.0, 0.0};
  EXPECT_EQ(reportAfter(baseline, estimate(6.5, found)).level, HealthLevel::kOk);
  EXPECT_EQ(reportAfter(baseline, estimate(3.0, found)).level, HealthLevel::kError);
  baseline.friction.reset();
  EXPECT_EQ(reportAfter(baseline, estimate(6.5, found)).level, HealthLevel::kWarn);
}

TEST(HealthAssessment, SaysThatFrictionIsWhyItCannotTell) {
  Baseline baseline = learnedBaseline();
  baseline.friction = DryFriction{0.3, 0.0, 30.0, 0.0};
  const DryFriction rough{0.0, 0.0, 10.0, 0.0};
  const HealthReport report = reportAfter(baseline, estimate(12.0, rough));
  EXPECT_EQ(report.level, HealthLevel::kStale);
  EXPECT_TRUE(report.friction_doubt);
  EXPECT_NE(describe(report).find("dry friction"), std::string::npos) << describe(report);
  StrutEstimate vague = estimate(8.0, *baseline.friction);
  vague.damping_to_mass_stddev = 2.0;
  const HealthReport other = reportAfter(baseline, vague);
  EXPECT_EQ(other.level, HealthLevel::kStale);
  EXPECT_FALSE(other.friction_doubt);
}

// In both halves b1 + 7.5 f is 7.
TEST(BaselineLearner, TakesWhatFrictionIsTakenForForNoChangeOfTheStrut) {
  BaselineLearner learner(100.0);
  std::optional<Baseline> learned;
  for (int k = 0; k < 100; ++k)
    learned = learner.add(
        fromSeconds(k),
        k < 50 ? estimate(5.5, DryFriction{0.2, 0.01, 10.0, 0.0}) : estimate(6.25, DryFriction{0.1, 0.01, 5.0, 0.0}),
        1.0);
  ASSERT_TRUE(learned);
  EXPECT_NEAR(*learned->damping_to_mass, 5.875, 1e-9);
  EXPECT_NEAR(learned->friction->force, 0.15, 1e-9);
  EXPECT_NEAR(learned->friction->damping_gain, 7.5, 1e-9);
  EXPECT_NEAR(learned->friction->stddev, 0.01 / 5.0, 1e-9);
}

}  // namespace
}  // namespace suspension_health_monitor
