// A monitor with effects in its model: what it finds in drives whose strut has them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "hidden_effect.h"
#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kCarB1 = 6.0, kCarB0 = 63.3;  // golden_car
constexpr double kNoise = 0.03;                // [m/s^2]
constexpr std::size_t kDelay = FreeRun::kDelay;
// Samples of the first row.
const auto kRow = static_cast<std::size_t>(LinearIntegralFilter::window(2, {60, 0.01, IntegrationRule::kBandLimited}));

MonitorSettings carMonitor(double forgetting_factor) {
  MonitorSettings options;
  options.sample_period = 0.01;
  options.forgetting_factor = forgetting_factor;
  return options;
}

ActiveEffect active(const std::string& name, double coefficient, std::vector<double> shapes = {}) {
  return {findEffect(forceEffects(), name), coefficient, std::move(shapes)};
}

/// A car's drive with an effect, and the effect as it is there.
struct HiddenDrive {
  HiddenDrive(const std::string& name, const std::vector<double>& shapes, double duration = 60.0)
      : options(carDrive(duration, kNoise)), effect(hiddenEffect(options, name, shapes, 0.15)) {
    generate();
  }
  HiddenDrive(ActiveEffect hidden, double duration) : options(carDrive(duration, kNoise)), effect(std::move(hidden)) {
    generate();
  }

  ActiveEffect unknown() const { return {effect.effect, 0.0, effect.shapes}; }

  /// Rms error of the true model, driven by the measured wheel, over the monitor's window at the end.
  double floor() const {
    FreeRun truth(0.01);
    EXPECT_TRUE(truth.trySetModel(kCarB1, kCarB0));
    truth.setEffects({effect});
    RunningComparison comparison(0.999);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const auto predicted = truth.push(samples[k].unsprung_acceleration, toSeconds(samples[k].stamp));
      if (predicted && truth.settled()) comparison.add(samples[k - kDelay].sprung_acceleration, *predicted);
    }
    return comparison.rmse();
  }

  SimulationOptions options;
  ActiveEffect effect;
  std::vector<CornerSample> samples;

 private:
  void generate() {
    options.hidden = {effect};
    samples = simulate(options);
  }
};

void addAll(SuspensionMonitor& monitor, const std::vector<CornerSample>& samples, Stamp later = {},
            double gravity = 0.0) {
  for (CornerSample sample : samples) {
    sample.stamp += later;
    sample.sprung_acceleration += gravity;
    sample.unsprung_acceleration += gravity;
    monitor.addSample(sample);
  }
}

// A memory of 1000 rows, ten seconds. White residuals promise the coefficients to 1 to 4 %; neighbouring rows share
// their noise, which makes it two to three times as much, and noise in the regressors adds a bias of 1 to 4 %.
void expectRecovered(const HiddenDrive& drive) {
  SCOPED_TRACE(drive.effect.effect.name);
  SuspensionMonitor monitor(carMonitor(0.999));
  monitor.setEffects({drive.unknown()});
  addAll(monitor, drive.samples);
  const double truth = drive.effect.coefficient;
  for (const StrutEstimate& estimate : {monitor.report().ls, monitor.report().la}) {
    EXPECT_TRUE(estimate.valid());
    ASSERT_EQ(estimate.num_effects, 1u);
    EXPECT_NEAR(estimate.coefficients[0], truth, 0.12 * truth);
    EXPECT_GT(estimate.coefficient_stddevs[0], 0.001 * truth);
    EXPECT_LT(estimate.coefficient_stddevs[0], 0.06 * truth);
    EXPECT_NEAR(estimate.damping_to_mass, kCarB1, 0.05 * kCarB1);
    EXPECT_NEAR(estimate.stiffness_to_mass, kCarB0, 0.07 * kCarB0);
  }
}

TEST(LiveEffects, CoefficientsOfStaticLawsAreRecovered) {
  expectRecovered({"progressive_spring", {3.0}});
  expectRecovered({"coulomb_friction", {0.05}});
  expectRecovered({"quadratic_damping", {}});
  expectRecovered({"asymmetric_damping", {}});
}

TEST(LiveEffects, CoefficientOfALawWithMemoryIsRecovered) {
  expectRecovered({active("hysteresis", 0.4, {0.003}), 60.0});
}

