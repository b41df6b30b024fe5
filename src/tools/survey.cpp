#include "survey.h"

#include <optional>

#include "../ros/imu_pipeline.h"
#include "errors.h"
#include "suspension_health_monitor/signal/period_measurement.h"

namespace suspension_health_monitor {
namespace {

// Long enough to meet some road, short enough to cost little beside the reading itself.
constexpr std::size_t kSurveyedMessages = 100000;
constexpr std::size_t kFewestSpacings = 10;

double measurePeriod(const ImuBags& bags) {
  PeriodMeasurement measurement(kFewestSpacings);
  std::size_t count = 0;
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    measurement.add(side, toStamp(imu.header.stamp));
    return ++count < kSurveyedMessages;
  });
  const std::optional<double> period = measurement.period();
  if (!period)
    throw TooLittleError("the sample period cannot be measured: fewer than " + std::to_string(kFewestSpacings) +
                         " increasing stamps on one of the topics (of " + std::to_string(count) + " messages)");
  return *period;
}

}  // namespace

void measureOpenSettings(const ImuBags& bags, PipelineOptions& options) {
  MonitorOptions& monitor = options.monitor;
  if (!monitor.sample_period) monitor.sample_period = measurePeriod(bags);
}

}  // namespace suspension_health_monitor
