// What users of the library do wrong, or throw.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "paper_drive.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/strut_monitor.h"

namespace suspension_health_monitor {
namespace {

/// @return what work() refuses, in its words.
template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(StrutMonitor, LosesNoReadingToASinkThatThrows) {
  struct Thrown {};
  const std::vector<CornerSample> drive = healthyPaperDrive(10.0, 0.024);
  int reports = 0;
  StrutMonitor monitor({}, [&](const MonitorReport&) {
    if (++reports % 20 == 7) throw Thrown();
  });
  for (const CornerSample& sample : drive)
    for (const Side side : {Side::kSprung, Side::kUnsprung}) {
      try {
        monitor.push(side, sample.stamp,
                     side == Side::kSprung ? sample.sprung_acceleration : sample.unsprung_acceleration);
      } catch (const Thrown&) {
      }
    }
  EXPECT_EQ(monitor.input().samples, drive.size());
  EXPECT_EQ(reports, static_cast<int>(drive.size()));
  EXPECT_TRUE(monitor.rejected().empty());
}

TEST(StrutMonitor, SaysOnceThatTheHorizonDoesNotFitTheMeasuredPeriod) {
  MonitorOptions options;
  options.integration_horizon = 0.004;  // less than half a sample
  StrutMonitor monitor(options);
  int refused = 0;
  std::string words;
  for (const CornerSample& sample : healthyPaperDrive(10.0, 0.024))
    for (const Side side : {Side::kSprung, Side::kUnsprung}) {
      const std::string said = refusal([&] { monitor.push(side, sample.stamp, sample.sprung_acceleration); });
      if (said.empty()) continue;
      words = said;
      ++refused;
    }
  EXPECT_EQ(refused, 1);
  EXPECT_EQ(words,
            "integration_horizon = 0.004 [s] with sample_period = 0.02 [s] makes horizon_samples = 0, must be at "
            "least 1");
  EXPECT_FALSE(monitor.samplePeriod());
}

TEST(MakeDrive, RefusesPeriodsThatNoSensorHas) {
  for (const double period : {1e10, 1e-12, 0.0, -0.01, std::nan("")})
    EXPECT_NE(refusal([&] {
                makeDrive(period, {1.0, 2.0}, {1.0, 2.0});
              }).find("must be in [1e-05, 10]"),
              std::string::npos)
        << period;
  EXPECT_EQ(refusal([&] { makeDrive(1e300, {}, {}); }), "period = 1e+300 [s], must be in [1e-05, 10]");
}

Drive paperDrive(Stamp first) {
  Drive drive;
  drive.samples = healthyPaperDrive(40.0, 0.024);
  for (CornerSample& sample : drive.samples) sample.stamp += first - drive.samples.front().stamp;
  return drive;
}

TEST(Diagnose, RefusesAHorizonThatNoMemoryHolds) {
  DiagnoseOptions options;
  options.horizon_samples = std::numeric_limits<int>::max();
  EXPECT_EQ(refusal([&] { diagnose({paperDrive(Stamp{})}, options); }),
            "horizon_samples = 2147483647, must be in [1, 100000]");
}

TEST(Identify, TakesTheFirstSampleOfDrivesThatBeginAtZero) {
  const std::vector<Drive> drives{paperDrive(Stamp{}), paperDrive(Stamp{})};
  IdentifyOptions options;
  options.horizon_samples = 30;
  const IdentifyResult result = identify(drives, options);
  EXPECT_EQ(result.samples, 2 * drives.front().samples.size());
  EXPECT_EQ(result.rejected.count("zero_stamp"), 0u);
  EXPECT_EQ(result.clock_jumps, 1u);
}

TEST(Identify, SaysOfTooFewSamplesThatThereAreTooFew) {
  Drive drive = paperDrive(Stamp{});
  drive.samples.resize(200);  // 4 s, of which three blocks need 4 s and a reading
  IdentifyOptions options;
  options.horizon_samples = 30;
  const IdentifyResult result = identify({drive}, options);
  EXPECT_FALSE(result.estimate.valid());
  EXPECT_EQ(result.estimate.doubt, EstimateDoubt::kNoRows);
}

}  // namespace
}  // namespace suspension_health_monitor