// t v and v look alike over seconds: this takes a memory of 50 s.
TEST(LiveEffects, DriftIsRecoveredWithALongMemory) {
  const HiddenDrive drive("damping_drift", {}, 120.0);
  SuspensionMonitor monitor(carMonitor(0.9998));
  monitor.setEffects({drive.unknown()});
  addAll(monitor, drive.samples);
  const StrutEstimate& la = monitor.report().la;
  EXPECT_TRUE(la.valid());
  EXPECT_NEAR(la.coefficients[0], drive.effect.coefficient, 0.1 * drive.effect.coefficient);
  const double damping_at_the_end = kCarB1 + 120.0 * drive.effect.coefficient;
  EXPECT_NEAR(la.damping_to_mass + 120.0 * la.coefficients[0], damping_at_the_end, 0.03 * damping_at_the_end);
}

TEST(LiveEffects, ErrorFallsNearTheFloorWhileThatOfThePlainModelStays) {
  for (const auto& [name, shapes] : std::vector<std::pair<std::string, std::vector<double>>>{
           {"quadratic_damping", {}}, {"progressive_spring", {3.0}}, {"bump_stop", {0.01}}}) {
    SCOPED_TRACE(name);
    const HiddenDrive drive(name, shapes);
    SuspensionMonitor monitor(carMonitor(0.99)), plain(carMonitor(0.99));
    for (std::size_t k = 0; k < drive.samples.size(); ++k) {
      if (k == 2000) monitor.setEffects({drive.unknown()});
      monitor.addSample(drive.samples[k]);
      plain.addSample(drive.samples[k]);
    }
    const ComparisonReport &with = monitor.report().comparison, &without = plain.report().comparison;
    EXPECT_EQ(with.base_rmse, without.rmse);
    EXPECT_EQ(with.base_fit_percent, without.fit_percent);
    // Of the plain model's error e^-4 is still in the window of 10 s.
    EXPECT_LT(with.rmse, std::hypot(1.2 * drive.floor(), std::exp(-2.0) * without.rmse));
    EXPECT_GT(with.rmse, 0.9 * drive.floor());
    EXPECT_GT(without.rmse, 2.0 * drive.floor());
    EXPECT_GT(with.fit_percent, with.base_fit_percent);
  }
}

TEST(LiveEffects, EstimatesCarryOver) {
  const HiddenDrive drive("quadratic_damping", {}, 30.0);
  SuspensionMonitor monitor(carMonitor(0.99)), plain(carMonitor(0.99));
  addAll(monitor, drive.samples);
  addAll(plain, drive.samples);
  const StrutEstimate before = monitor.report().la;
  monitor.setEffects({active("quadratic_damping", 1.5)});
  const StrutEstimate after = monitor.report().la;
  EXPECT_EQ(after.damping_to_mass, before.damping_to_mass);
  EXPECT_EQ(after.stiffness_to_mass, before.stiffness_to_mass);
  EXPECT_NEAR(after.stiffness_to_mass_stddev / before.stiffness_to_mass_stddev, 1.0, 0.1);
  EXPECT_EQ(after.coefficients[0], 1.5);
  EXPECT_FALSE(after.valid());

  const Stamp again = drive.samples.back().stamp + std::chrono::milliseconds(10);
  addAll(monitor, drive.samples, again);
  addAll(plain, drive.samples, again);
  const StrutEstimate found = monitor.report().la;
  monitor.setEffects({active("asymmetric_spring", 0.2), active("quadratic_damping", 77.0)});
  const StrutEstimate more = monitor.report().la;
  EXPECT_EQ(more.damping_to_mass, found.damping_to_mass);
  EXPECT_EQ(more.coefficients[0], 0.2);
  EXPECT_EQ(more.coefficients[1], found.coefficients[0]);  // it stays: no start value
  // Standard deviations of a report are up to 31 rows old, a third of the memory; those after setEffects() are new.
  EXPECT_NEAR(more.coefficient_stddevs[1] / found.coefficient_stddevs[0], 1.0, 0.15);
  EXPECT_NEAR(more.damping_to_mass_stddev / found.damping_to_mass_stddev, 1.0, 0.1);

  monitor.setEffects({});
  EXPECT_EQ(monitor.report().la.num_effects, 0u);
  EXPECT_EQ(monitor.report().la.damping_to_mass, plain.report().la.damping_to_mass);
  EXPECT_EQ(monitor.report().comparison.rmse, plain.report().comparison.rmse);
}

