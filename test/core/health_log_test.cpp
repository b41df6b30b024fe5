// What a monitor says over recordings: times add up, silence is not healthy, and the log is that of the monitor itself.
#include "suspension_health_monitor/internal/wording/health_log.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/strut_monitor.h"

namespace suspension_health_monitor {
namespace {

const std::vector<std::string> kSensors{"/body", "/wheel"};
constexpr Stamp kTimeout = std::chrono::seconds(2), kPeriod = std::chrono::milliseconds(100);

MonitorReport reportAt(double seconds, HealthLevel level, bool early = false) {
  MonitorReport report;
  report.stamp = fromSeconds(seconds);
  report.health.level = level;
  report.health.early_warning = early;
  return report;
}

/// One of both sensors that is recorded when it is measured.
void addReading(HealthLog& log, Stamp stamp) {
  log.addReading(0, stamp, stamp);
  log.addReading(1, stamp, stamp);
}

/// Readings and reports of one level every kPeriod from `from` up to `to` [s].
void drive(HealthLog& log, double from, double to, HealthLevel level, bool early = false) {
  for (Stamp stamp = fromSeconds(from); stamp <= fromSeconds(to); stamp += kPeriod) {
    addReading(log, stamp);
    MonitorReport report = reportAt(0.0, level, early);
    report.stamp = stamp;
    log.addReport(report);
  }
}

double secondsOf(const HealthLog& log, HealthLevel level) { return toSeconds(log.duration(level)); }

double sum(const HealthLog& log) {
  return secondsOf(log, HealthLevel::kOk) + secondsOf(log, HealthLevel::kWarn) + secondsOf(log, HealthLevel::kError) +
         secondsOf(log, HealthLevel::kStale);
}

std::string levels(const HealthLog& log) {
  std::string names;
  for (const HealthMoment& event : log.events()) names += std::string(nameOf(event.level)) + ' ';
  return names;
}

TEST(LevelTimes, AReportHoldsUntilTheNextOrTheTimeOut) {
  LevelTimes times(kTimeout);
  int gone_stale = 0;
  const auto pass = [&](double seconds) { times.pass(fromSeconds(seconds), [&] { ++gone_stale; }); };
  pass(5.0);  // nothing is known yet
  times.report(HealthLevel::kWarn);
  pass(1.5);
  EXPECT_EQ(times.level(), HealthLevel::kWarn);
  times.report(HealthLevel::kOk);
  pass(0.5);
  pass(4.0);  // 1.5 s of which are known
  EXPECT_EQ(times.level(), HealthLevel::kStale);
  pass(1.0);
  EXPECT_EQ(gone_stale, 1);
  EXPECT_EQ(times.of(HealthLevel::kWarn), fromSeconds(1.5));
  EXPECT_EQ(times.of(HealthLevel::kOk), fromSeconds(2.0));
  EXPECT_EQ(times.of(HealthLevel::kStale), fromSeconds(5.0 + 2.5 + 1.0));
  EXPECT_EQ(times.elapsed(), fromSeconds(12.0));
}

TEST(HealthLog, EachLevelHoldsUntilTheNext) {
  HealthLog log(kTimeout, kSensors);
  drive(log, 10.0, 14.9, HealthLevel::kStale);
  drive(log, 15.0, 19.9, HealthLevel::kOk);
  drive(log, 20.0, 22.9, HealthLevel::kWarn);
  drive(log, 23.0, 30.0, HealthLevel::kError);
  log.finishRecording();
  EXPECT_EQ(levels(log), "STALE OK WARN ERROR ");
  EXPECT_DOUBLE_EQ(secondsOf(log, HealthLevel::kStale), 5.0);
  EXPECT_DOUBLE_EQ(secondsOf(log, HealthLevel::kOk), 5.0);
  EXPECT_DOUBLE_EQ(secondsOf(log, HealthLevel::kWarn), 3.0);
  EXPECT_DOUBLE_EQ(secondsOf(log, HealthLevel::kError), 7.0);
  EXPECT_DOUBLE_EQ(toSeconds(log.elapsed()), 20.0);
  EXPECT_EQ(log.events()[2].time, fromSeconds(20.0));
  EXPECT_EQ(log.events()[2].elapsed, fromSeconds(10.0));
  EXPECT_EQ(log.latest().level, HealthLevel::kError);
  EXPECT_EQ(log.latest().time, fromSeconds(30.0));
}

TEST(HealthLog, TheLastReasonThatLastedIsToldBesideTheFirst) {
  HealthLog log(kTimeout, kSensors);
  for (int k = 1; k <= 600; ++k) {
    MonitorReport report = reportAt(0.1 * k, HealthLevel::kStale);
    report.health.doubt = k < 50 ? EstimateDoubt::kNoRows : EstimateDoubt::kNotExplained;
    if (k % 100 == 77) report.health.doubt = EstimateDoubt::kFewRows;  // for a moment
    if (k >= 200) report.health.doubt = EstimateDoubt::kNotExplained;
    addReading(log, report.stamp);
    log.addReport(report);
    if (k == 400) {
      EXPECT_EQ(log.events()[0].message, "cannot tell: " + describe(EstimateDoubt::kNoRows));
    }
  }
  ASSERT_EQ(levels(log), "STALE ");
  EXPECT_EQ(log.events()[0].message, "cannot tell: " + describe(EstimateDoubt::kNoRows) +
                                         "; later: cannot tell: " + describe(EstimateDoubt::kNotExplained));
}

TEST(HealthLog, WhatIsKnownIsOldAfterTheTimeout) {
  HealthLog log(kTimeout, kSensors);
  drive(log, 0.1, 10.0, HealthLevel::kOk);
  drive(log, 25.0, 30.0, HealthLevel::kOk);
  log.finishRecording();
  EXPECT_EQ(levels(log), "STALE OK STALE OK ");
  EXPECT_EQ(log.events()[2].time, fromSeconds(12.0));
  EXPECT_EQ(log.events()[2].message.find("cannot tell: no reading accepted for 15 s; before: "), 0U);
  EXPECT_EQ(log.events()[3].time, fromSeconds(25.0));
  EXPECT_DOUBLE_EQ(secondsOf(log, HealthLevel::kStale), 13.0);
  EXPECT_DOUBLE_EQ(sum(log), 29.9);
}

TEST(HealthLog, ASensorThatIsSilentWhileTheOtherGoesOnIsNamed) {
  HealthLog log(kTimeout, kSensors);
  drive(log, 0.1, 10.0, HealthLevel::kOk);
  for (double time = 10.1; time < 25.05; time += 0.1) log.addReading(0, fromSeconds(time), fromSeconds(time));
  drive(log, 25.1, 30.0, HealthLevel::kOk);
  for (double time = 30.1; time < 40.05; time += 0.1) log.addReading(1, fromSeconds(time), fromSeconds(time));
  log.finishRecording();
  EXPECT_EQ(levels(log), "STALE OK STALE OK STALE ");
  EXPECT_EQ(log.events()[2].message.find("cannot tell: no reading accepted for 15 s, /wheel is silent; before: "), 0U);
  EXPECT_EQ(log.events()[4].message.find("cannot tell: no reading accepted for 10 s, /body is silent; before: "), 0U);
  EXPECT_EQ(log.latest().message, log.events()[4].message);
  EXPECT_NEAR(secondsOf(log, HealthLevel::kStale), 13.1 + 8.0, 1e-6);
}

TEST(HealthLog, ReportsThatAreLateCostNoTime) {
  HealthLog log(kTimeout, kSensors);
  for (double time = 5.0; time < 65.05; time += 0.1) {
    log.addReading(0, fromSeconds(time), fromSeconds(time));
    if (time < 35.0) log.addReading(1, fromSeconds(time), fromSeconds(time));
    if (time > 7.0 && time < 35.0) log.addReport(reportAt(time - 1.2, HealthLevel::kOk));
  }
  log.finishRecording();
  EXPECT_NEAR(toSeconds(log.elapsed()), 60.0, 1e-6);
  EXPECT_NEAR(sum(log), 60.0, 1e-6);
  EXPECT_EQ(levels(log), "STALE OK STALE ");
}

TEST(HealthLog, AGapShorterThanTheTimeoutChangesNothing) {
  HealthLog log(kTimeout, kSensors);
  drive(log, 1.0, 10.0, HealthLevel::kWarn);
  drive(log, 12.0, 15.0, HealthLevel::kWarn);
  log.finishRecording();
  EXPECT_EQ(levels(log), "STALE WARN ");
  EXPECT_DOUBLE_EQ(secondsOf(log, HealthLevel::kWarn), 14.0);
}

TEST(HealthLog, ReadingsWithoutReportsAreTimeToo) {
  HealthLog log(kTimeout, kSensors);
  for (double time = 1.0; time < 5.0; time += 0.1) addReading(log, fromSeconds(time));
  drive(log, 5.0, 10.0, HealthLevel::kOk);
  for (double time = 10.1; time < 20.05; time += 0.1) addReading(log, fromSeconds(time));
  log.finishRecording();
  EXPECT_EQ(levels(log), "STALE OK STALE ");
  EXPECT_NEAR(secondsOf(log, HealthLevel::kOk), 7.0, 1e-6);
  EXPECT_NEAR(secondsOf(log, HealthLevel::kStale), 4.0 + 8.0, 1e-6);
  EXPECT_EQ(log.latest().level, HealthLevel::kStale);
  EXPECT_EQ(log.latest().message, log.events().back().message);
}

TEST(HealthLog, NoTimePassesBetweenRecordingsWhicheverIsTheOlder) {
  for (const double second : {1e9, 1.0}) {
    HealthLog log(kTimeout, kSensors);
    drive(log, 1e6, 1e6 + 10.0, HealthLevel::kOk);
    log.finishRecording();
    addReading(log, fromSeconds(second));
    log.addReport(reportAt(1e6 + 10.05, HealthLevel::kOk));  // that was still on its way
    drive(log, second, second + 10.0, HealthLevel::kOk);
    log.finishRecording();
    EXPECT_EQ(levels(log), "STALE OK ");
    EXPECT_DOUBLE_EQ(sum(log), 20.0);
  }
}

TEST(HealthLog, AClockThatGoesBackTakesNoTime) {
  HealthLog log(kTimeout, kSensors);
  drive(log, 100.0, 110.0, HealthLevel::kOk);
  drive(log, 50.0, 55.0, HealthLevel::kOk);
  log.finishRecording();
  EXPECT_EQ(levels(log), "STALE OK ");
  EXPECT_DOUBLE_EQ(toSeconds(log.elapsed()), 15.0);
}

TEST(HealthLog, OneStampOfAnotherAgeCostsNothing) {
  for (const double wild : {0.0, 3.0, 4e9}) {
    HealthLog log(kTimeout, kSensors);
    drive(log, 1000.0, 1010.0, HealthLevel::kOk);
    addReading(log, fromSeconds(wild));
    drive(log, 1010.1, 1020.0, HealthLevel::kOk);
    log.finishRecording();
    EXPECT_DOUBLE_EQ(toSeconds(log.elapsed()), 20.0) << wild;
  }
}

TEST(HealthLog, SilenceIsNoLongerThanTheRecording) {
  HealthLog log(kTimeout, kSensors);
  Stamp recorded = fromSeconds(5.0);
  const auto run = [&](double from, double to) {
    for (Stamp stamp = fromSeconds(from); stamp <= fromSeconds(to); stamp += kPeriod, recorded += kPeriod) {
      for (const std::size_t sensor : {0U, 1U}) log.addReading(sensor, stamp, recorded);
      MonitorReport report = reportAt(0.0, HealthLevel::kOk);
      report.stamp = stamp;
      log.addReport(report);
    }
  };
  run(100.0, 110.0);
  run(1.7e9, 1.7e9 + 10.0);  // the clock was set
  recorded += std::chrono::seconds(20);
  run(1.7e9 + 31.0, 1.7e9 + 40.0);
  log.addReading(0, fromSeconds(4e9), recorded);  // a wrong stamp at the very end
  log.finishRecording();
  EXPECT_NEAR(toSeconds(log.elapsed()), 10.0 + 0.1 + 10.0 + 20.1 + 9.0 + 0.1, 1e-6);
  EXPECT_DOUBLE_EQ(sum(log), toSeconds(log.elapsed()));
  EXPECT_EQ(levels(log), "STALE OK STALE OK ");
}

TEST(HealthLog, EarlyWarningsAreCountedWhenTheyBegin) {
  HealthLog log(kTimeout, kSensors);
  drive(log, 1.0, 5.0, HealthLevel::kOk);
  drive(log, 5.1, 8.0, HealthLevel::kOk, true);
  drive(log, 8.1, 9.0, HealthLevel::kOk);
  drive(log, 9.1, 12.0, HealthLevel::kWarn, true);
  log.finishRecording();
  ASSERT_EQ(log.earlyWarnings().size(), 1U) << "beside a raised level it is none";
  EXPECT_EQ(log.earlyWarnings()[0].time, fromSeconds(5.1));
  EXPECT_EQ(log.count(HealthLevel::kOk), 1U);
  EXPECT_EQ(log.count(HealthLevel::kWarn), 1U);
}

TEST(HealthLog, ASecondHasOneRowAndEveryChangeToo) {
  std::vector<double> rows;
  HealthLog log(kTimeout, kSensors, [&](const HealthMoment& moment) { rows.push_back(toSeconds(moment.time)); });
  drive(log, 10.0, 12.4, HealthLevel::kStale);
  drive(log, 12.5, 15.0, HealthLevel::kOk);
  log.finishRecording();
  EXPECT_EQ(rows, (std::vector<double>{10.0, 11.0, 12.0, 12.5, 13.0, 14.0, 15.0}));
}

TEST(HealthLog, IsTheMonitorsOwnLevelsAndSentences) {
  constexpr double period = 0.02;
  MonitorOptions options;
  options.sample_period = period;
  options.alignment = "paired";
  options.nominal_damping_to_mass = 3.0;
  options.nominal_stiffness_to_mass = 13.8;
  std::vector<std::string> said, written;
  HealthLevel level = HealthLevel::kStale;
  HealthLog log(kTimeout, kSensors);
  StrutMonitor monitor(options, [&](const MonitorReport& report) {
    if (report.health.level != level)
      said.push_back(std::to_string(report.stamp.count()) + nameOf(report.health.level) + describe(report.health));
    level = report.health.level;
    log.addReport(report);
  });
  std::mt19937 engine(7);
  std::normal_distribution<double> push(0.0, 3.0);
  double travel = 0.0, rate = 0.0, wheel = 0.0;
  for (int i = 0; i < 9000; ++i) {  // from 60 s on the damper has lost half
    const double damping = i < 3000 ? 3.0 : 1.5;
    for (int step = 0; step < 20; ++step) {
      wheel += 0.02 * (10.0 * push(engine) - wheel);
      rate += 0.001 * (wheel - damping * rate - 13.8 * travel);
      travel += 0.001 * rate;
    }
    const Stamp stamp = fromSeconds(100.0 + i * period);
    addReading(log, stamp);
    monitor.push(Side::kSprung, stamp, 9.81 + damping * rate + 13.8 * travel);
    monitor.push(Side::kUnsprung, stamp, 9.81 + wheel);
  }
  log.finishRecording();
  for (const HealthMoment& event : log.events())
    written.push_back(std::to_string(event.time.count()) + nameOf(event.level) + event.message);
  ASSERT_GE(log.count(HealthLevel::kError), 1U);
  written.erase(written.begin());  // the STALE that all begins with is no change of the monitor's
  EXPECT_EQ(written, said);
}

}  // namespace
}  // namespace suspension_health_monitor
