#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>
#include <vector>

#include "residual_series.h"
#include "suspension_health_monitor/internal/compare/tuning.h"

namespace suspension_health_monitor {

inline const double kHalfBand =
    normalQuantile(0.5 * kCompareTuning.lags_outside);  // half the band's width, in standard deviations
inline const double kUnlikely = normalQuantile(0.01);   // of the number of lags outside

/// Response of z'' to a unit sample of w'' through G(s) = (b1 s + b0) / (s^2 + b1 s + b0): e^{At}, held over a sample.
inline std::vector<double> impulseResponse(const LinearStrut& strut, double period, std::size_t length) {
  const double b1 = strut.damping_to_mass, b0 = strut.stiffness_to_mass;
  Eigen::Matrix2d slope;  // of travel and travel rate
  slope << 0.0, 1.0, -b0, -b1;
  const Eigen::Matrix2d step = (period * slope).exp();
  Eigen::Vector2d motion(0.5 * period * period, period);  // after one sample of w'' = 1
  std::vector<double> response(length);
  for (double& value : response) {
    value = b0 * motion[0] + b1 * motion[1];
    motion = step * motion;
  }
  return response;
}

/// Counts lags outside the band.
/// @param band  half its width where noise on w'' leaves nothing.  @param dependence  by how much correlation between
/// lags widens the spread of their number.
inline void countOutside(double band, double dependence, ResidualCorrelation& result) {
  const auto lags = static_cast<double>(result.value.size());
  const double far = band * (limitFor(lags) / kHalfBand - 1.0);  // beyond the band
  double outside = 0.0;
  bool far_outside = false;
  for (std::size_t i = 0; i < result.value.size(); ++i) {
    const double beyond = std::max(result.lower[i] - result.value[i], result.value[i] - result.upper[i]);
    if (beyond > 0.0) outside += 1.0;
    far_outside = far_outside || beyond > far;
  }
  result.share_outside = outside / lags;
  const double spread =
      std::sqrt(kCompareTuning.lags_outside * (1.0 - kCompareTuning.lags_outside) * lags * dependence);
  result.within = !far_outside && outside <= kCompareTuning.lags_outside * lags + kUnlikely * spread + 0.5;
}

inline void addLag(int lag, double period, double value, double expected, double band, ResidualCorrelation& result) {
  result.lag.push_back(lag * period);
  result.value.push_back(value);
  result.lower.push_back(std::min(0.0, expected) - band);
  result.upper.push_back(std::max(0.0, expected) + band);
}

/// The arguments must outlive what is returned.
/// @return the correlation of two of the series by lag: sum over k of a(k) b(k - lag) within segments, over the root of
/// both sums of squares.
inline auto crossCorrelation(const ResidualSeries& series, const std::vector<double>& a, const std::vector<double>& b) {
  return [&, scale = std::sqrt(sumOfSquares(a) * sumOfSquares(b))](int lag) {
    const auto shift = static_cast<std::size_t>(std::abs(lag));
    double sum = 0.0;
    for (std::size_t s = 0; s + 1 < series.begins.size(); ++s)
      for (std::size_t k = series.begins[s] + shift; k < series.begins[s + 1]; ++k)
        sum += lag >= 0 ? a[k] * b[k - shift] : a[k - shift] * b[k];
    return scale > 0.0 ? sum / scale : 0.0;
  };
}

/// @return autocorrelation of the residual, and its correlation with w'', each with the bands of ResidualCorrelation.
inline std::pair<ResidualCorrelation, ResidualCorrelation> correlate(const ResidualSeries& series,
                                                                     const LinearStrut& strut, double noise_floor) {
  const auto count = static_cast<double>(series.size());
  const int lags = static_cast<int>(
      std::min(std::clamp(std::round(series.natural_period), kCompareTuning.fewest_lags, kCompareTuning.most_lags),
               count / 4.0));
  const std::vector<double> through = impulseResponse(strut, series.period, 8 * lags);
  const double share = 1.0 / (1.0 + sumOfSquares(through));  // of the floor's mean square: the body's own sensor

  ResidualCorrelation whiteness, cross_correlation;
  std::vector<double> residual{1.0}, wheel{1.0}, expected{1.0};
  double squares = 0.0;
  const auto own = crossCorrelation(series, series.residual, series.residual);
  const auto road = crossCorrelation(series, series.wheel, series.wheel);
  for (int lag = 1; lag <= lags; ++lag) {
    residual.push_back(own(lag));
    wheel.push_back(road(lag));
    expected.push_back(share * std::inner_product(through.begin() + lag, through.end(), through.begin(), 0.0));
    squares += expected.back() * expected.back();
  }
  const double band = kHalfBand * std::sqrt((1.0 + 2.0 * squares) / count);
  double cross_variance = 1.0, wheel_squares = 0.0;
  for (std::size_t lag = 1; lag < residual.size(); ++lag) {
    addLag(static_cast<int>(lag), series.period, residual[lag], expected[lag], band, whiteness);
    cross_variance += 2.0 * residual[lag] * wheel[lag];
    wheel_squares += 2.0 * wheel[lag] * wheel[lag];
  }
  countOutside(band, 1.0 + 2.0 * squares, whiteness);

  const double cross_band = kHalfBand * std::sqrt(std::max(1.0, cross_variance) / count);
  const auto cross = crossCorrelation(series, series.residual, series.wheel);
  const double sizes = std::sqrt(sumOfSquares(series.residual) * sumOfSquares(series.wheel)) / count;
  for (int lag = -lags; lag <= lags; ++lag) {
    // Noise on w'' is in the model's input with its own sign, so in the residual with the opposite one.
    const double noise_square = share * noise_floor * noise_floor;
    const double centre = lag > 0 && sizes > 0.0 ? -noise_square * through[lag - 1] / sizes : 0.0;
    addLag(lag, series.period, cross(lag), centre, cross_band, cross_correlation);
  }
  countOutside(cross_band, 1.0 + wheel_squares, cross_correlation);
  return {std::move(whiteness), std::move(cross_correlation)};
}

inline void addAll(std::vector<double>& values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

/// Takes the mean off. @return it.
inline double takeMeanOff(std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  for (double& value : values) value -= mean;
  return mean;
}

/// 1 + 2 sum of rho over the lags before the correlation first vanishes: by so much the variance of a mean grows.
inline double memoryOf(const ResidualSeries& series, const std::vector<double>& values) {
  const double vanished = normalQuantile(0.025) / std::sqrt(static_cast<double>(values.size()));
  const double most =
      std::min(kCompareTuning.memory_periods * series.natural_period, 0.125 * static_cast<double>(values.size()));
  const auto own = crossCorrelation(series, values, values);
  double sum = 1.0;
  for (int lag = 1; lag <= static_cast<int>(most); ++lag) {
    const double rho = own(lag);
    if (rho < vanished) break;
    sum += 2.0 * rho;
  }
  return sum;
}

/// @return nothing if nothing moves.
inline std::optional<ResidualSeries> makeSeries(const std::vector<ComparedSegment>& segments,
                                                const LinearStrut& strut) {
  ResidualSeries series;
  for (const ComparedSegment& segment : segments) {
    series.begins.push_back(series.size());
    series.period = segment.period;
    addAll(series.residual, segment.residuals());
    addAll(series.missing, segment.missing_force);
    addAll(series.travel, segment.travel);
    addAll(series.rate, segment.travel_rate);
    addAll(series.wheel, segment.wheel);
  }
  series.begins.push_back(series.size());
  if (!(sumOfSquares(series.rate) > 0.0)) return std::nullopt;
  series.natural_period = 2.0 * M_PI / std::sqrt(strut.stiffness_to_mass) / series.period;
  series.offset = takeMeanOff(series.residual);
  takeMeanOff(series.missing);
  takeMeanOff(series.wheel);
  series.residual_memory = memoryOf(series, series.residual);
  series.missing_memory = memoryOf(series, series.missing);
  return series;
}

}  // namespace suspension_health_monitor
