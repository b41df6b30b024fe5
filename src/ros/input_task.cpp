#include "input_task.h"

#include <geometry_msgs/WrenchStamped.h>
#include <ros/message_traits.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <cmath>

#include "conversions.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

using ros::message_traits::DataType;
using Place = VehicleStreams::Place;

constexpr double kRateTolerance = 0.1;  // share of the expected rate: drivers keep theirs to a few percent

void warn(const std::string& of, Status& status) {
  if (!of.empty()) status.mergeSummary(Status::WARN, of);
}

/// The rate of one IMU as its stamps tell it.
/// @param expected_rate  [Hz]; another one is warned of.
void describeTiming(const StreamClock& clock, const std::string& name, const std::optional<double>& expected_rate,
                    Status& status) {
  const double rate = clock.period() > 0.0 ? 1.0 / clock.period() : 0.0;
  status.addf(name + " rate [Hz]", "%.4g", rate);
  status.addf(name + " jitter [s]", "%.3g", clock.jitter());
  status.add(name + " lost", clock.lost());
  if (expected_rate && rate > 0.0 && std::abs(rate / *expected_rate - 1.0) > kRateTolerance)
    warn(formatted("%s IMU comes at %.4g Hz, expected %.4g", name.c_str(), rate, *expected_rate), status);
}

/// Adds the counts of readings that were kept out, as "OF rejected REASON", and warns of those that came since
/// `before`.
void describeRejected(const RejectCounts& rejected, const std::string& of, RejectCounts& before, Status& status) {
  std::vector<std::string> newly;
  for (std::size_t i = 0; i < kRejectReasonNames.size(); ++i) {
    const auto reason = static_cast<RejectReason>(i);
    const std::string name(kRejectReasonNames[i]);
    if (rejected.count(reason) > before.count(reason)) newly.push_back(name);
    status.add((of.empty() ? "" : of + ' ') + "rejected " + name, rejected.count(reason));
  }
  before = rejected;
  if (!newly.empty()) warn("readings " + (of.empty() ? "" : "of " + of + ' ') + "rejected: " + join(newly), status);
}

}  // namespace

InputTask::InputTask(MonitorHost& host, const std::string& name, const VehicleOptions& options,
                     const VehicleStreams& streams, const std::vector<std::string>& topics)
    : host_(host),
      is_alone_(options.isOneStrut()),
      target_frame_(options.common.shell.target_frame),
      max_lag_(options.common.shell.max_lag),
      silent_(topics, fromSeconds(options.common.shell.input_timeout)),
      log_(name + " input", Status::ERROR, options.common.shell.input_timeout) {
  const ShellOptions& shell = options.common.shell;
  for (std::size_t i = 0; i < streams.sensors.size(); ++i) {
    const Place place = streams.sensors[i].place;
    const bool is_force = place == Place::kForce, is_wheel = place == Place::kUnsprung;
    std::optional<double> rate = is_wheel ? shell.unsprung_rate : shell.sprung_rate;
    if (is_force) rate.reset();
    sensors_.push_back(
        {is_alone_ ? (is_wheel ? "unsprung" : "sprung") : topics[i], rate,
         Arrivals(topics[i], shell.input_timeout,
                  is_force ? DataType<geometry_msgs::WrenchStamped>::value() : DataType<sensor_msgs::Imu>::value())});
    all_sensors_.push_back(i);
  }
  for (std::size_t i = 0; i < streams.channels.struts.size(); ++i) {
    own_sensors_.push_back({streams.wheelImuOf(i)});
    if (streams.channels.struts[i].sprung) own_sensors_.back().push_back(streams.bodyImuOf(i));
  }
  restart();
}

void InputTask::noteMessage(std::size_t sensor, const ros::Time& stamp) {
  sensors_[sensor].arrivals.note(stamp);
  silent_.add(sensor, toStamp(stamp));
}

void InputTask::restart() {
  gaps_before_ = 0;
  refusal_.clear();
  reported_of_vehicle_ = reported_of_strut_ = Rejected(sensors_.size());
}

void InputTask::describe(Status& status) {
  summarize(all_sensors_, status);
  if (const MessagePipeline* pipeline = host_.pipeline()) {
    describeSeries(*pipeline, status);
    describeSensors(all_sensors_, *pipeline, reported_of_vehicle_, status);
    const auto names = mapped(sensors_, [](const Sensor& sensor) { return "the " + sensor.name + " IMU"; });
    for (const std::string& fault : pipeline->sensors().mountFaults(names)) warn(fault, status);
  }
  describeSilence(all_sensors_, status);
  describeClock(status);
  log_.note(status);
}

