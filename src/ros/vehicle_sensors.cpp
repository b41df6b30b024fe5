#include "vehicle_sensors.h"

#include <tf2/LinearMath/Quaternion.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "conversions.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

using Place = VehicleStreams::Place;

// The share of a sensor's range at which a reading counts as clipped. It is below the largest number that a sensor of
// 12 bits can send, which is 0.9995 of its range.
constexpr double kEndOfRange = 0.999;

// Axes with a zero in the direction are left out of the sum, since a sensor may read NaN on an axis that it lacks.
double along(const tf2::Vector3& direction, const geometry_msgs::Vector3& v) {
  double sum = 0.0;
  if (direction.x() != 0.0) sum += direction.x() * v.x;
  if (direction.y() != 0.0) sum += direction.y() * v.y;
  if (direction.z() != 0.0) sum += direction.z() * v.z;
  return sum;
}

/// @return the frame's name without the slash that some drivers still put in front of it, as tf1 did: tf2 does not find
/// such a name.
std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

ImuMount mountOf(Place place, const ShellOptions& options, const tf2::BufferCore* transforms) {
  if (place == Place::kRoad) return {options.road_axis, options.target_frame, std::nullopt, transforms};
  if (place == Place::kUnsprung)
    return {options.unsprung_axis, options.target_frame, options.unsprung_range, transforms};
  return {options.sprung_axis, options.target_frame, options.sprung_range, transforms};
}

}  // namespace

ImuMount::ImuMount(const std::string& axis, const std::string& target_frame, const std::optional<double>& range,
                   const tf2::BufferCore* transforms)
    : target_frame_(withoutSlash(target_frame)), range_(range), transforms_(transforms) {
  // The two axes across the strut follow the upward one in the order x, y, z, which makes the three right-handed. If
  // the upward one has a minus, one of the two must have it as well for them to stay so.
  const int up = axis.back() - 'x';
  const double sign = axis.front() == '-' ? -1.0 : 1.0;
  axes_[0][(up + 1) % 3] = 1.0;
  axes_[1][(up + 2) % 3] = sign;
  axes_[2][up] = sign;
  directions_ = axes_;
}

std::optional<RejectReason> ImuMount::read(const sensor_msgs::Imu& imu, bool six_axes, std::vector<double>& values) {
  if (imu.linear_acceleration_covariance[0] == -1.0) return RejectReason::kNotMeasured;
  if (!target_frame_.empty() && imu.header.frame_id != frame_ && !findTransform(imu.header.frame_id))
    return RejectReason::kNoTransform;
  if (isClipped(imu.linear_acceleration)) return RejectReason::kClipped;
  if (!six_axes) {
    values.push_back(along(up(), imu.linear_acceleration));
    return std::nullopt;
  }
  if (imu.angular_velocity_covariance[0] == -1.0) return RejectReason::kNotMeasured;
  for (const geometry_msgs::Vector3& v : {imu.linear_acceleration, imu.angular_velocity})
    for (const double component : turned(v)) values.push_back(component);
  return std::nullopt;
}

bool ImuMount::findTransform(const std::string& frame) {
  const std::string source = withoutSlash(frame);
  missing_ = source.empty() ? "(no frame_id)" : source;
  if (source.empty() || !transforms_->canTransform(target_frame_, source, ros::Time())) return false;
  const geometry_msgs::Quaternion q =
      transforms_->lookupTransform(target_frame_, source, ros::Time()).transform.rotation;
  const tf2::Matrix3x3 rotation(tf2::Quaternion(q.x, q.y, q.z, q.w));  // from the IMU's axes to those of the target
  directions_ = axes_ * rotation;
  frame_ = frame;
  missing_.clear();
  return true;
}

bool ImuMount::isClipped(const geometry_msgs::Vector3& acceleration) const {
  if (!range_) return false;
  const double end = kEndOfRange * *range_;
  return (up().x() != 0.0 && std::abs(acceleration.x) >= end) || (up().y() != 0.0 && std::abs(acceleration.y) >= end) ||
         (up().z() != 0.0 && std::abs(acceleration.z) >= end);
}

