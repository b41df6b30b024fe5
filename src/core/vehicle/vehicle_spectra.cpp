#include "suspension_health_monitor/internal/vehicle/vehicle_spectra.h"

#include <algorithm>

namespace suspension_health_monitor {

VehicleSpectra::VehicleSpectra(const BlockBand& band, const VehicleTops& tops)
    : band_(band), tops_(tops), modulation_(band), channel_(band.spectrumSize()), derivative_(band.size()) {
  for (const VehicleTops::Top& top : tops.tops) {
    wheels_.emplace_back(band, tops.looksForFriction() ? 2 : 1);
    own_of_.push_back(own_.size());
    if (top.has_own) own_.emplace_back(band, 1);
  }
  if (tops.needsBody()) body_.emplace_back(band, kBodyChannels);
  for (std::size_t i = 0; i < tops.known_forces; ++i) forces_.emplace_back(band, 1);
  if (tops.effects > 0) effects_.emplace_back(band, tops.effects);
}

void VehicleSpectra::pushWheel(std::size_t strut, double time, double acceleration, double direction) {
  const double values[] = {acceleration, direction};
  wheels_[strut].push(time, values);
}

void VehicleSpectra::pushTop(std::size_t strut, double time, double acceleration) {
  own_[own_of_[strut]].push(time, &acceleration);
}

void VehicleSpectra::pushBody(double time, const Eigen::Vector3d& acceleration, const Eigen::Vector3d& rate) {
  std::array<double, kBodyChannels> values;
  values[kAz] = acceleration.z();
  values[kWx] = rate.x();
  values[kWy] = rate.y();
  values[kWzWx] = rate.z() * rate.x();
  values[kWzWy] = rate.z() * rate.y();
  values[kWx2Wy2] = rate.x() * rate.x() + rate.y() * rate.y();
  body_.front().push(time, values.data());
}

void VehicleSpectra::pushForce(std::size_t force, double time, double value) { forces_[force].push(time, &value); }

void VehicleSpectra::pushEffects(double time, const double* forces) { effects_.front().push(time, forces); }

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
  if (tops_.looksForFriction()) fillForce(wheels_[strut], 1);
  for (std::size_t m = 0; m < tops_.effects; ++m) fillForce(effects_.front(), static_cast<Eigen::Index>(m));
  for (const FourierIntegrals& force : forces_) fillForce(force, 0);
  if (!tops_.tops[strut].has_own) return fillByBody(*tops_.tops[strut].position, half, block);
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
