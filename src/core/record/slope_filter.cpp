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
  const Eigen::ArrayXd k = Eigen::ArrayXd::LinSpaced(half_width, 1.0, half_width);
  const double s2 = 2.0 * k.square().sum(), s4 = 2.0 * k.pow(4.0).sum(), s6 = 2.0 * k.pow(6.0).sum();
  weights_ = (s6 * k - s4 * k.cube()) / ((s2 * s6 - s4 * s4) * period);
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

}  // namespace suspension_health_monitor
