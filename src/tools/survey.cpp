#include "survey.h"

#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "../ros/conversions.h"
#include "bag_samples.h"
#include "errors.h"
#include "suspension_health_monitor/identification/horizon_survey.h"
#include "suspension_health_monitor/signal/continuity.h"
#include "suspension_health_monitor/signal/period_measurement.h"

namespace suspension_health_monitor {
namespace {

// Long enough to meet some road, short enough to cost little beside the reading itself.
constexpr std::size_t kSurveyedMessages = 100000;
constexpr std::size_t kFewestSpacings = 10;
constexpr std::size_t kCheckedMessages = 2000;
constexpr double kMostFilled = 10.0;  // samples made of one reading

// The horizon is surveyed in blocks: the first ones all, later ones now and then, so that a drive that begins parked is
// surveyed on the road, too. What stands still weighs little beside what moves.
constexpr std::size_t kBlock = 5000;  // [samples]
constexpr std::size_t kFirstBlocks = 8;
constexpr std::size_t kEveryBlock = 8;
constexpr int kLongestHorizon = 4096;  // [samples]

// @param count  messages to look at; becomes those that there were.
std::optional<double> stampSpacing(const ImuBags& bags, std::size_t& count) {
  PeriodMeasurement measurement(kFewestSpacings);
  const std::size_t most = std::exchange(count, 0);
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    measurement.add(side, toStamp(imu.header.stamp));
    return ++count < most;
  });
  return measurement.period();
}

double measurePeriod(const ImuBags& bags) {
  std::size_t count = kSurveyedMessages;
  const std::optional<double> period = stampSpacing(bags, count);
  if (!period)
    throw TooLittleError("the sample period cannot be measured: fewer than " + std::to_string(kFewestSpacings) +
                         " increasing stamps on one of the topics (of " + std::to_string(count) + " messages)");
  try {
    MonitorOptions options;
    options.sample_period = period;
    validate(options, kMonitorFields);
  } catch (const std::invalid_argument& error) {
    throw InputError(std::string("measured from the stamps: ") + error.what());
  }
  return *period;
}

int proposeHorizonSamples(const ImuBags& bags, const PipelineOptions& options) {
  const double period = *options.monitor.sample_period;
  HorizonSurvey survey(period, integrationRule(options.monitor.integration_rule), kLongestHorizon);
  std::optional<Stamp> last;
  std::size_t count = 0, gaps = 0;
  RejectCounts too_soon;
  const StrutSensors sensors = readSamples(bags, options, [&](const CornerSample& sample) {
    const Continuity follows = last ? continuity(sample.stamp - *last, fromSeconds(period)) : Continuity::kGap;
    const std::size_t block = count++ / kBlock;
    const bool surveyed = block < kFirstBlocks || block % kEveryBlock == 0;
    const bool continues = follows == Continuity::kContinues || follows == Continuity::kTooSoon;
    if (!continues && last) ++gaps;
    if (follows == Continuity::kTooSoon) too_soon.add(RejectReason::kTooSoon);
    if (!continues || !surveyed) survey.interrupt();
    if (follows != Continuity::kTooSoon && surveyed) survey.push(sample);
    last = sample.stamp;
    return true;
  });
  const std::optional<int> samples = survey.horizonSamples();
  if (!samples) {
    RejectCounts rejected = sensors.rejected();
    rejected += too_soon;
    throw TooLittleError(
        "no horizon can be proposed: " +
        std::string(count == 0 ? "no pair of readings can be used" : "the data show no damped spring") + " (samples " +
        std::to_string(count) + ", gaps " + std::to_string(gaps) + describeRejected(rejected) + ")" +
        describeSuspicions(*sensors.grid(), survey.dampingIsNegative()) +
        "; give integration_horizon (--set integration_horizon=0.6) to look at them all the same");
  }
  return *samples;
}

}  // namespace

void measureOpenSettings(const ImuBags& bags, PipelineOptions& options) {
  MonitorOptions& monitor = options.monitor;
  if (!monitor.sample_period) monitor.sample_period = measurePeriod(bags);
  if (!monitor.integration_horizon && !monitor.horizon_samples)
    monitor.horizon_samples = proposeHorizonSamples(bags, options);
}

void requireFittingPeriod(const ImuBags& bags, double sample_period) {
  std::size_t count = kCheckedMessages;
  const std::optional<double> spacing = stampSpacing(bags, count);
  if (!spacing || *spacing <= kMostFilled * sample_period) return;
  char text[160];
  std::snprintf(text, sizeof text, "sample_period = %.9g [s], must be at least %.6g: the stamps come every %.6g s",
                sample_period, *spacing / kMostFilled, *spacing);
  throw std::invalid_argument(text);
}

}  // namespace suspension_health_monitor
