#include "suspension_health_monitor/internal/vehicle/coupled_tops.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace suspension_health_monitor {

VehicleSpectra::VehicleSpectra(const BlockBand& band, const VehicleChannels& vehicle, std::size_t effects)
    : band_(band),
      vehicle_(vehicle),
      modulation_(band),
      phases_(band),
      num_effects_(effects),
      streams_(vehicle.struts.size(), FourierIntegrals(band, effects > 0 ? 1 : 2)),
      channel_(band.spectrumSize()),
      derivative_(band.size()) {
  for (const VehicleChannels::Strut& strut : vehicle.struts) {
    top_of_.push_back(streams_.size());
    if (strut.sprung) streams_.emplace_back(band, 1);
  }
  body_ = streams_.size();
  if (vehicle.numTopsOfBody() > 0) streams_.emplace_back(band, kBodyChannels);
  forces_ = streams_.size();
  streams_.resize(forces_ + vehicle.known_forces.size(), FourierIntegrals(band, 1));
  if (effects > 0) streams_.emplace_back(band, effects);
}

void VehicleSpectra::push(const VehicleReading& reading, double time, double direction) {
  using Sensor = VehicleReading::Sensor;
  const auto& values = reading.values;
  if (reading.sensor == Sensor::kSprung) return streams_[top_of_[reading.place]].push(time, values.data(), phases_);
  if (reading.sensor == Sensor::kForce) return streams_[forces_ + reading.place].push(time, values.data(), phases_);
  if (reading.sensor == Sensor::kUnsprung) {
    const double of_wheel[] = {values[0], direction};
    return streams_[reading.place].push(time, of_wheel, phases_);
  }
  const double wx = values[3], wy = values[4], wz = values[5];
  const double of_body[kBodyChannels] = {values[2], wx, wy, wz * wx, wz * wy, wx * wx + wy * wy};  // as BodyChannel
  streams_[body_].push(time, of_body, phases_);
}

bool VehicleSpectra::isPassed(long half) const {
  return std::all_of(streams_.begin(), streams_.end(),
                     [&](const FourierIntegrals& stream) { return stream.openHalf() > half; });
}

bool VehicleSpectra::isWhole(long half) const {
  return std::all_of(streams_.begin(), streams_.end(), [&](const FourierIntegrals& stream) {
    return stream.half(half - 1) != nullptr && stream.half(half) != nullptr;
  });
}

long VehicleSpectra::newestOpen() const {
  long newest = 0;
  for (const FourierIntegrals& stream : streams_) newest = std::max(newest, stream.openHalf());
  return newest;
}

void VehicleSpectra::fill(std::size_t strut, long half, StrutBlock& block) {
  block.end = static_cast<double>(half + 1) * band_.length / 2.0;
  streams_[strut].sumHalves(half, 0, block.wheel);
  Eigen::Index column = 0;
  const auto fillForce = [&](const FourierIntegrals& stream, Eigen::Index channel) {
    stream.sumHalves(half, channel, channel_);
    block.forces.col(column++) = channel_;
  };
  if (num_effects_ == 0) fillForce(streams_[strut], 1);
  for (std::size_t j = 0; j < num_effects_; ++j) fillForce(streams_.back(), j);
  for (std::size_t k = 0; k < vehicle_.known_forces.size(); ++k) fillForce(streams_[forces_ + k], 0);
  if (!vehicle_.struts[strut].sprung) return fillByBody(*vehicle_.struts[strut].position, half, block);
  streams_[top_of_[strut]].sumHalves(half, 0, channel_);
  for (std::size_t p = 0; p < 3; ++p) modulation_.apply(p, channel_, block.body.col(p));
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
    streams_[body_].sumHalves(half, part.channel, channel_);
    for (std::size_t p = 0; p < 3; ++p) {
      modulation_.apply(p + part.derivatives, channel_, derivative_);
      block.body.col(p) += part.factor * derivative_;
    }
  }
}

