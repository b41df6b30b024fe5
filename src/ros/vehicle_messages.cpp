#include "vehicle_messages.h"

#include "conversions.h"
#include "drive_messages.h"

namespace suspension_health_monitor {
namespace {

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

VehicleMessageSource::VehicleMessageSource(const VehicleSimulationOptions& options, Stamp start)
    : options_(options), simulator_(options.vehicle, options.drive), start_(start) {}

std::optional<VehicleMessages> VehicleMessageSource::next() {
  const std::optional<VehicleInstant> sample = simulator_.next();
  if (!sample) return std::nullopt;
  VehicleMessages messages;
  messages.time = stampAt(start_ + sample->stamp);
  addImus(*sample, messages);
  for (std::size_t k = 0; k < sample->known_forces.size(); ++k) {
    geometry_msgs::WrenchStamped wrench;
    wrench.header = headerOf(sample->stamp, options_.vehicle.known_forces[k].name);
    wrench.wrench.force.z = sample->known_forces[k];
    messages.wrenches.emplace_back(wrenchTopic(options_.vehicle.known_forces[k]), wrench);
  }
  addTruth(*sample, messages);
  return messages;
}

void VehicleMessageSource::addImus(const VehicleInstant& sample, VehicleMessages& messages) const {
  const auto add = [&](const std::string& topic, const std::string& frame,
                       const std::optional<AccelerometerReading>& reading) {
    if (reading)
      messages.imus.emplace_back(topic,
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
  messages.imus.emplace_back(kBodyImuTopic, imu);
}

void VehicleMessageSource::addTruth(const VehicleInstant& sample, VehicleMessages& messages) const {
  const std::vector<VehicleStrut>& struts = options_.vehicle.struts;
  for (std::size_t i = 0; i < struts.size(); ++i) {
    SimulationTruth truth = toMsg(sample.truth.struts[i], headerOf(sample.stamp, struts[i].name));
    for (const ActiveEffect& active : struts[i].hidden) {
      truth.effect_names.push_back(active.effect.name);
      truth.effect_coefficients.push_back(active.coefficient);
    }
    messages.strut_truths.emplace_back("simulator/" + struts[i].name + "/truth", truth);
  }
  messages.truth.emplace_back("simulator/truth",
                              toMsg(sample.truth, options_.vehicle, headerOf(sample.stamp, "centre_of_gravity")));
}

std_msgs::Header VehicleMessageSource::headerOf(Stamp stamp, const std::string& frame) const {
  std_msgs::Header header;
  header.stamp = stampAt(start_ + stamp);
  header.frame_id = frame;
  return header;
}

}  // namespace suspension_health_monitor
