#include "simulated_drive.h"

#include <algorithm>
#include <memory>

#include "conversions.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {
namespace {

constexpr const char* kSprungTopic = "sprung/imu";
constexpr const char* kUnsprungTopic = "unsprung/imu";
constexpr const char* kRoadTopic = "road/imu";

/// @return the header of a message. ROS means by stamp 0 that there is none, so what is measured there is stamped a
/// nanosecond later. Nothing can be stamped before; only a clock that is set wrong on purpose gets there.
std_msgs::Header headerAt(Stamp stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = std::max(toRosTime(std::max(stamp, Stamp::zero())), ros::TIME_MIN);
  header.frame_id = frame;
  return header;
}

/// An IMU lying level: the reading on z, gravity on top of it, covariances unknown (all 0) and no orientation (-1).
/// @param start  of the drive.
sensor_msgs::Imu imuOf(const AccelerometerReading& reading, double gravity, Stamp start, const std::string& frame) {
  sensor_msgs::Imu imu;
  imu.header = headerAt(start + reading.stamp, frame);
  imu.orientation_covariance[0] = -1.0;
  imu.angular_velocity_covariance[0] = -1.0;
  imu.linear_acceleration.z = reading.acceleration + gravity;
  return imu;
}

/// What the body's IMU reads besides.
void addSway(const Sway& sway, bool has_gyro, sensor_msgs::Imu& imu) {
  imu.linear_acceleration.x = sway.acceleration[0];
  imu.linear_acceleration.y = sway.acceleration[1];
  if (!has_gyro) return;
  imu.angular_velocity.x = sway.angular_rate[0];
  imu.angular_velocity.y = sway.angular_rate[1];
  imu.angular_velocity_covariance[0] = 0.0;
}

/// @param start  of the drive.
MessagesOnTopics messagesOf(const SimulatorOptions& options, const DriveSample& sample, Stamp start) {
  const SimulationOptions& drive = options.drive;
  const double gravity = options.publishing.gravity;
  MessagesOnTopics messages;
  if (sample.sprung) {
    const double read_at_rest = SimulatedFaults::from(drive.hidden_faults).readAtRest(gravity);
    sensor_msgs::Imu imu = imuOf(*sample.sprung, read_at_rest, start, "sprung_imu");
    addSway(sample.body, drive.body_rate > 0.0, imu);
    messages.emplace_back(kSprungTopic, imu);
  }
  if (sample.unsprung) messages.emplace_back(kUnsprungTopic, imuOf(*sample.unsprung, gravity, start, "unsprung_imu"));
  if (sample.road && options.publishing.road_imu)
    messages.emplace_back(kRoadTopic, imuOf(*sample.road, gravity, start, "road_imu"));
  messages.emplace_back(kTruthTopic, toMsg(sample.truth, drive.hidden, drive.hidden_faults,
                                           headerAt(start + sample.stamp, "sprung_imu")));
  return messages;
}

void set(geometry_msgs::Vector3& message, const Eigen::Vector3d& vector) {
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
}

VehicleSimulationTruth toMsg(const VehicleTruth& truth, const Vehicle& vehicle, const std_msgs::Header& header) {
  VehicleSimulationTruth msg;
  msg.header = header;
  msg.heave = truth.body[0];
  msg.pitch = truth.body[1];
  msg.roll = truth.body[2];
  msg.pitch_rate = truth.body_rate[1];
  msg.roll_rate = truth.body_rate[2];
  msg.heave_acceleration = truth.body_acceleration[0];
  msg.pitch_acceleration = truth.body_acceleration[1];
  msg.roll_acceleration = truth.body_acceleration[2];
  msg.forces = truth.forces;
  msg.known_forces = truth.known_forces;
  for (const VehicleStrut& at : vehicle.struts) {
    msg.struts.push_back(at.name);
    for (const VehicleStrut& of : vehicle.struts)
      msg.coupling.push_back(vehicle.mobility(at, of) / vehicle.mobility(of, of));
  }
  return msg;
}

void addImus(const VehicleSimulationOptions& options, const VehicleInstant& sample, Stamp start,
             MessagesOnTopics& messages) {
  const auto add = [&](const std::string& topic, const std::string& frame,
                       const std::optional<AccelerometerReading>& reading) {
    if (reading) messages.emplace_back(topic, imuOf(*reading, options.drive.gravity, start, frame));
  };
  for (std::size_t i = 0; i < sample.struts.size(); ++i) {
    const VehicleStrut& strut = options.vehicle.struts[i];
    if (options.has_sprung_imu[i]) add(sprungTopic(strut), strut.name + "_sprung_imu", sample.struts[i].sprung);
    add(unsprungTopic(strut), strut.name + "_unsprung_imu", sample.struts[i].unsprung);
  }
  if (!sample.body) return;
  sensor_msgs::Imu imu = imuOf({sample.body->stamp, 0.0}, 0.0, start, "body_imu");
  set(imu.linear_acceleration, sample.body->acceleration);
  set(imu.angular_velocity, sample.body->angular_rate);
  imu.angular_velocity_covariance[0] = 0.0;
  messages.emplace_back(kBodyImuTopic, imu);
}

/// @param start  of the drive.
MessagesOnTopics messagesOf(const VehicleSimulationOptions& options, const VehicleInstant& sample, Stamp start) {
  const Vehicle& vehicle = options.vehicle;
  const auto header_of = [&](const std::string& frame) { return headerAt(start + sample.stamp, frame); };
  MessagesOnTopics messages;
  addImus(options, sample, start, messages);
  for (std::size_t k = 0; k < sample.known_forces.size(); ++k) {
    geometry_msgs::WrenchStamped wrench;
    wrench.header = header_of(vehicle.known_forces[k].name);
    wrench.wrench.force.z = sample.known_forces[k];
    messages.emplace_back(wrenchTopic(vehicle.known_forces[k]), wrench);
  }
  for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
    const VehicleStrut& strut = vehicle.struts[i];
    messages.emplace_back('~' + strut.name + "/truth",
                          toMsg(sample.truth.struts[i], strut.hidden, {}, header_of(strut.name)));
  }
  messages.emplace_back(kTruthTopic, toMsg(sample.truth, vehicle, header_of("centre_of_gravity")));
  return messages;
}

