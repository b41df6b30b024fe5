#include "message_pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conversions.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

constexpr double kMostKept = 4000000.0;  // samples of one strut, of 40 bytes each

MessagePipeline::MessagePipeline(const VehicleOptions& options, const VehicleStreams& streams,
                                 const tf2::BufferCore* transforms, VehicleMonitor::Sink report, bool keeps_samples)
    : VehiclePipeline(mapped(options.struts, [](const auto& strut) { return MonitorSettings(strut.monitor); }), streams,
                      {std::move(report),
                       [this, keeps_samples](const auto& sample) {
                         if (keeps_samples) keep(sample);
                       }}),
      sensors_(streams, options.common.shell, transforms),
      forces_(options.forceNames()),
      kept_span_(options.common.shell.diagnose_window) {}

void MessagePipeline::push(std::size_t sensor, const sensor_msgs::Imu& message) {
  const std::vector<double>& values = sensors_.read(sensor, message);
  if (values.empty()) return;
  if (recent_body_ && sensor == indexOf(Side::kSprung))
    if (const BodyMotion motion = sensors_.mount(sensor).across(message); recent_body_->isNewer(motion))
      recent_body_->push(motion);
  VehiclePipeline::push(sensor, toStamp(message.header.stamp), values.data());
  if (monitor() == nullptr) return;
  const std::optional<MountClaim::Finding>& gravity = sensors_.gravityOf(sensor);
  monitor()->setUp(sensors_.streams().sensors[sensor], gravity && gravity->isOnAnotherAxis() ? gravity->name() : "");
}

void MessagePipeline::push(std::size_t sensor, const geometry_msgs::WrenchStamped& message) {
  VehiclePipeline::push(sensor, toStamp(message.header.stamp), sensors_.read(sensor, message).data());
}

void MessagePipeline::push(std::size_t strut, const sensor_msgs::Temperature& message) {
  if (monitor() != nullptr) monitor()->addTemperature(strut, toStamp(message.header.stamp), message.temperature);
}

void MessagePipeline::keep(const VehicleSample& sample) {
  for (std::size_t i = 0; i < numStruts(); ++i)
    if (!isUsable(sample.sprung[i]) || !isUsable(sample.unsprung[i])) return;
  if (recent_.empty()) {
    const double kept = std::ceil(kept_span_ / *period()) + 1.0;
    const auto capacity = static_cast<std::size_t>(std::min(kept, kMostKept));
    recent_.assign(numStruts(), Recent<StrutSample>(capacity));
    if (!forces_.empty()) recent_forces_.emplace(capacity);
    if (numStruts() == 1) recent_body_.emplace(capacity);
  }
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    StrutSample strut{sample.ofStrut(i), {}};
    if (sample.unfiltered.size() > 0) strut.unfiltered = sample.unfiltered[i];
    if (recent_body_ && !recent_[i].isNewer(strut)) recent_body_->clear();  // the clock went back
    recent_[i].push(strut);
  }
  if (recent_forces_) recent_forces_->push({sample.stamp, sample.forces});
}

VehicleDrive MessagePipeline::newestSamples(double span) const {
  VehicleDrive drive{StrutDrives(numStruts())};
  for (std::size_t i = 0; i < recent_.size(); ++i)
    for (const StrutSample& sample : recent_[i].newest(fromSeconds(span))) {
      drive.struts[i].samples.push_back(sample);
      if (sample.unfiltered) drive.struts[i].low_pass.unfiltered.push_back(*sample.unfiltered);
    }
  if (recent_body_) drive.struts.front().body = recent_body_->newest(fromSeconds(span));
  if (!recent_forces_) return drive;
  for (const std::string& name : forces_) drive.forces.push_back({name, {}});
  for (const Forces& forces : recent_forces_->newest(fromSeconds(span)))
    for (std::size_t k = 0; k < drive.forces.size(); ++k) drive.forces[k].values.push_back(forces.values[k]);
  return drive;
}

RejectCounts MessagePipeline::rejected(std::size_t sensor) const {
  RejectCounts all = sensors_.rejected(sensor);
  all += VehiclePipeline::rejected(sensor);
  return all;
}

RejectCounts MessagePipeline::rejected() const {
  RejectCounts all = VehiclePipeline::rejected();
  for (std::size_t i = 0; i < sensors_.streams().sensors.size(); ++i) all += sensors_.rejected(i);
  return all;
}

}  // namespace suspension_health_monitor
