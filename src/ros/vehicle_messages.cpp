#include "vehicle_messages.h"

#include "conversions.h"
#include "drive_messages.h"

namespace suspension_health_monitor {
namespace {

std::string truthTopic(const VehicleStrut& strut) { return '~' + strut.name + "/truth"; }

geometry_msgs::Vector3 toMessage(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
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

}  // namespace

MessagesOnTopics topicsOf(const VehicleSimulationOptions& options) {
  MessagesOnTopics topics;
  for (std::size_t i = 0; i < options.vehicle.struts.size(); ++i) {
    const VehicleStrut& strut = options.vehicle.struts[i];
    if (options.has_sprung_imu[i]) topics.emplace_back(sprungTopic(strut), sensor_msgs::Imu());
    topics.emplace_back(unsprungTopic(strut), sensor_msgs::Imu());
    topics.emplace_back(truthTopic(strut), SimulationTruth());
  }
  topics.emplace_back(kBodyImuTopic, sensor_msgs::Imu());
  for (const KnownForce& force : options.vehicle.known_forces)
    topics.emplace_back(wrenchTopic(force), geometry_msgs::WrenchStamped());
  topics.emplace_back(kTruthTopic, VehicleSimulationTruth());
  return topics;
}

VehicleMessageSource::VehicleMessageSource(const VehicleSimulationOptions& options, Stamp start)
    : options_(options), simulator_(options.vehicle, options.drive), start_(start) {}

std::optional<SimulatedInstant> VehicleMessageSource::next() {
  const std::optional<VehicleInstant> sample = simulator_.next();
  if (!sample) return std::nullopt;
  SimulatedInstant instant{stampAt(start_ + sample->stamp), {}};
  addImus(*sample, instant.messages);
  for (std::size_t k = 0; k < sample->known_forces.size(); ++k) {
    geometry_msgs::WrenchStamped wrench;
    wrench.header = headerOf(sample->stamp, options_.vehicle.known_forces[k].name);
    wrench.wrench.force.z = sample->known_forces[k];
    instant.messages.emplace_back(wrenchTopic(options_.vehicle.known_forces[k]), wrench);
  }
  addTruth(*sample, instant.messages);
  return instant;
}

void VehicleMessageSource::addImus(const VehicleInstant& sample, MessagesOnTopics& messages) const {
  const auto add = [&](const std::string& topic, const std::string& frame,
                       const std::optional<AccelerometerReading>& reading) {
    if (reading)
      messages.emplace_back(topic,
                            toImu(reading->acceleration, options_.drive.gravity, headerOf(reading->stamp, frame)));
  };
  for (std::size_t i = 0; i < sample.struts.size(); ++i) {
    const VehicleStrut& strut = options_.vehicle.struts[i];
    if (options_.has_sprung_imu[i]) add(sprungTopic(strut), strut.name + "_sprung_imu", sample.struts[i].sprung);
    add(unsprungTopic(strut), strut.name + "_unsprung_imu", sample.struts[i].unsprung);
  }
  if (!sample.body) return;
  sensor_msgs::Imu imu = toImu(0.0, 0.0, headerOf(sample.body->stamp, "body_imu"));
  imu.linear_acceleration = toMessage(sample.body->acceleration);
  imu.angular_velocity = toMessage(sample.body->angular_rate);
  imu.angular_velocity_covariance[0] = 0.0;
  messages.emplace_back(kBodyImuTopic, imu);
}

void VehicleMessageSource::addTruth(const VehicleInstant& sample, MessagesOnTopics& messages) const {
  const std::vector<VehicleStrut>& struts = options_.vehicle.struts;
  for (std::size_t i = 0; i < struts.size(); ++i) {
    SimulationTruth truth = toMsg(sample.truth.struts[i], headerOf(sample.stamp, struts[i].name));
    for (const ActiveEffect& active : struts[i].hidden) {
      truth.effect_names.push_back(active.effect.name);
      truth.effect_coefficients.push_back(active.coefficient);
    }
    messages.emplace_back(truthTopic(struts[i]), truth);
  }
  messages.emplace_back(kTruthTopic,
                        toMsg(sample.truth, options_.vehicle, headerOf(sample.stamp, "centre_of_gravity")));
}

std_msgs::Header VehicleMessageSource::headerOf(Stamp stamp, const std::string& frame) const {
  std_msgs::Header header;
  header.stamp = stampAt(start_ + stamp);
  header.frame_id = frame;
  return header;
}

}  // namespace suspension_health_monitor
