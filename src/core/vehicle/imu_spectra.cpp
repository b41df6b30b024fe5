#include "suspension_health_monitor/internal/vehicle/imu_spectra.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

// Blocks that resolve 0.25 Hz, the slowest bounce there is, and reach to 20 Hz, beyond the wheel's hop.
constexpr double kLength = 8.0, kHighest = 20.0;  // [s], [Hz]
using Index = Eigen::Index;

constexpr int kAxes = SixAxes::RowsAtCompileTime;

BlockBand bandOfCheck() {
  BlockBand band(kLength, kLength);
  band.last = static_cast<int>(kHighest * kLength);
  return band;
}

}  // namespace

ImuSpectra::ImuSpectra(std::size_t imus)
    : band_(bandOfCheck()),
      modulation_(band_),
      phases_(band_),
      streams_(imus, {FourierIntegrals(band_, kAxes)}),
      sums_(band_.size(), Eigen::MatrixXcd::Zero(kAxes * imus, kAxes * imus)),
      counts_(Eigen::MatrixXd::Zero(imus, imus)) {}

void ImuSpectra::push(std::size_t imu, Stamp stamp, const SixAxes& reading) {
  Stream& stream = streams_[imu];
  if (!origin_) origin_ = stamp;
  if ((stream.last && stamp <= *stream.last) || stamp < *origin_ || !reading.allFinite()) return;
  stream.last = stamp;
  stream.integrals.push(toSeconds(stamp - *origin_), reading.data(), phases_);
  const auto [slowest, fastest] = std::minmax_element(streams_.begin(), streams_.end(), isBehind);
  // An IMU that is silent holds the others up only as long as their half blocks are kept.
  takeBlocks(std::max(slowest->integrals.openHalf(), fastest->integrals.openHalf() - FourierIntegrals::kHalves + 2));
}

void ImuSpectra::restart() {
  takeBlocks(std::max_element(streams_.begin(), streams_.end(), isBehind)->integrals.openHalf());
  for (Stream& each : streams_) {
    each.integrals.restart();
    each.last.reset();
  }
  origin_.reset();
  next_half_ = 1;
}

void ImuSpectra::takeBlocks(long end) {
  // After a pause the half blocks of the time before are gone.
  next_half_ = std::max(next_half_, end - FourierIntegrals::kHalves);
  for (; next_half_ < end; ++next_half_) {
    const std::size_t imus = streams_.size();
    Eigen::MatrixXcd values = Eigen::MatrixXcd::Zero(band_.size(), kAxes * imus);
    Eigen::VectorXd is_there = Eigen::VectorXd::Zero(imus);
    Eigen::ArrayXcd integrals(band_.spectrumSize()), bins(band_.size());
    for (std::size_t i = 0; i < imus; ++i) {
      const FourierIntegrals& stream = streams_[i].integrals;
      if (stream.half(next_half_) == nullptr || stream.half(next_half_ - 1) == nullptr) continue;
      is_there[i] = 1.0;
      for (Index axis = 0; axis < kAxes; ++axis) {
        stream.sumHalves(next_half_, axis, integrals);
        modulation_.apply(0, integrals, bins);
        values.col(kAxes * i + axis) = bins.matrix();
      }
    }
    counts_ += is_there * is_there.transpose();
    for (Index k = 0; k < values.rows(); ++k) sums_[k] += values.row(k).transpose() * values.row(k).conjugate();
  }
}

double ImuSpectra::rms(std::size_t imu, const Eigen::Vector3d& direction, double from_hz, double to_hz) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const double frequency = (band_.first + static_cast<int>(k)) / band_.length;
    if (frequency < from_hz || frequency >= to_hz) continue;
    const auto own = sums_[k].block<3, 3>(kAxes * imu, kAxes * imu);
    sum += direction.dot(own.real() * direction);
  }
  // By Parseval under Hann's window, as WindowEstimate::setMotion().
  return std::sqrt(2.0 * sum / std::max(1.0, blocks(imu)) / 0.375) / band_.length;
}

ImuSignals ImuSpectra::along(const std::vector<Eigen::Vector3d>& up, const std::vector<bool>& has_gyro,
                             const std::vector<double>& rates) const {
  ImuSignals signals{band_, rates, modulation_.s()};
  const std::size_t imus = streams_.size();
  for (std::size_t i = 0; i < imus; ++i) signals.owners.push_back(i);
  for (std::size_t i = 0; i < imus; ++i)
    if (has_gyro[i]) signals.owners.insert(signals.owners.end(), 3, i);
  const std::size_t size = signals.owners.size();
  Eigen::MatrixXcd directions = Eigen::MatrixXcd::Zero(size, kAxes * imus);
  Eigen::MatrixXd counts(size, size);
  for (std::size_t i = 0; i < size; ++i) {
    if (i < imus) directions.block<1, 3>(i, kAxes * i) = up[i].transpose();
    for (std::size_t j = 0; j < size; ++j) counts(i, j) = std::max(1.0, counts_(signals.owners[i], signals.owners[j]));
  }
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    for (std::size_t i = imus; i < size; ++i)
      directions(i, kAxes * signals.owners[i] + 3 + (i - imus) % 3) = signals.s[k];
    signals.spectra.emplace_back(directions * sums_[k] * directions.adjoint());
    signals.spectra.back().array() /= counts.array();
  }
  return signals;
}

}  // namespace suspension_health_monitor