void InputTask::describeStrut(std::size_t strut, Status& status) {
  if (is_alone_) return describe(status);
  summarize(own_sensors_[strut], status);
  if (host_.pipeline() != nullptr) describeSensors(own_sensors_[strut], *host_.pipeline(), reported_of_strut_, status);
  describeSilence(own_sensors_[strut], status);
}

void InputTask::summarize(const Sensors& sensors, Status& status) const {
  const MessagePipeline* pipeline = host_.pipeline();
  if (pipeline == nullptr) return status.summary(Status::ERROR, host_.whyNoMonitor());
  const auto isSilent = [this](std::size_t sensor) { return sensors_[sensor].arrivals.isSilentByWall(); };
  const bool stands_still = ros::Time::isSimTime() && clock_ == ros::Time::now();
  const SuspensionMonitor* monitor = pipeline->strut();
  const bool any_usable = monitor != nullptr && monitor->input().samples > 0;
  if (is_alone_ && !any_usable && pipeline->rejected().total() > 0)
    status.summary(Status::WARN, "no usable pair of readings yet");
  else if (pipeline->monitor() == nullptr)
    status.summary(Status::OK, kMeasuringPeriod);
  else if (stands_still && std::all_of(sensors.begin(), sensors.end(), isSilent))
    status.summary(Status::OK, "nothing arrives at present");
  else
    status.summary(Status::OK, is_alone_ ? "both IMUs arrive as expected" : "all sensors arrive as expected");
}

void InputTask::describeSeries(const MessagePipeline& pipeline, Status& status) {
  if (const SuspensionMonitor* monitor = pipeline.strut()) {
    const InputStatus& input = monitor->input();
    if (input.gaps + input.restarts > gaps_before_) warn("gap in the input", status);
    gaps_before_ = input.gaps + input.restarts;
    if (!input.period_fits) warn("stamps do not fit sample_period", status);
    warn(describeShaking(input), status);
    status.addf("rate [Hz]", "%.4g", input.mean_period > 0.0 ? 1.0 / input.mean_period : 0.0);
    status.addf("sample_period [s]", "%.9g", monitor->period());
    status.addf("horizon_samples", "%d", monitor->horizonSamples());
    status.add("samples", input.samples);
    status.add("regression rows", input.rows);
    status.add("gaps", input.gaps);
    status.add("clock jumps", input.restarts);
  }
  if (const VehicleGrid* grid = pipeline.grid()) {
    if (!grid->streams().resamples()) warn(describeSlowReadings(grid->streams()), status);
    status.add("alignment", describeAlignment(grid->streams()));
    status.add("bridged", grid->streams().bridged());
    if (const std::string leans = suspension_health_monitor::describe(grid->bodyLevel()); !leans.empty())
      status.add("body IMU", leans);
  }
}

void InputTask::describeSensors(const Sensors& sensors, const MessagePipeline& pipeline, Rejected& before,
                                Status& status) {
  for (const std::size_t sensor : sensors) {
    const Sensor& its = sensors_[sensor];
    its.arrivals.describeLag(its.name, max_lag_, status);
    if (const VehicleGrid* grid = pipeline.grid()) {
      describeTiming(grid->gate(sensor).clock(), its.name, its.expected_rate, status);
      if (is_alone_)
        status.add(its.name + " rejected", grid->gate(sensor).rejected().total());
      else
        status.add(its.name + " waited for in vain", grid->missed(sensor));
    }
    if (!is_alone_) describeRejected(pipeline.rejected(sensor), its.name, before[sensor], status);
  }
  if (!is_alone_) return;
  describeRejected(pipeline.rejected(), "", before.front(), status);
  for (const std::size_t sensor : sensors)
    if (const std::string& frame = pipeline.sensors().mount(sensor).missingTransform(); !frame.empty())
      status.mergeSummary(Status::ERROR,
                          "no static transform from " + frame + " to target_frame " + target_frame_ + " (/tf_static)");
}

void InputTask::describeSilence(const Sensors& sensors, Status& status) {
  if (!refusal_.empty()) return status.mergeSummary(Status::ERROR, "stopped listening until reset: " + refusal_);
  for (const std::size_t sensor : sensors) sensors_[sensor].arrivals.describeSilence(published_, status);
}

void InputTask::describeClock(Status& status) {
  if (!ros::Time::isSimTime()) return;
  const ros::Time now = ros::Time::now();
  if (now.isZero())
    status.mergeSummary(Status::ERROR, "use_sim_time is set, but nothing comes on /clock");
  else if (clock_ == now)
    status.summary(static_cast<unsigned char>(status.level), status.message + "; the clock stands still");
  clock_ = now;
}

}  // namespace suspension_health_monitor