TEST(LiveEffects, ReportsAreThoseOfASampleThatTheFreeRunHasReached) {
  const HiddenDrive drive("quadratic_damping", {}, 10.0);
  SuspensionMonitor monitor(carMonitor(0.99));
  Stamp last{-1};
  for (std::size_t k = 0; k < drive.samples.size(); ++k) {
    if (k == 500) monitor.setEffects({drive.unknown()});
    const MonitorReport* report = monitor.addSample(drive.samples[k]);
    ASSERT_EQ(report == nullptr, k >= 500 && k < 500 + kDelay) << k;
    if (report == nullptr) continue;
    ASSERT_GT(report->stamp, last);
    last = report->stamp;
    if (k < 500) continue;
    const CornerSample& sample = drive.samples[k - kDelay];
    ASSERT_EQ(report->stamp, sample.stamp);
    ASSERT_EQ(report->measured, sample.sprung_acceleration);
    ASSERT_EQ(report->comparison.stamp, sample.stamp);
    ASSERT_EQ(report->comparison.measured, sample.sprung_acceleration);
    ASSERT_EQ(report->has_row, k >= 499 + kRow);
  }
}

TEST(LiveEffects, GapEmptiesFilterAndFreeRunAndTheModelIsKept) {
  const HiddenDrive drive("quadratic_damping", {}, 30.0);
  SuspensionMonitor monitor(carMonitor(0.99));
  monitor.setEffects({drive.unknown()});
  addAll(monitor, drive.samples);
  const StrutEstimate before = monitor.report().la;
  ASSERT_TRUE(before.valid());
  const Stamp later = drive.samples.back().stamp + std::chrono::seconds(3);
  for (std::size_t k = 0; k < 1000; ++k) {
    CornerSample sample = drive.samples[k];
    sample.stamp += later;
    const MonitorReport* report = monitor.addSample(sample);
    ASSERT_EQ(report == nullptr, k < kDelay);
    // The run begins with its 24th sample, and fills the filter.
    ASSERT_EQ(monitor.report().has_row && report != nullptr, k >= 2 * kDelay - 2 + kRow) << k;
    if (report == nullptr || report->has_row) continue;
    ASSERT_EQ(report->la.coefficients[0], before.coefficients[0]);
    ASSERT_FALSE(report->la.valid());
    ASSERT_FALSE(report->comparison.predicted);
  }
  EXPECT_TRUE(monitor.report().la.valid());
  EXPECT_EQ(monitor.input().gaps, 1u);
}

TEST(LiveEffects, CentimetresForMetresChangeTheUnitsOnly) {
  const HiddenDrive drive("quadratic_damping", {}, 30.0);
  constexpr double kGain = 100.0;
  SuspensionMonitor metres(carMonitor(0.99)), centimetres(carMonitor(0.99));
  // Units of c: 1/m and m/s^2.
  metres.setEffects({active("quadratic_damping", 1.0), active("coulomb_friction", 0.1, {0.05})});
  centimetres.setEffects(
      {active("quadratic_damping", 1.0 / kGain), active("coulomb_friction", 0.1 * kGain, {0.05 * kGain})});
  for (CornerSample sample : drive.samples) {
    metres.addSample(sample);
    sample.sprung_acceleration *= kGain;
    sample.unsprung_acceleration *= kGain;
    centimetres.addSample(sample);
  }
  const MonitorReport &m = metres.report(), &cm = centimetres.report();
  ASSERT_TRUE(m.la.valid() && cm.la.valid());
  for (const auto& [a, b] : {std::pair(cm.ls, m.ls), std::pair(cm.la, m.la)}) {
    EXPECT_NEAR(a.damping_to_mass / b.damping_to_mass, 1.0, 1e-7);
    EXPECT_NEAR(a.stiffness_to_mass / b.stiffness_to_mass, 1.0, 1e-7);
    EXPECT_NEAR(a.coefficients[0] * kGain / b.coefficients[0], 1.0, 1e-6);
    EXPECT_NEAR(a.coefficient_stddevs[1] / kGain / b.coefficient_stddevs[1], 1.0, 1e-6);
  }
  EXPECT_NEAR(cm.comparison.rmse / kGain / m.comparison.rmse, 1.0, 1e-7);
  EXPECT_NEAR(cm.comparison.base_fit_percent, m.comparison.base_fit_percent, 1e-5);
}

TEST(LiveEffects, ParkedVehicleIsSurvived) {
  const HiddenDrive drive("quadratic_damping", {}, 30.0);
  SuspensionMonitor monitor(carMonitor(0.99));
  monitor.setEffects({drive.unknown(), active("bump_stop", 10.0, {0.02})});
  addAll(monitor, drive.samples, {}, 9.81);
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, kNoise);
  Stamp stamp = drive.samples.back().stamp;
  for (int k = 0; k < 100000; ++k) {
    stamp += std::chrono::milliseconds(10);
    const MonitorReport& report = *monitor.addSample({stamp, 9.81 + noise(engine), 9.81 + noise(engine)});
    ASSERT_TRUE(std::isfinite(report.la.coefficients[0]) && std::isfinite(report.la.coefficient_stddevs[1])) << k;
    ASSERT_FALSE(k > 8000 && (report.la.valid() || report.estimate.valid())) << k;
  }
  addAll(monitor, drive.samples, stamp + std::chrono::milliseconds(10), 9.81);
  EXPECT_TRUE(monitor.report().la.valid());
  EXPECT_NEAR(monitor.report().la.damping_to_mass, kCarB1, 0.1 * kCarB1);
  EXPECT_NEAR(monitor.report().la.coefficients[0], drive.effect.coefficient, 0.3 * drive.effect.coefficient);
  EXPECT_LT(monitor.report().comparison.rmse, 1.5 * kNoise);
}