/// @param complete  an instant that has a message of every sensor: these tell the topics.
/// @param parts  of the options, which the simulator is made of.
template <class Simulator, class Options, class Instant, class... Parts>
SimulatedDrive driveWith(const Options& options, const Instant& complete, const Parts&... parts) {
  SimulatedDrive drive;
  drive.topics = messagesOf(options, complete, Stamp::zero());
  drive.playing = options.playing;
  drive.duration = options.drive.duration;
  drive.begin = [options, parts...](Stamp start) -> DriveSource {
    return [options, start, simulator = std::make_shared<Simulator>(parts...)]() -> std::optional<SimulatedInstant> {
      const auto sample = simulator->next();
      if (!sample) return std::nullopt;
      return SimulatedInstant{headerAt(start + sample->stamp, "").stamp, messagesOf(options, *sample, start)};
    };
  };
  return drive;
}

}  // namespace

SimulatedDrive driveOf(const SimulatorOptions& options) {
  DriveSample complete;
  complete.sprung = complete.unsprung = complete.road = AccelerometerReading();
  SimulatedDrive drive = driveWith<DriveSimulator>(options, complete, options.drive);
  drive.rate = fasterRate(options.drive);
  drive.awaited = {kSprungTopic, kUnsprungTopic};
  return drive;
}

SimulatedDrive driveOf(const VehicleSimulationOptions& options) {
  const Vehicle& vehicle = options.vehicle;
  VehicleInstant complete;
  complete.struts.assign(vehicle.struts.size(), {AccelerometerReading(), AccelerometerReading()});
  complete.body.emplace();
  complete.known_forces.resize(vehicle.known_forces.size());
  complete.truth.struts.resize(vehicle.struts.size());
  SimulatedDrive drive = driveWith<VehicleSimulator>(options, complete, vehicle, options.drive);
  drive.rate = options.drive.rate;
  for (const VehicleStrut& strut : vehicle.struts) drive.awaited.push_back(unsprungTopic(strut));
  return drive;
}

std::string takeVehicleModel(OptionMap& values) {
  OptionMap only;
  only.insert(values.extract("vehicle_model"));
  PublishingOptions options;
  takeOptions(only, kPublishingFields, options);
  return options.vehicle_model;
}

SimulatedDrive makeSimulatedDrive(OptionMap values) {
  const std::string model = takeVehicleModel(values);
  if (model.empty()) return driveOf(SimulatorOptions::fromValues(std::move(values)));
  return driveOf(VehicleSimulationOptions::fromValues(model, std::move(values)));
}

}  // namespace suspension_health_monitor
