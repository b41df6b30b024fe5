#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "monitor_settings.h"
#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

std::string complaint(const std::function<void(MonitorSettings&)>& change) {
  MonitorSettings options = liveOptions();
  change(options);
  try {
    SuspensionMonitor monitor(options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void expectWords(const std::string& message, const std::string& words) {
  EXPECT_NE(message.find(words), std::string::npos) << "got: \"" << message << '"';
}

TEST(MonitorSettings, HorizonIsTheNearestNumberOfSamples) {
  MonitorSettings options;
  EXPECT_EQ(options.horizonSamples(0.02), 30);  // 0.6 s if it is left out
  EXPECT_EQ(options.horizonSamples(0.005), 120);
  options.integration_horizon = 0.4;
  EXPECT_EQ(options.horizonSamples(0.02), 20);
  EXPECT_EQ(options.horizonSamples(0.03), 13);
  for (const double period : {1e-4, 1.0 / 333.0, 0.07, 1.0})  // what a number of samples makes of it
    for (const int samples : {5, 33, 1001}) {
      options.integration_horizon = samples * period;
      EXPECT_EQ(options.horizonSamples(period), samples);
    }
}

TEST(MonitorSettings, MonitorUsesTheHorizon) {
  MonitorSettings options = liveOptions();
  options.integration_horizon = 0.4;
  SuspensionMonitor monitor(options);
  EXPECT_EQ(monitor.horizonSamples(), 20);
  for (int k = 0; k < 90; ++k) {
    const CornerSample sample{k * std::chrono::milliseconds(20), 1.0 * (k * k % 7), 1.0 * (k * k % 5)};
    EXPECT_EQ(monitor.addSample(sample)->has_row, k >= options.samplesOfRow(0.02) - 1);
  }
}

TEST(MonitorSettings, PresetGivesWhatIsNotGiven) {
  OptionMap nothing, one_line{{"preset", "paper"}}, with_factor{{"preset", "paper"}, {"forgetting_factor", 0.97}};
  EXPECT_FALSE(takeMonitorOptions(nothing).memory);
  MonitorSettings slow;
  EXPECT_EQ(slow.presentMemory(), 2.0);
  slow.integration_horizon = 6.0;
  EXPECT_DOUBLE_EQ(slow.presentMemory(), 20.0);
  EXPECT_FALSE(takeMonitorOptions(nothing).forgetting_factor);
  const MonitorSettings paper = takeMonitorOptions(one_line), other = takeMonitorOptions(with_factor);
  EXPECT_EQ(paper.preset, "paper");
  EXPECT_EQ(paper.forgetting_factor, 0.98);
  EXPECT_EQ(paper.integration_horizon, 0.6);
  EXPECT_TRUE(paper.forgets_unexcited);
  EXPECT_EQ(other.forgetting_factor, 0.97);
  EXPECT_EQ(other.integration_rule, IntegrationRule::kTrapezoid);
  OptionMap wrong{{"preset", "papier"}};
  EXPECT_THROW(takeMonitorOptions(wrong), std::invalid_argument);
}

TEST(MonitorSettings, SettingsReachTheEstimators) {
  const MonitorSettings paper = paperOptions();
  EXPECT_EQ(paper.filter(0.02).horizon_samples, 30);
  EXPECT_EQ(paper.filter(0.02).period, 0.02);
  EXPECT_EQ(paper.filter(0.02).rule, IntegrationRule::kTrapezoid);
  EXPECT_EQ(paper.recursive(0).forgetting_factor, 0.98);
  EXPECT_EQ(paper.recursive(0).initial_variance_rule, InitialVariance::kAbsolute);
  EXPECT_EQ(paper.estimators.start_rows, 150);
  EXPECT_EQ(paper.estimators.small_divisor_rule, SmallDivisor::kAbsolute);
  EXPECT_EQ(paper.estimators.small_divisor, 1e-8);
  EXPECT_FALSE(paper.estimators.scale_covariance_at_start);
  const MonitorSettings live = liveOptions();
  EXPECT_EQ(live.recursive(0).initial_variance_rule, InitialVariance::kRelative);
  EXPECT_EQ(live.estimators.small_divisor_rule, SmallDivisor::kRelative);
}

TEST(MonitorSettings, DefaultsAreValidWithAndWithoutASamplePeriod) {
  EXPECT_NO_THROW(MonitorSettings{}.validate());
  EXPECT_NO_THROW(liveOptions().validate());
  EXPECT_NO_THROW(paperOptions().validate());
}

TEST(MonitorSettings, MonitorNeedsASamplePeriod) {
  expectWords(complaint([](MonitorSettings& o) { o.sample_period.reset(); }), "sample_period");
}

TEST(MonitorSettings, AreRefusedByNameAndValue) {
  expectWords(complaint([](MonitorSettings& o) { o.sample_period = -0.02; }), "sample_period = -0.02 [s], must be in");
  expectWords(complaint([](MonitorSettings& o) { o.forgetting_factor = 1.2; }),
              "forgetting_factor = 1.2 [-], must be in");
  expectWords(complaint([](MonitorSettings& o) { o.forgetting_factor = std::nan(""); }), "forgetting_factor = nan");
  expectWords(complaint([](MonitorSettings& o) { o.preset = "default paper"; }), "preset = \"default paper\"");
  expectWords(complaint([](MonitorSettings& o) { o.sprung_mass = 0.0; }), "sprung_mass = 0 [kg]");
}

TEST(MonitorSettings, ThatContradictEachOtherAreRefused) {
  expectWords(complaint([](MonitorSettings& o) { o.stiffness_error = 0.1; }), "health/stiffness_error = 0.1");
  const std::string message = complaint([](MonitorSettings& o) { o.integration_horizon = 0.008; });
  expectWords(message, "integration_horizon = 0.008");
  expectWords(message, "horizon_samples = 0, must be at least 1");
}

TEST(MonitorSettings, HorizonOfTooManySamplesIsRefusedNotShortened) {
  const std::string message =
      complaint([](MonitorSettings& o) { o.sample_period = 1e-3, o.integration_horizon = 1e3; });
  expectWords(message, "integration_horizon = 1000");
  expectWords(message, "at most 100000 samples");
}

}  // namespace
}  // namespace suspension_health_monitor
