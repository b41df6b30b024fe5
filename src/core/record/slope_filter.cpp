#include "slope_filter.h"

#include <cmath>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kNoiseShare = 1e-3;  // of the slope's mean square

/// Robust standard deviation of white noise, from the fourth differences: those of white noise have 70 times its
/// variance.
double noiseOf(const std::vector<std::vector<double>>& series) {
  std::vector<double> differences;
  for (const std::vector<double>& x : series)
    for (std::size_t k = 2; k + 2 < x.size(); ++k)
      differences.push_back(x[k - 2] - 4 * x[k - 1] + 6 * x[k] - 4 * x[k + 1] + x[k + 2]);
  return robustDeviation(std::move(differences)) / std::sqrt(70.0);
}

double meanSquare(const SlopeFilter& slope, const std::vector<std::vector<double>>& series) {
  const std::size_t margin = SlopeFilter::kWidest;
  double sum = 0.0, count = 0.0;
  for (const std::vector<double>& x : series)
    for (std::size_t k = margin; k + margin < x.size(); ++k, ++count) sum += square(slope(&x[k]));
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

SlopeFilter::SlopeFilter(int half_width, double period) {
  // Normal equations of x = a t + b t^3; even powers do not touch the slope in the middle.
  double s2 = 0.0, s4 = 0.0, s6 = 0.0;
  for (double k = 1.0; k <= half_width; ++k) {
    s2 += 2.0 * std::pow(k, 2);
    s4 += 2.0 * std::pow(k, 4);
    s6 += 2.0 * std::pow(k, 6);
  }
  for (double k = 1.0; k <= half_width; ++k)
    weights_.push_back((s6 * k - s4 * std::pow(k, 3)) / (s2 * s6 - s4 * s4) / period);
}

SlopeFilter SlopeFilter::fitting(const std::vector<std::vector<double>>& series, double period) {
  const double noise = noiseOf(series);
  for (const int half_width : {2, 4, 8}) {
    const SlopeFilter slope(half_width, period);
    if (square(noise * slope.noiseGain()) <= kNoiseShare * meanSquare(slope, series)) return slope;
  }
  return {kWidest, period};
}

double SlopeFilter::operator()(const double* middle) const {
  double sum = 0.0;
  for (int k = 1; k <= halfWidth(); ++k) sum += weights_[k - 1] * (middle[k] - middle[-k]);
  return sum;
}

double SlopeFilter::noiseGain() const {
  double sum = 0.0;
  for (const double weight : weights_) sum += 2.0 * weight * weight;
  return std::sqrt(sum);
}

}  // namespace suspension_health_monitor
