#include "message_pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conversions.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kMostKept = 4000000.0;  // samples of one strut, of 40 bytes each

std::vector<MonitorSettings> settingsOf(const VehicleOptions& options) {
  std::vector<MonitorSettings> settings;
  for (const PipelineOptions& strut : options.struts) settings.emplace_back(strut.monitor);
  return settings;
}

}  // namespace

MessagePipeline::MessagePipeline(const VehicleOptions& options, const VehicleStreams& streams,
                                 const tf2::BufferCore* transforms, VehicleMonitor::Sink report, bool keeps_samples)
    : VehiclePipeline(settingsOf(options), streams,
                      {std::move(report),
                       [this, keeps_samples](const auto& sample) {
                         if (keeps_samples) keep(sample);
                       }}),
      sensors_(streams, options.common.shell, transforms),
      streams_(streams),
      mounts_(streams.sensors.size()),
      forces_(options.forceNames()),
      kept_span_(options.common.shell.diagnose_window) {}

void MessagePipeline::push(std::size_t sensor, const sensor_msgs::Imu& message) {
  const std::vector<double>& values = sensors_.read(sensor, message);
  if (values.empty()) return;
  const geometry_msgs::Vector3& a = message.linear_acceleration;
  mounts_[sensor].add(toStamp(message.header.stamp), {a.x, a.y, a.z});
  if (recent_body_ && sensor == indexOf(Side::kSprung))
    if (const BodyMotion motion = sensors_.mount(sensor).across(message); recent_body_->isNewer(motion))
      recent_body_->push(motion);
  VehiclePipeline::push(sensor, toStamp(message.header.stamp), values.data());
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

std::optional<MountClaim::Finding> MessagePipeline::mount(std::size_t sensor) const {
  const tf2::Vector3& up = sensors_.mount(sensor).up();
  return mounts_[sensor].find({up.x(), up.y(), up.z()});
}

std::vector<std::string> MessagePipeline::mountFaults(const std::vector<std::string>& names) const {
  std::vector<bool> is_inclined(mounts_.size(), false);
  for (std::size_t i = 0; i < numStruts(); ++i) {
    if (!streams_.channels.struts[i].sprung) continue;
    const std::size_t top = streams_.bodyImuOf(i), wheel = streams_.wheelImuOf(i);
    const auto a = mount(top), b = mount(wheel);
    is_inclined[top] = is_inclined[wheel] = a && b && a->leansAs(*b);
  }
  std::vector<std::string> faults(mounts_.size());
  for (std::size_t i = 0; i < std::min(mounts_.size(), names.size()); ++i) {
    using Place = VehicleStreams::Place;
    const Place place = streams_.sensors[i].place;
    if (place == Place::kForce) continue;
    std::optional<MountClaim::Finding> found = mount(i);
    if (!found) continue;
    // The body's IMU is turned upright.
    if (is_inclined[i] || place == Place::kBody) found->lean = 0.0;
    const char* setting = place == Place::kUnsprung ? "unsprung_axis"
                          : place == Place::kRoad   ? "road_axis"
                                                    : "sprung_axis";
    faults[i] = describe(*found, names[i], setting);
  }
  return faults;
}

RejectCounts MessagePipeline::rejected(std::size_t sensor) const {
  RejectCounts all = sensors_.rejected(sensor);
  all += VehiclePipeline::rejected(sensor);
  return all;
}

RejectCounts MessagePipeline::rejected() const {
  RejectCounts all = VehiclePipeline::rejected();
  for (std::size_t i = 0; i < mounts_.size(); ++i) all += sensors_.rejected(i);
  return all;
}

}  // namespace suspension_health_monitor
