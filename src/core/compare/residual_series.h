#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/compare/tuning.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/math/periodogram.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

/// All segments one after the other, one entry per sample, the means of residual and missing force taken off.
struct ResidualSeries {
  Eigen::VectorXd residual, missing, travel, rate, wheel;
  std::vector<std::size_t> begins{0};                  ///< of the segments, and the end of the last one
  double period = 0.0;                                 ///< T [s]
  double natural_period = 0.0;                         ///< of the strut, in samples
  double offset = 0.0;                                 ///< mean residual [m/s^2]
  double residual_memory = 1.0, missing_memory = 1.0;  ///< samples per independent one, >= 1

  std::size_t size() const { return residual.size(); }
};

/// @param segments  those of the series.
/// @return nothing if not even two windows fit into the segments.
inline std::optional<ResidualSpectrum> spectrumOf(const ResidualSeries& series,
                                                  const std::vector<ComparedSegment>& segments,
                                                  const LinearStrut& strut, const NoiseFloor& noise_floor) {
  const std::vector<std::size_t> sizes = sizesOf(segments);
  const std::size_t length = Periodogram::lengthFor(sizes, series.natural_period);
  const std::size_t windows = Periodogram::windowsIn(sizes, length);
  if (windows < 2) return std::nullopt;
  Periodogram periodogram(length);
  std::vector<double> residual(length / 2 + 1), measured = residual, wheel = residual;  // sums over all windows
  Spectrum r, y, w, cross(length / 2 + 1);
  Periodogram::forEachWindow(sizes, length, [&](std::size_t segment, std::size_t first) {
    const std::size_t in_series = series.begins[segment] + first;
    periodogram.of(&series.residual[in_series], r);
    periodogram.of(&segments[segment].measured[first], y);
    periodogram.of(&series.wheel[in_series], w);
    for (std::size_t i = 0; i < cross.size(); ++i) {
      residual[i] += std::norm(r[i]);
      measured[i] += std::norm(y[i]);
      wheel[i] += std::norm(w[i]);
      cross[i] += r[i] * std::conj(w[i]);
    }
  });

  ResidualSpectrum result;
  result.num_averages = std::max(1.0, Periodogram::kIndependent * static_cast<double>(windows));
  // gamma^2 of unrelated signals: P(gamma^2 > x) = (1 - x)^(n - 1).
  result.coherence_threshold = 1.0 - std::pow(0.05, 1.0 / std::max(1e-3, result.num_averages - 1.0));
  const double b1 = strut.damping_to_mass, b0 = strut.stiffness_to_mass;
  const double loud = noise_floor.wheel_to_body;
  const double own = square(noise_floor.rms) / noiseOfBothSensors(b1, b0, series.period, loud);
  for (std::size_t i = 1; i <= length / 2; ++i) {
    const double sides = i == length / 2 ? 1.0 : 2.0;
    const double scale = sides * series.period / (periodogram.taperPower() * static_cast<double>(windows));
    const double frequency = static_cast<double>(i) / (static_cast<double>(length) * series.period);
    result.frequency.push_back(frequency);
    result.residual.push_back(scale * residual[i]);
    result.measured.push_back(scale * measured[i]);
    const double gain = transmissibility(b1, b0, frequency);
    result.noise.push_back(sides * series.period * own * (1.0 + loud * gain * gain));
    const double power = residual[i] * wheel[i];
    result.coherence.push_back(power > 0.0 ? std::norm(cross[i]) / power : 0.0);
  }
  return result;
}

inline const double kHalfBand =
    normalQuantile(0.5 * kCompareTuning.lags_outside);  // half the band's width, in standard deviations
inline const double kUnlikely = normalQuantile(0.01);   // of the number of lags outside

/// Response of z'' to a unit sample of w'' through G(s) = (b1 s + b0) / (s^2 + b1 s + b0): e^{At}, held over a sample.
inline Eigen::VectorXd impulseResponse(const LinearStrut& strut, double period, std::size_t length) {
  const double b1 = strut.damping_to_mass, b0 = strut.stiffness_to_mass;
  Eigen::Matrix2d slope;  // of travel and travel rate
  slope << 0.0, 1.0, -b0, -b1;
  const Eigen::Matrix2d step = (period * slope).exp();
  Eigen::Vector2d motion(0.5 * period * period, period);  // after one sample of w'' = 1
  Eigen::VectorXd response(length);
  for (Eigen::Index k = 0; k < response.size(); ++k) {
    response[k] = b0 * motion[0] + b1 * motion[1];
    motion = step * motion;
  }
  return response;
}

