#include "vehicle_sensors.h"

#include <array>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

using Place = VehicleStreams::Place;

VehicleStreams streamsAnywhere(VehicleLayout layout) {
  for (VehicleLayout::Strut& strut : layout.struts)
    if (strut.frame) strut.position.emplace();
  return VehicleStreams(layout);
}

}  // namespace

VehicleSensors::VehicleSensors(const VehicleStreams& streams, const ShellOptions& options,
                               const tf2::BufferCore* transforms) {
  const std::array<ImuMount, kMostStreams> mounts = ImuMount::of(options, transforms);
  for (const VehicleStreams::Sensor& sensor : streams.sensors) {
    const Side side = sensor.place == Place::kRoad       ? Side::kRoad
                      : sensor.place == Place::kUnsprung ? Side::kUnsprung
                                                         : Side::kSprung;
    sensors_.push_back({sensor.place, mounts[indexOf(side)], sensor.fields, {}});
  }
  values_.reserve(6);
}

const std::vector<double>& VehicleSensors::read(std::size_t sensor, const sensor_msgs::Imu& message) {
  Sensor& its = sensors_[sensor];
  values_.clear();
  if (const std::optional<RejectReason> reason = its.mount.read(message, its.place == Place::kBody, values_))
    its.rejected.add(*reason);
  return values_;
}

const std::vector<double>& VehicleSensors::read(std::size_t sensor, const geometry_msgs::WrenchStamped& message) {
  const geometry_msgs::Wrench& wrench = message.wrench;
  const std::array<double, kWrenchFields.size()> all{wrench.force.x,  wrench.force.y,  wrench.force.z,
                                                     wrench.torque.x, wrench.torque.y, wrench.torque.z};
  values_.clear();
  for (const std::size_t field : sensors_[sensor].fields) values_.push_back(all[field]);
  return values_;
}

void placeFrames(VehicleLayout& layout, const sensor_msgs::Imu& imu, const ShellOptions& options,
                 const tf2::BufferCore& transforms) {
  const std::string from = withoutSlash(imu.header.frame_id);
  ImuMount mount(options.sprung_axis, options.target_frame, std::nullopt, &transforms);
  std::vector<double> values;
  mount.read(imu, false, values);  // finds the transform, if one is wanted
  if (!mount.missingTransform().empty())
    throw std::invalid_argument("target_frame = \"" + options.target_frame +
                                "\": no static transform to it from the frame of body_imu, " +
                                mount.missingTransform());
  for (VehicleLayout::Strut& strut : layout.struts) {
    if (!strut.frame) continue;
    const std::string to = withoutSlash(*strut.frame);
    if (from.empty() || !transforms.canTransform(from, to, ros::Time()))
      throw std::invalid_argument("struts/" + strut.name + "/frame = \"" + *strut.frame +
                                  "\": no static transform to it from the frame of body_imu, " +
                                  (from.empty() ? "which has no frame_id" : from));
    strut.position = mount.turned(transforms.lookupTransform(from, to, ros::Time()).transform.translation);
  }
}

VehiclePlacement::VehiclePlacement(const VehicleLayout& layout) : layout_(layout), streams_(streamsAnywhere(layout)) {}

std::optional<VehicleStreams> VehiclePlacement::find(const ShellOptions& options, const tf2::BufferCore& transforms) {
  if (!streams_.channels.body_imu || !layout_.hasFrames()) return streams_;
  if (!body_message_) return std::nullopt;
  VehicleLayout placed = layout_;
  try {
    placeFrames(placed, *body_message_, options, transforms);
  } catch (const std::invalid_argument& error) {
    missing_ = error.what();
    return std::nullopt;
  }
  for (VehicleLayout::Strut& strut : placed.struts) strut.frame.reset();
  return VehicleStreams(placed);
}

}  // namespace suspension_health_monitor
