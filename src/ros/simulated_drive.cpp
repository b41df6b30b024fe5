// What simulated drives share, and that of one strut as messages.

#include "simulated_drive.h"

#include <algorithm>

#include "conversions.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {
namespace {

constexpr const char* kSprungTopic = "sprung/imu";
constexpr const char* kUnsprungTopic = "unsprung/imu";
constexpr const char* kRoadTopic = "road/imu";

class StrutMessages {
 public:
  StrutMessages(const SimulatorOptions& options, Stamp start)
      : options_(options),
        simulator_(options.drive),
        sprung_gravity_(SensorFaults::from(options.drive.hidden_faults).readAtRest(options.publishing.gravity)),
        start_(start) {}

  std::optional<SimulatedInstant> next() {
    const std::optional<DriveSample> sample = simulator_.next();
    if (!sample) return std::nullopt;
    const std_msgs::Header header = headerAt(start_ + sample->stamp, "sprung_imu");
    SimulatedInstant instant{header.stamp, {}};
    const auto add = [&](const char* topic, const auto& message) { instant.messages.emplace_back(topic, message); };
    const PublishingOptions& published = options_.publishing;
    if (sample->sprung)
      add(kSprungTopic, withSway(sample->body, imuOf(*sample->sprung, sprung_gravity_, "sprung_imu")));
    if (sample->unsprung) add(kUnsprungTopic, imuOf(*sample->unsprung, published.gravity, "unsprung_imu"));
    if (sample->road && published.road_imu) add(kRoadTopic, imuOf(*sample->road, published.gravity, "road_imu"));
    add(kTruthTopic, toMessage(sample->truth, header));
    return instant;
  }

 private:
  sensor_msgs::Imu imuOf(const AccelerometerReading& reading, double gravity, const char* frame) const {
    return toImu(reading.acceleration, gravity, headerAt(start_ + reading.stamp, frame));
  }

  sensor_msgs::Imu withSway(const Sway& sway, sensor_msgs::Imu imu) const {
    imu.linear_acceleration.x = sway.acceleration[0];
    imu.linear_acceleration.y = sway.acceleration[1];
    if (options_.drive.body_rate <= 0.0) return imu;  // it has no gyro
    imu.angular_velocity.x = sway.angular_rate[0];
    imu.angular_velocity.y = sway.angular_rate[1];
    imu.angular_velocity_covariance[0] = 0.0;
    return imu;
  }

  SimulationTruth toMessage(const DriveTruth& truth, const std_msgs::Header& header) const {
    SimulationTruth msg = toMsg(truth, options_.drive.hidden, header);
    for (const ActiveMeasurementEffect& fault : options_.drive.hidden_faults)
      for (std::size_t i = 0; i < fault.coefficients.size(); ++i) {
        msg.effect_names.push_back(nameOfCoefficient(fault.effect, i));
        msg.effect_coefficients.push_back(fault.coefficients[i]);
      }
    return msg;
  }

  SimulatorOptions options_;
  DriveSimulator simulator_;
  double sprung_gravity_;
  Stamp start_;
};

}  // namespace

SimulatedDrive driveOf(const SimulatorOptions& options) {
  SimulatedDrive drive = driveWith<StrutMessages>(options);
  drive.rate = fasterRate(options.drive);
  drive.topics = {{kSprungTopic, sensor_msgs::Imu()}, {kUnsprungTopic, sensor_msgs::Imu()}};
  if (options.publishing.road_imu) drive.topics.emplace_back(kRoadTopic, sensor_msgs::Imu());
  drive.topics.emplace_back(kTruthTopic, SimulationTruth());
  drive.awaited = {kSprungTopic, kUnsprungTopic};
  return drive;
}

std_msgs::Header headerAt(Stamp stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = std::max(toRosTime(std::max(stamp, Stamp::zero())), ros::TIME_MIN);
  header.frame_id = frame;
  return header;
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