/// @param value, expected  by lag: the correlation, and what noise on w'' can leave of one.
/// @param band  half its width where noise on w'' leaves nothing.  @param dependence  by how much correlation between
/// lags widens the spread of the number of those outside.
template <class Value, class Expected>
ResidualCorrelation correlationOver(int from, int to, double period, const Value& value, const Expected& expected,
                                    double band, double dependence) {
  ResidualCorrelation result;
  const double lags = to - from + 1;
  const double far = band * (limitFor(lags) / kHalfBand - 1.0);  // beyond the band
  double outside = 0.0;
  bool far_outside = false;
  for (int lag = from; lag <= to; ++lag) {
    result.lag.push_back(lag * period);
    result.value.push_back(value(lag));
    result.lower.push_back(std::min(0.0, expected(lag)) - band);
    result.upper.push_back(std::max(0.0, expected(lag)) + band);
    const double beyond =
        std::max(result.lower.back() - result.value.back(), result.value.back() - result.upper.back());
    if (beyond > 0.0) outside += 1.0;
    far_outside = far_outside || beyond > far;
  }
  result.share_outside = outside / lags;
  const double spread =
      std::sqrt(kCompareTuning.lags_outside * (1.0 - kCompareTuning.lags_outside) * lags * dependence);
  result.within = !far_outside && outside <= kCompareTuning.lags_outside * lags + kUnlikely * spread + 0.5;
  return result;
}

/// The arguments must outlive what is returned.
/// @return the correlation of two of the series by lag: sum over k of a(k) b(k - lag) within segments, over the root of
/// both sums of squares.
inline auto crossCorrelation(const ResidualSeries& series, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return [&, scale = a.norm() * b.norm()](int lag) {
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
                                                                     const LinearStrut& strut,
                                                                     const NoiseFloor& noise_floor) {
  const auto count = static_cast<double>(series.size());
  const int lags = static_cast<int>(
      std::min(std::clamp(std::round(series.natural_period), kCompareTuning.fewest_lags, kCompareTuning.most_lags),
               count / 4.0));
  const Eigen::VectorXd through = impulseResponse(strut, series.period, 8 * lags);
  const double loud = noise_floor.wheel_to_body;
  const double share = loud / (1.0 + loud * through.squaredNorm());  // of the floor's mean square: the wheel's sensor

  Eigen::VectorXd residual(lags + 1), wheel(lags + 1), expected(lags + 1);  // from lag 0 on
  const auto own = crossCorrelation(series, series.residual, series.residual);
  const auto road = crossCorrelation(series, series.wheel, series.wheel);
  for (int lag = 0; lag <= lags; ++lag) {
    const Eigen::Index both = through.size() - lag;
    residual[lag] = own(lag);
    wheel[lag] = road(lag);
    expected[lag] = share * through.tail(both).dot(through.head(both));
  }
  // 1 + 2 sum over the lags, by Bartlett.
  const auto variance = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return 1.0 + 2.0 * a.tail(lags).dot(b.tail(lags));
  };
  const double widened = variance(expected, expected);
  const double band = kHalfBand * std::sqrt(widened / count);
  ResidualCorrelation whiteness = correlationOver(
      1, lags, series.period, [&](int lag) { return residual[lag]; }, [&](int lag) { return expected[lag]; }, band,
      widened);

  const double cross_band = kHalfBand * std::sqrt(std::max(1.0, variance(residual, wheel)) / count);
  const double sizes = series.residual.norm() * series.wheel.norm() / count;
  // Noise on w'' is in the model's input with its own sign, so in the residual with the opposite one.
  const auto through_model = [&](int lag) {
    return lag > 0 && sizes > 0.0 ? -share * square(noise_floor.rms) * through[lag - 1] / sizes : 0.0;
  };
  return {std::move(whiteness),
          correlationOver(-lags, lags, series.period, crossCorrelation(series, series.residual, series.wheel),
                          through_model, cross_band, variance(wheel, wheel))};
}

/// 1 + 2 sum of rho over the lags before the correlation first vanishes: by so much the variance of a mean grows.
inline double memoryOf(const ResidualSeries& series, const Eigen::VectorXd& values) {
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
    series.begins.push_back(series.begins.back() + segment.size());
    series.period = segment.period;
  }
  series.travel = joined(mapped(segments, &ComparedSegment::travel));
  series.rate = joined(mapped(segments, &ComparedSegment::travel_rate));
  series.residual = joined(mapped(segments, &ComparedSegment::residuals));
  series.missing = joined(mapped(segments, &ComparedSegment::missing_force));
  series.wheel = joined(mapped(segments, &ComparedSegment::wheel));
  if (!(series.rate.squaredNorm() > 0.0)) return std::nullopt;
  series.natural_period = 2.0 * M_PI / std::sqrt(strut.stiffness_to_mass) / series.period;
  series.offset = series.residual.mean();
  for (Eigen::VectorXd* values : {&series.residual, &series.missing, &series.wheel}) values->array() -= values->mean();
  series.residual_memory = memoryOf(series, series.residual);
  series.missing_memory = memoryOf(series, series.missing);
  return series;
}

}  // namespace suspension_health_monitor