std::array<double, 3> ImuMount::turned(const geometry_msgs::Vector3& v) const {
  return {along(directions_[0], v), along(directions_[1], v), along(directions_[2], v)};
}

BodyMotion ImuMount::across(const sensor_msgs::Imu& imu) const {
  const std::array<double, 3> acceleration = turned(imu.linear_acceleration), rate = turned(imu.angular_velocity);
  BodyMotion motion{toStamp(imu.header.stamp), {acceleration[0], acceleration[1]}, {rate[0], rate[1]}};
  if (imu.angular_velocity_covariance[0] == -1.0) motion.angular_rate = {kUnknown, kUnknown};
  return motion;
}

VehicleSensors::VehicleSensors(const VehicleStreams& streams, const ShellOptions& options,
                               const tf2::BufferCore* transforms)
    : streams_(streams) {
  for (const VehicleStreams::Sensor& sensor : streams.sensors)
    sensors_.push_back({mountOf(sensor.place, options, transforms), {}, {}, {}});
  values_.reserve(6);
}

const std::vector<double>& VehicleSensors::read(std::size_t sensor, const sensor_msgs::Imu& message) {
  Sensor& its = sensors_[sensor];
  values_.clear();
  const bool six_axes = streams_.sensors[sensor].place == Place::kBody;
  if (const std::optional<RejectReason> reason = its.mount.read(message, six_axes, values_)) {
    its.rejected.add(*reason);
    return values_;
  }
  const geometry_msgs::Vector3& a = message.linear_acceleration;
  const tf2::Vector3& up = its.mount.up();
  if (its.claim.add(toStamp(message.header.stamp), {a.x, a.y, a.z}))
    its.gravity = its.claim.find({up.x(), up.y(), up.z()});
  return values_;
}

const std::vector<double>& VehicleSensors::read(std::size_t sensor, const geometry_msgs::WrenchStamped& message) {
  const geometry_msgs::Wrench& wrench = message.wrench;
  const std::array<double, kWrenchFields.size()> all{wrench.force.x,  wrench.force.y,  wrench.force.z,
                                                     wrench.torque.x, wrench.torque.y, wrench.torque.z};
  values_.clear();
  for (const std::size_t field : streams_.sensors[sensor].fields) values_.push_back(all[field]);
  return values_;
}

std::vector<std::string> VehicleSensors::mountFaults(const std::vector<std::string>& names) const {
  std::vector<bool> is_inclined(sensors_.size(), false);
  for (std::size_t i = 0; i < streams_.channels.struts.size(); ++i) {
    if (!streams_.channels.struts[i].sprung) continue;
    const std::size_t top = streams_.bodyImuOf(i), wheel = streams_.wheelImuOf(i);
    const auto &a = gravityOf(top), &b = gravityOf(wheel);
    is_inclined[top] = is_inclined[wheel] = a && b && a->leansAs(*b);
  }
  std::vector<std::string> faults(sensors_.size());
  for (std::size_t i = 0; i < std::min(sensors_.size(), names.size()); ++i) {
    const Place place = streams_.sensors[i].place;
    if (place == Place::kForce) continue;
    std::optional<MountClaim::Finding> found = gravityOf(i);
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

void requireFrame(const std::string& target_frame, const tf2::BufferCore& transforms) {
  const std::string name = withoutSlash(target_frame);
  std::vector<std::string> frames;
  transforms._getFrameStrings(frames);
  if (std::find(frames.begin(), frames.end(), name) == frames.end())
    throw std::invalid_argument("target_frame = \"" + target_frame + "\", must be a frame of /tf_static" +
                                suggestNearest(name, frames));
}

VehicleStreams streamsAnywhere(VehicleLayout layout) {
  for (VehicleLayout::Strut& strut : layout.struts)
    if (strut.frame) strut.position.emplace();
  return VehicleStreams(layout);
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
  requireApart(layout);
}

}  // namespace suspension_health_monitor