// A coefficient that makes the free run leave all bounds is dropped, and found anew.
TEST(LiveEffects, MonitorComesBackFromARunaway) {
  const HiddenDrive drive("quadratic_damping", {}, 60.0);
  SuspensionMonitor monitor(carMonitor(0.99));
  monitor.setEffects({active("quadratic_damping", -500.0)});
  for (const CornerSample& sample : drive.samples) {
    const MonitorReport* report = monitor.addSample(sample);
    if (report == nullptr || !(report->la.effective_rows > 0.0)) continue;
    ASSERT_TRUE(std::isfinite(report->la.coefficients[0]));
    ASSERT_TRUE(std::isfinite(report->la.damping_to_mass));
  }
  EXPECT_TRUE(monitor.report().la.valid());
  EXPECT_NEAR(monitor.report().la.coefficients[0], drive.effect.coefficient, 0.3 * drive.effect.coefficient);
}

TEST(LiveEffects, WhatCannotBeModelledIsRefusedAndChangesNothing) {
  SuspensionMonitor monitor(carMonitor(0.99));
  monitor.setEffects({active("quadratic_damping", 1.0)});
  EXPECT_THROW(monitor.setEffects({active("bump_stop", 1.0)}), std::invalid_argument);  // no gap given
  EXPECT_THROW(monitor.setEffects({active("asymmetric_spring", std::nan(""))}), std::invalid_argument);
  ASSERT_EQ(monitor.effects().size(), 1u);
  EXPECT_EQ(monitor.effects()[0].effect.name, "quadratic_damping");
}

// The coefficient alone would stand beside a b1 and b0 that hold a part of the effect.
TEST(LiveEffects, StartedWithWhatAFitFoundTheErrorFallsAtOnce) {
  const HiddenDrive drive("quadratic_damping", {}, 60.0);
  SuspensionMonitor monitor(carMonitor(0.999)), plain(carMonitor(0.999));
  double square = 0.0, plain_square = 0.0;
  for (std::size_t k = 0; k < 4200; ++k) {
    if (k == 4000) monitor.setEffects({drive.effect}, LinearStrut{kCarB1, kCarB0});
    const MonitorReport* started = monitor.addSample(drive.samples[k]);
    const MonitorReport* base = plain.addSample(drive.samples[k]);
    if (k < 4000 || started == nullptr || !started->comparison.predicted || !base->comparison.predicted) continue;
    square += std::pow(started->comparison.measured - *started->comparison.predicted, 2);
    plain_square += std::pow(base->comparison.measured - *base->comparison.predicted, 2);
  }
  EXPECT_GT(square, 0.0);
  EXPECT_LT(square, 0.5 * plain_square);  // within two seconds
}

// A lightly damped strut swings for seconds from wherever the free run starts: columns of that time, or of another
// strut, would lead the estimate astray, which then leads the free run.
TEST(LiveEffects, OfAModelWithItsStrutEveryEstimateIsRight) {
  constexpr double kLight = 1.0;  // b1 [1/s]
  SimulationOptions options = carDrive(60.0, 0.01);
  options.damping_to_mass = kLight;
  options.stiffness_to_mass = kCarB0;
  options.hidden = {active("hysteresis", 0.4, {0.003})};
  SuspensionMonitor monitor(carMonitor(0.999));
  monitor.setEffects(options.hidden, LinearStrut{kLight, kCarB0});
  int valid = 0;
  for (const CornerSample& sample : simulate(options)) {
    monitor.addSample(sample);
    const StrutEstimate& estimate = monitor.report().estimate;
    if (!estimate.valid()) continue;
    ++valid;
    ASSERT_NEAR(estimate.damping_to_mass, kLight, 4.0 * estimate.damping_to_mass_stddev) << toSeconds(sample.stamp);
    ASSERT_NEAR(estimate.stiffness_to_mass, kCarB0, 4.0 * estimate.stiffness_to_mass_stddev) << toSeconds(sample.stamp);
  }
  EXPECT_GT(valid, 1000);
}

}  // namespace
}  // namespace suspension_health_monitor