bool VehicleSpectra::checkGyro(long half) {
  if (vehicle_.numTopsOfBody() == 0) return false;
  std::array<double, 3> powers;
  for (const BodyChannel channel : {kAz, kWx, kWy}) {
    streams_[body_].sumHalves(half, channel, channel_);
    modulation_.apply(0, channel_, derivative_);
    powers[channel] = derivative_.abs2().sum();
  }
  const auto is_low = [&](std::size_t axis) { return powers[axis] < square(kSmall) * body_power_.mean(axis); };
  if (body_power_.weight() >= kFewestForScatter && powers[0] > kSmall * body_power_.mean(0))
    has_dead_gyro_ = is_low(1) || is_low(2);
  if (!has_dead_gyro_) body_power_.add(powers);
  return has_dead_gyro_;
}

CoupledTops::CoupledTops(const BlockBand& band, std::size_t struts, std::size_t forces)
    : s_(Modulation(band).s()), lu_(struts) {
  rows_.rate = rows_.travel = Eigen::MatrixXd::Zero(struts, struts);
  rows_.force.setZero(struts, forces);
  wheels_.setZero(s_.size(), struts);
  travel_ = wheels_;
  forces_.setZero(s_.size(), forces);
}

void CoupledTops::setRows(const BodyRows& rows) {
  rows_ = rows;
  const auto n = wheels_.cols();
  follows_.resize(s_.size());
  for (Eigen::Index b = 0; b < s_.size(); ++b) {
    lu_.compute(loopAt(b));
    follows_[b] = s_[b] * s_[b] * lu_.solve(Small::Identity(n, n));
  }
}

CoupledTops::Small CoupledTops::loopAt(Eigen::Index bin) const {
  Small loop = rows_.rate * s_[bin] + rows_.travel.cast<std::complex<double>>();
  loop.diagonal().array() += s_[bin] * s_[bin];
  return loop;
}

const std::vector<WheelNoise>& CoupledTops::wheelNoise(std::size_t strut, const StrutEquations& equations) {
  const NoiseBands& bands = equations.noiseBands();
  const BlockColumns& columns = equations.columns();
  const auto n = static_cast<std::size_t>(wheels_.cols());
  const double b1 = rows_.rate(strut, strut), b0 = rows_.travel(strut, strut);
  noise_.assign(bands.count(), {BlockMatrix::Zero(columns.numParameters(), columns.numParameters()), 0.0});
  for (int band = 0; band < bands.count(); ++band) {
    WheelNoise& noise = noise_[band];
    for (int bin = bands.first(band); bin < bands.first(band) + bands.size(band); ++bin) {
      const std::complex<double> s = s_[bin];
      const Eigen::Vector2cd regressors(s, 1.0);
      const Eigen::Matrix2cd products =
          regressors.conjugate() * regressors.transpose() / std::norm(s * s + b1 * s + b0);
      const Small& follows = follows_[bin];
      for (std::size_t j = 0; j < n; ++j)
        noise.output += std::norm((j == strut ? 1.0 : 0.0) - follows(strut, j)) / bands.size(band);
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j)
          noise.information.block<2, 2>(rateColumn(columns, strut, k), rateColumn(columns, strut, j)) +=
              (std::conj(follows(k, j)) * products).real();
    }
  }
  return noise_;
}

void CoupledTops::predict(const std::vector<BlockEstimator>& blocks, int age, int first_force) {
  const auto n = wheels_.cols();
  const Modulation& modulation = blocks.front().equations().undelayed();
  for (Eigen::Index j = 0; j < n; ++j) modulation.apply(0, blocks[j].block(age).wheel, wheels_.col(j));
  for (Eigen::Index k = 0; k < forces_.cols(); ++k)
    modulation.apply(2, blocks.front().block(age).forces.col(first_force + k), forces_.col(k));
  SmallVector right(n), x(n);
  for (Eigen::Index b = 0; b < s_.size(); ++b) {
    // (s^2 I + Q) (X - Z) = s^2 X - s^2 c F
    x = wheels_.row(b).matrix().transpose();
    right = s_[b] * s_[b] * x;
    if (forces_.cols() > 0) right -= rows_.force * forces_.row(b).matrix().transpose();
    lu_.compute(loopAt(b));
    travel_.row(b) = lu_.solve(right).array().transpose();
  }
}

}  // namespace suspension_health_monitor
