#include "drive_messages.h"

#include <algorithm>

#include "conversions.h"

namespace suspension_health_monitor {

ros::Time stampAt(Stamp stamp) { return std::max(toRosTime(std::max(stamp, Stamp::zero())), ros::TIME_MIN); }

MessagesOnTopics topicsOf(const SimulatorOptions& options) {
  MessagesOnTopics topics{{kSprungTopic, sensor_msgs::Imu()}, {kUnsprungTopic, sensor_msgs::Imu()}};
  if (options.publishing.road_imu) topics.emplace_back(kRoadTopic, sensor_msgs::Imu());
  topics.emplace_back(kTruthTopic, SimulationTruth());
  return topics;
}

DriveMessageSource::DriveMessageSource(const SimulatorOptions& options, Stamp start)
    : simulator_(options.drive),
      hidden_(options.drive.hidden),
      hidden_faults_(options.drive.hidden_faults),
      gravity_(options.publishing.gravity),
      sprung_gravity_(SensorFaults::from(hidden_faults_).readAtRest(gravity_)),
      has_gyro_(options.drive.body_rate > 0.0),
      has_road_(options.publishing.road_imu),
      start_(start) {}

std::optional<SimulatedInstant> DriveMessageSource::next() {
  const std::optional<DriveSample> sample = simulator_.next();
  if (!sample) return std::nullopt;
  std_msgs::Header header;
  header.stamp = stampAt(start_ + sample->stamp);
  header.frame_id = "sprung_imu";
  SimulatedInstant instant{header.stamp, {}};
  const auto add = [&](const char* topic, const std::optional<sensor_msgs::Imu>& imu) {
    if (imu) instant.messages.emplace_back(topic, *imu);
  };
  std::optional<sensor_msgs::Imu> sprung = toMessage(sample->sprung, sprung_gravity_, "sprung_imu");
  if (sprung) addSway(sample->body, *sprung);
  add(kSprungTopic, sprung);
  add(kUnsprungTopic, toMessage(sample->unsprung, gravity_, "unsprung_imu"));
  if (has_road_) add(kRoadTopic, toMessage(sample->road, gravity_, "road_imu"));
  instant.messages.emplace_back(kTruthTopic, toMessage(sample->truth, header));
  return instant;
}

void DriveMessageSource::addSway(const Sway& sway, sensor_msgs::Imu& imu) const {
  imu.linear_acceleration.x = sway.acceleration[0];
  imu.linear_acceleration.y = sway.acceleration[1];
  if (!has_gyro_) return;
  imu.angular_velocity.x = sway.angular_rate[0];
  imu.angular_velocity.y = sway.angular_rate[1];
  imu.angular_velocity_covariance[0] = 0.0;
}

SimulationTruth DriveMessageSource::toMessage(const DriveTruth& truth, const std_msgs::Header& header) const {
  SimulationTruth msg = toMsg(truth, header);
  const auto add = [&](const std::string& name, double coefficient) {
    msg.effect_names.push_back(name);
    msg.effect_coefficients.push_back(coefficient);
  };
  for (const ActiveEffect& active : hidden_) add(active.effect.name, active.coefficient);
  for (const ActiveMeasurementEffect& fault : hidden_faults_)
    for (std::size_t i = 0; i < fault.coefficients.size(); ++i)
      add(nameOfCoefficient(fault.effect, i), fault.coefficients[i]);
  return msg;
}

std::optional<sensor_msgs::Imu> DriveMessageSource::toMessage(const std::optional<AccelerometerReading>& reading,
                                                              double gravity, const char* frame) const {
  if (!reading) return std::nullopt;
  std_msgs::Header header;
  header.stamp = stampAt(start_ + reading->stamp);
  header.frame_id = frame;
  return toImu(reading->acceleration, gravity, header);
}

}  // namespace suspension_health_monitor
