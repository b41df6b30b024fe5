#include "suspension_health_monitor/internal/identification/noise_level.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

// For a normal distribution it is pi/2 times the mean size squared.
double variance(double mean_size) { return 0.5 * kPi * mean_size * mean_size; }

}  // namespace

NoiseLevel::NoiseLevel(const IntegralFilterOptions& filter)
    : block_(blockRows(filter)),
      sizes_(1.0 - 1.0 / (kMostBlocks * block_)),
      late_mean_size_(1.0 - 1.0 / (kFewestBlocks * block_)),
      mean_(filter.horizon_samples) {}

void NoiseLevel::add(double residual) {
  if (in_series_ == 0) mean_.reset();
  const double mean = mean_.push(residual), change = residual - std::exchange(last_, residual);
  if (in_series_ < mean_.fills()) {
    ++in_series_;
    return;
  }
  const auto limited = [&](std::size_t band, double value) {
    const double size = std::abs(value);
    return sizes_.weight() < block_ ? size : std::min(size, kMostSizes * sizes_.mean(band));
  };
  sizes_.add({limited(0, change), limited(1, mean)});
  late_mean_size_.add(std::abs(mean));
}

std::optional<NoiseLevel::Variances> NoiseLevel::sensorVariances(const RegressorNoise& noise,
                                                                 const Eigen::Vector2d& theta) const {
  if (sizes_.weight() < kFewestBlocks * block_) return std::nullopt;
  const double mean_gain = noise.meanGain(theta);
  return Variances{variance(sizes_.mean(0)) / noise.changeGain(theta), variance(sizes_.mean(1)) / mean_gain,
                   variance(late_mean_size_.mean()) / mean_gain};
}

}  // namespace suspension_health_monitor
