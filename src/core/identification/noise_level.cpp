#include "suspension_health_monitor/internal/identification/noise_level.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {

NoiseLevel::NoiseLevel(const IntegralFilterOptions& filter)
    : block_(2.0 * filter.horizon_samples),
      horizon_(filter.horizon_samples),
      sizes_(1.0 - 1.0 / (kMostBlocks * block_)),
      mean_(RegressorNoise::meanOf(filter)),
      residuals_(mean_.requiredHistory()) {}

void NoiseLevel::add(double residual) {
  if (in_series_ == 0) {
    mean_.reset();
    residuals_.reset();
  }
  residuals_.push(residual);
  const double mean = mean_.update(residuals_);
  if (in_series_ <= horizon_) {
    ++in_series_;
    return;
  }
  const auto limited = [&](std::size_t band, double value) {
    const double size = std::abs(value);
    return sizes_.weight() < block_ ? size : std::min(size, kMostSizes * sizes_.mean(band));
  };
  sizes_.add({limited(0, residual - residuals_.at(1)), limited(1, mean)});
}

std::optional<double> NoiseLevel::sensorVariance(const RegressorNoise& noise, const Eigen::Vector2d& theta,
                                                 double fitted) const {
  if (sizes_.weight() < kFewestBlocks * block_) return std::nullopt;
  // For a normal distribution the variance is pi/2 times the mean size squared.
  const double change = sizes_.mean(0), mean = sizes_.mean(1);
  return 0.5 * kPi * std::min(change * change / noise.changeGain(theta), fitted * mean * mean / noise.meanGain(theta));
}

}  // namespace suspension_health_monitor
