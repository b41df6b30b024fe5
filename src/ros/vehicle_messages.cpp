// The simulated drive of a vehicle as messages.
#include "conversions.h"
#include "simulated_drive.h"

namespace suspension_health_monitor {
namespace {

std::string truthTopic(const VehicleStrut& strut) { return '~' + strut.name + "/truth"; }

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

class VehicleMessages {
 public:
  VehicleMessages(const VehicleSimulationOptions& options, Stamp start)
      : options_(options), simulator_(options.vehicle, options.drive), start_(start) {}

  std::optional<SimulatedInstant> next() {
    const std::optional<VehicleInstant> sample = simulator_.next();
    if (!sample) return std::nullopt;
    const Vehicle& vehicle = options_.vehicle;
    const auto headerOf = [&](const std::string& frame) { return headerAt(start_ + sample->stamp, frame); };
    SimulatedInstant instant{headerOf("").stamp, {}};
    MessagesOnTopics& messages = instant.messages;
    addImus(*sample, messages);
    for (std::size_t k = 0; k < sample->known_forces.size(); ++k) {
      geometry_msgs::WrenchStamped wrench;
      wrench.header = headerOf(vehicle.known_forces[k].name);
      wrench.wrench.force.z = sample->known_forces[k];
      messages.emplace_back(wrenchTopic(vehicle.known_forces[k]), wrench);
    }
    for (std::size_t i = 0; i < vehicle.struts.size(); ++i) {
      const VehicleStrut& strut = vehicle.struts[i];
      messages.emplace_back(truthTopic(strut), toMsg(sample->truth.struts[i], strut.hidden, headerOf(strut.name)));
    }
    messages.emplace_back(kTruthTopic, toMsg(sample->truth, vehicle, headerOf("centre_of_gravity")));
    return instant;
  }

 private:
  void addImus(const VehicleInstant& sample, MessagesOnTopics& messages) const {
    const auto add = [&](const std::string& topic, const std::string& frame,
                         const std::optional<AccelerometerReading>& reading) {
      if (reading)
        messages.emplace_back(
            topic, toImu(reading->acceleration, options_.drive.gravity, headerAt(start_ + reading->stamp, frame)));
    };
    for (std::size_t i = 0; i < sample.struts.size(); ++i) {
      const VehicleStrut& strut = options_.vehicle.struts[i];
      if (options_.has_sprung_imu[i]) add(sprungTopic(strut), strut.name + "_sprung_imu", sample.struts[i].sprung);
      add(unsprungTopic(strut), strut.name + "_unsprung_imu", sample.struts[i].unsprung);
    }
    if (!sample.body) return;
    sensor_msgs::Imu imu = toImu(0.0, 0.0, headerAt(start_ + sample.body->stamp, "body_imu"));
    set(imu.linear_acceleration, sample.body->acceleration);
    set(imu.angular_velocity, sample.body->angular_rate);
    imu.angular_velocity_covariance[0] = 0.0;
    messages.emplace_back(kBodyImuTopic, imu);
  }

  VehicleSimulationOptions options_;
  VehicleSimulator simulator_;
  Stamp start_;
};

}  // namespace

SimulatedDrive driveOf(const VehicleSimulationOptions& options) {
  SimulatedDrive drive = driveWith<VehicleMessages>(options);
  drive.rate = options.drive.rate;
  for (std::size_t i = 0; i < options.vehicle.struts.size(); ++i) {
    const VehicleStrut& strut = options.vehicle.struts[i];
    if (options.has_sprung_imu[i]) drive.topics.emplace_back(sprungTopic(strut), sensor_msgs::Imu());
    drive.topics.emplace_back(unsprungTopic(strut), sensor_msgs::Imu());
    drive.topics.emplace_back(truthTopic(strut), SimulationTruth());
    drive.awaited.push_back(unsprungTopic(strut));
  }
  drive.topics.emplace_back(kBodyImuTopic, sensor_msgs::Imu());
  for (const KnownForce& force : options.vehicle.known_forces)
    drive.topics.emplace_back(wrenchTopic(force), geometry_msgs::WrenchStamped());
  drive.topics.emplace_back(kTruthTopic, VehicleSimulationTruth());
  return drive;
}

}  // namespace suspension_health_monitor
