#include "bag_samples.h"

#include <cstdio>
#include <optional>
#include <utility>

#include "../ros/conversions.h"
#include "../ros/strut_sensors.h"

namespace suspension_health_monitor {

namespace {

constexpr double kMuchLarger = 3.0;  // mean deviation of the body over that of the wheel
constexpr double kSpike = 50.0;      // mean deviations

std::string describeSpike(const char* side, const StreamGate& gate) {
  if (!(gate.farthest() > kSpike * gate.deviation() && gate.deviation() > 0.0)) return {};
  char text[200];
  std::snprintf(text, sizeof text,
                "; a %s reading is %.3g m/s^2 off the mean, %.0f times as far as usual: a spike? %s_range keeps out "
                "what lies beyond it",
                side, gate.farthest(), gate.farthest() / gate.deviation(), side);
  return text;
}

// Of readings whose fourth powers vanish nothing can be computed, see isUsable().
std::string describeStillness(const char* side, const StreamGate& gate) {
  if (gate.timing().period() == 0.0 || gate.deviation() > 1e-60) return {};
  char text[120];
  std::snprintf(text, sizeof text, "; the %s readings differ by %.3g m/s^2 only: a dead sensor, or not in m/s^2?", side,
                gate.deviation());
  return text;
}

}  // namespace

std::string describeSuspicions(const UniformGrid& grid, bool negative_damping) {
  const StreamGate &body = grid.gate(Side::kSprung), &wheel = grid.gate(Side::kUnsprung);
  std::string text = describeStillness("sprung", body) + describeStillness("unsprung", wheel);
  text += describeSpike("sprung", body) + describeSpike("unsprung", wheel);
  if (body.deviation() > kMuchLarger * wheel.deviation() && wheel.deviation() > 0.0)
    text += "; the sprung IMU shakes far more than the unsprung one: swapped, or not in m/s^2?";
  else if (negative_damping)
    text += "; damping comes out negative: the IMUs swapped, or an axis the wrong way up?";
  return text;
}

ReadSamples readSamples(const ImuBags& bags, const PipelineOptions& options,
                        const std::function<bool(const CornerSample&)>& take,
                        const std::function<void(const BodyMotion&)>& take_body) {
  StrutSensors sensors(options.shell, bags.transforms.get());
  MonitorSettings settings = options.monitor;
  settings.tyre = false;  // a sample has no part of the road
  const double period = *settings.sample_period;
  UniformGrid grid(period, settings.grid(period));
  Stamp last_body{};
  readImuMessages(bags, [&](Side side, const sensor_msgs::Imu& imu) {
    if (side == Side::kRoad) return true;
    const std::optional<double> acceleration = sensors.read(side, imu);
    if (!acceleration) return true;
    const Stamp stamp = toStamp(imu.header.stamp);
    if (take_body && side == Side::kSprung && stamp > last_body) {
      last_body = stamp;
      take_body(sensors.across(imu));
    }
    for (auto sample = grid.push(side, stamp, *acceleration); sample; sample = grid.next())
      if (!take(*sample)) return false;
    return true;
  });
  RejectCounts rejected = sensors.rejected();
  rejected += grid.rejected();
  return {std::move(grid), rejected};
}

}  // namespace suspension_health_monitor
