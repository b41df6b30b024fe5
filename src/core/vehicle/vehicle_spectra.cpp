#include "suspension_health_monitor/internal/vehicle/vehicle_spectra.h"

#include <algorithm>

namespace suspension_health_monitor {

VehicleSpectra::VehicleSpectra(const BlockBand& band, const VehicleChannels& vehicle, std::size_t effects)
    : band_(band), vehicle_(vehicle), modulation_(band), channel_(band.spectrumSize()), derivative_(band.size()) {
  for (const VehicleChannels::Strut& strut : vehicle.struts) {
    wheels_.emplace_back(band, effects > 0 ? 1 : 2);
    own_of_.push_back(own_.size());
    if (strut.sprung) own_.emplace_back(band, 1);
  }
  if (vehicle.numTopsOfBody() > 0) body_.emplace_back(band, kBodyChannels);
  for (std::size_t i = 0; i < vehicle.known_forces.size(); ++i) forces_.emplace_back(band, 1);
  if (effects > 0) effects_.emplace_back(band, effects);
}

void VehicleSpectra::push(const VehicleReading& reading, double time, double direction) {
  using Sensor = VehicleReading::Sensor;
  const auto& values = reading.values;
  if (reading.sensor == Sensor::kTop) return own_[own_of_[reading.place]].push(time, values.data());
  if (reading.sensor == Sensor::kForce) return forces_[reading.place].push(time, values.data());
  if (reading.sensor == Sensor::kWheel) {
    const double of_wheel[] = {values[0], direction};
    return wheels_[reading.place].push(time, of_wheel);
  }
  const double wx = values[3], wy = values[4], wz = values[5];
  std::array<double, kBodyChannels> of_body;
  of_body[kAz] = values[2];
  of_body[kWx] = wx;
  of_body[kWy] = wy;
  of_body[kWzWx] = wz * wx;
  of_body[kWzWy] = wz * wy;
  of_body[kWx2Wy2] = wx * wx + wy * wy;
  body_.front().push(time, of_body.data());
}

void VehicleSpectra::restart() {
  for (auto* streams : {&wheels_, &own_, &body_, &forces_, &effects_})
    for (FourierIntegrals& stream : *streams) stream.restart();
}

template <class Predicate>
bool VehicleSpectra::areAll(const Predicate& predicate) const {
  for (const auto* streams : {&wheels_, &own_, &body_, &forces_, &effects_})
    if (!std::all_of(streams->begin(), streams->end(), predicate)) return false;
  return true;
}

bool VehicleSpectra::isPassed(long half) const {
  return areAll([&](const FourierIntegrals& stream) { return stream.openHalf() > half; });
}

bool VehicleSpectra::isWhole(long half) const {
  return areAll(
      [&](const FourierIntegrals& stream) { return stream.half(half - 1) != nullptr && stream.half(half) != nullptr; });
}

long VehicleSpectra::newestOpen() const {
  long newest = 0;
  for (const auto* streams : {&wheels_, &own_, &body_, &forces_, &effects_})
    for (const FourierIntegrals& stream : *streams) newest = std::max(newest, stream.openHalf());
  return newest;
}

void VehicleSpectra::fill(std::size_t strut, long half, StrutBlock& block) {
  block.end = static_cast<double>(half + 1) * band_.length / 2.0;
  wheels_[strut].sumHalves(half, 0, block.wheel);
  Eigen::Index column = 0;
  const auto fillForce = [&](const FourierIntegrals& stream, Eigen::Index channel) {
    stream.sumHalves(half, channel, channel_);
    block.forces.col(column++) = channel_;
  };
  if (effects_.empty()) fillForce(wheels_[strut], 1);
  while (column < block.forces.cols() - static_cast<Eigen::Index>(forces_.size())) fillForce(effects_.front(), column);
  for (const FourierIntegrals& force : forces_) fillForce(force, 0);
  if (!vehicle_.struts[strut].sprung) return fillByBody(*vehicle_.struts[strut].position, half, block);
  own_[own_of_[strut]].sumHalves(half, 0, channel_);
  for (std::size_t p = 0; p < 3; ++p) modulation_.apply(p, channel_, block.body.col(static_cast<Eigen::Index>(p)));
}

void VehicleSpectra::fillByBody(const Eigen::Vector3d& position, long half, StrutBlock& block) {
  struct Part {
    BodyChannel channel;
    std::size_t derivatives;
    double factor;
  };
  const Part parts[] = {{kAz, 0, 1.0},
                        {kWx, 1, position.y()},
                        {kWy, 1, -position.x()},
                        {kWzWx, 0, position.x()},
                        {kWzWy, 0, position.y()},
                        {kWx2Wy2, 0, -position.z()}};
  block.body.setZero();
  for (const Part& part : parts) {
    body_.front().sumHalves(half, static_cast<Eigen::Index>(part.channel), channel_);
    for (std::size_t p = 0; p < 3; ++p) {
      modulation_.apply(p + part.derivatives, channel_, derivative_);
      block.body.col(static_cast<Eigen::Index>(p)) += part.factor * derivative_;
    }
  }
}

}  // namespace suspension_health_monitor
