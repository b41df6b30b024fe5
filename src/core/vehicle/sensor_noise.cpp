#include "suspension_health_monitor/internal/vehicle/sensor_noise.h"

#include <algorithm>
#include <random>

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kDriveSamples = 1 << 14;  // the rms of so many has an error of 0.6 %
constexpr double kSmall = 1e-3;                 // of a reading: products of two of them are nothing

/// What follows one wrong reading of a stream.
/// @param tops  new ones.
StrutDrives responseOf(StrutTops tops, std::size_t num_struts, Stamp period, std::size_t num_streams,
                       std::size_t stream, double deviation) {
  StrutDrives response(num_struts);
  const int fill = 2 * tops.delay();
  for (int k = 0; k <= 2 * fill; ++k) {
    GridInstant instant{k * period, std::vector<double>(num_streams, 0.0), std::vector<bool>(num_streams, true)};
    if (k == fill) instant.values[stream] = kSmall;
    const VehicleSample* sample = tops.push(instant);
    for (std::size_t i = 0; sample != nullptr && i < response.size(); ++i) {
      CornerSample& of_strut = response[i].samples.emplace_back(sample->ofStrut(i));
      of_strut.sprung_acceleration *= deviation / kSmall;
      of_strut.unsprung_acceleration *= deviation / kSmall;
    }
  }
  return response;
}

}  // namespace

SensorNoise noiseOfOwnSensors(std::size_t num_struts) {
  SensorNoise noise;
  for (std::size_t i = 0; i < num_struts; ++i)
    for (const CornerSample wrong : {CornerSample{{}, 1.0, 0.0}, CornerSample{{}, 0.0, 1.0}}) {
      StrutDrives& response = noise.emplace_back(num_struts, Drive{{CornerSample{}}});
      response[i].samples.front() = wrong;
    }
  return noise;
}

SensorNoise knownNoise(const SensorNoise& noise, std::size_t num_struts) {
  return noise.empty() ? noiseOfOwnSensors(num_struts) : noise;
}

SensorNoise noiseOfStrutTops(const VehicleChannels& channels, Stamp period, double gyro_noise) {
  SensorNoise noise;
  std::size_t num_streams = channels.body_imu ? *channels.body_imu + 6 : 0;
  for (const VehicleChannels::Strut& strut : channels.struts)
    num_streams = std::max({num_streams, strut.unsprung + 1, strut.sprung.value_or(0) + 1});
  for (const std::size_t force : channels.known_forces) num_streams = std::max(num_streams, force + 1);
  const StrutTops tops(period, channels);
  const auto add = [&](std::size_t stream, double deviation) {
    noise.push_back(responseOf(tops, channels.struts.size(), period, num_streams, stream, deviation));
  };
  bool needs_body = false;
  for (const VehicleChannels::Strut& strut : channels.struts) {
    add(strut.unsprung, 1.0);
    if (strut.sprung) add(*strut.sprung, 1.0);
    needs_body |= !strut.sprung;
  }
  for (std::size_t axis = 0; needs_body && axis < 6; ++axis)
    add(*channels.body_imu + axis, axis < 3 ? 1.0 : gyro_noise);
  return noise;
}

std::ptrdiff_t mostStrutsOfASensor(const SensorNoise& noise) {
  const auto shows = [](const Drive& strut) {
    return std::any_of(strut.samples.begin(), strut.samples.end(), [](const CornerSample& sample) {
      return sample.sprung_acceleration != 0.0 || sample.unsprung_acceleration != 0.0;
    });
  };
  std::ptrdiff_t most = 0;
  for (const StrutDrives& response : noise)
    most = std::max(most, std::count_if(response.begin(), response.end(), shows));
  return most;
}

StrutDrives makeNoiseDrive(const SensorNoise& noise, double period) {
  StrutDrives drive(noise.front().size());
  for (Drive& strut : drive)
    for (std::size_t k = 0; k < kDriveSamples; ++k)
      strut.samples.push_back({static_cast<int>(k) * fromSeconds(period), 0.0, 0.0});
  std::mt19937_64 engine;
  std::normal_distribution<double> normal;
  for (const StrutDrives& response : noise) {
    const std::size_t length = response.front().samples.size();
    for (std::size_t k = 0; k < kDriveSamples + length - 1; ++k) {
      const double reading = normal(engine);
      for (std::size_t i = 0; i < drive.size(); ++i)
        for (std::size_t l = k < kDriveSamples ? 0 : k - kDriveSamples + 1; l < length && l <= k; ++l) {
          const CornerSample& after = response[i].samples[l];
          CornerSample& sample = drive[i].samples[k - l];
          sample.sprung_acceleration += reading * after.sprung_acceleration;
          sample.unsprung_acceleration += reading * after.unsprung_acceleration;
        }
    }
  }
  return drive;
}

}  // namespace suspension_health_monitor
