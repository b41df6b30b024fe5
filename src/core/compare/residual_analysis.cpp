#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <tuple>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

#include "noise_test.h"
#include "residual_series.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/periodogram.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {

std::optional<ResidualSpectrum> spectrumOf(const ResidualSeries& series, const std::vector<ComparedSegment>& segments,
                                           const LinearStrut& strut, double noise_floor) {
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
  const double own = noise_floor * noise_floor / noiseOfBothSensors(b1, b0, series.period);
  for (std::size_t i = 1; i <= length / 2; ++i) {
    const double sides = i == length / 2 ? 1.0 : 2.0;
    const double scale = sides * series.period / (periodogram.taperPower() * static_cast<double>(windows));
    const double frequency = static_cast<double>(i) / (static_cast<double>(length) * series.period);
    result.frequency.push_back(frequency);
    result.residual.push_back(scale * residual[i]);
    result.measured.push_back(scale * measured[i]);
    const double gain = transmissibility(b1, b0, frequency);
    result.noise.push_back(sides * series.period * own * (1.0 + gain * gain));
    const double power = residual[i] * wheel[i];
    result.coherence.push_back(power > 0.0 ? std::norm(cross[i]) / power : 0.0);
  }
  return result;
}

namespace {

constexpr double kFewestLags = 20.0, kMostLags = 500.0;
constexpr double kOutside = 0.05;                         // of the lags, by chance
const double kHalfBand = normalQuantile(0.5 * kOutside);  // half the band's width, in standard deviations
const double kUnlikely = normalQuantile(0.01);            // of the number of lags outside

/// Response of z'' to a unit sample of w'' through G(s) = (b1 s + b0) / (s^2 + b1 s + b0): e^{At}, held over a sample.
std::vector<double> impulseResponse(const LinearStrut& strut, double period, std::size_t length) {
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
void countOutside(double band, double dependence, ResidualCorrelation& result) {
  const auto lags = static_cast<double>(result.value.size());
  const double far = band * (NoiseTest::limitFor(lags) / kHalfBand - 1.0);  // beyond the band
  double outside = 0.0;
  bool far_outside = false;
  for (std::size_t i = 0; i < result.value.size(); ++i) {
    const double beyond = std::max(result.lower[i] - result.value[i], result.value[i] - result.upper[i]);
    if (beyond > 0.0) outside += 1.0;
    far_outside = far_outside || beyond > far;
  }
  result.share_outside = outside / lags;
  const double spread = std::sqrt(kOutside * (1.0 - kOutside) * lags * dependence);
  result.within = !far_outside && outside <= kOutside * lags + kUnlikely * spread + 0.5;
}

void addLag(int lag, double period, double value, double expected, double band, ResidualCorrelation& result) {
  result.lag.push_back(lag * period);
  result.value.push_back(value);
  result.lower.push_back(std::min(0.0, expected) - band);
  result.upper.push_back(std::max(0.0, expected) + band);
}

}  // namespace

std::pair<ResidualCorrelation, ResidualCorrelation> correlate(const ResidualSeries& series, const LinearStrut& strut,
                                                              double noise_floor) {
  const auto count = static_cast<double>(series.size());
  const int lags =
      static_cast<int>(std::min(std::clamp(std::round(series.natural_period), kFewestLags, kMostLags), count / 4.0));
  const std::vector<double> through = impulseResponse(strut, series.period, 8 * static_cast<std::size_t>(lags));
  const double share = 1.0 / (1.0 + sumOfSquares(through));  // of the floor's mean square: the body's own sensor

  ResidualCorrelation whiteness, cross_correlation;
  std::vector<double> residual{1.0}, wheel{1.0}, expected{1.0};
  double squares = 0.0;
  const Correlation own(series, series.residual, series.residual), road(series, series.wheel, series.wheel);
  for (int lag = 1; lag <= lags; ++lag) {
    residual.push_back(own.at(lag));
    wheel.push_back(road.at(lag));
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
  const Correlation cross(series, series.residual, series.wheel);
  const double sizes = std::sqrt(sumOfSquares(series.residual) * sumOfSquares(series.wheel)) / count;
  for (int lag = -lags; lag <= lags; ++lag) {
    // Noise on w'' is in the model's input with its own sign, so in the residual with the opposite one.
    const double noise_square = share * noise_floor * noise_floor;
    const double left =
        lag > 0 && sizes > 0.0 ? -noise_square * through[static_cast<std::size_t>(lag) - 1] / sizes : 0.0;
    addLag(lag, series.period, cross.at(lag), left, cross_band, cross_correlation);
  }
  countOutside(cross_band, 1.0 + wheel_squares, cross_correlation);
  return {std::move(whiteness), std::move(cross_correlation)};
}

namespace {

constexpr double kMemoryPeriods = 3.0;  // natural periods that a correlation is followed over

void append(std::vector<double>& values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

/// Takes the mean off. @return it.
double centre(std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (double& value : values) value -= mean;
  return mean;
}

/// 1 + 2 sum of rho over the lags before the correlation first vanishes: by so much the variance of a mean grows.
double memoryOf(const ResidualSeries& series, const std::vector<double>& values) {
  const double vanished = normalQuantile(0.025) / std::sqrt(static_cast<double>(values.size()));
  const double most = std::min(kMemoryPeriods * series.natural_period, 0.125 * static_cast<double>(values.size()));
  const Correlation correlation(series, values, values);
  double sum = 1.0;
  for (int lag = 1; lag <= static_cast<int>(most); ++lag) {
    const double rho = correlation.at(lag);
    if (rho < vanished) break;
    sum += 2.0 * rho;
  }
  return sum;
}

}  // namespace

double sumOfSquares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += square(value);
  return sum;
}

Correlation::Correlation(const ResidualSeries& series, const std::vector<double>& a, const std::vector<double>& b)
    : series_(series), a_(a), b_(b), scale_(std::sqrt(sumOfSquares(a) * sumOfSquares(b))) {}

double Correlation::at(int lag) const {
  const auto shift = static_cast<std::size_t>(std::abs(lag));
  double sum = 0.0;
  for (std::size_t s = 0; s + 1 < series_.begins.size(); ++s)
    for (std::size_t k = series_.begins[s] + shift; k < series_.begins[s + 1]; ++k)
      sum += lag >= 0 ? a_[k] * b_[k - shift] : a_[k - shift] * b_[k];
  return scale_ > 0.0 ? sum / scale_ : 0.0;
}

std::optional<ResidualSeries> makeSeries(const std::vector<ComparedSegment>& segments, const LinearStrut& strut) {
  ResidualSeries series;
  for (const ComparedSegment& segment : segments) {
    series.begins.push_back(series.size());
    series.period = segment.period;
    append(series.residual, segment.residuals());
    append(series.missing, segment.missing_force);
    append(series.travel, segment.travel);
    append(series.rate, segment.travel_rate);
    append(series.wheel, segment.wheel);
  }
  series.begins.push_back(series.size());
  if (!(sumOfSquares(series.rate) > 0.0)) return std::nullopt;
  series.natural_period = 2.0 * M_PI / std::sqrt(strut.stiffness_to_mass) / series.period;
  series.offset = centre(series.residual);
  centre(series.missing);
  centre(series.wheel);
  series.residual_memory = memoryOf(series, series.residual);
  series.missing_memory = memoryOf(series, series.missing);
  return series;
}

std::optional<ResidualViews> viewResidual(const std::vector<ComparedSegment>& segments, const LinearStrut& strut,
                                          double noise_floor) {
  const std::optional<ResidualSeries> series = makeSeries(segments, strut);
  if (!series) return std::nullopt;
  const auto count = static_cast<double>(series->size());
  ResidualViews views;
  views.offset = series->offset;
  views.rms = std::sqrt(sumOfSquares(series->residual) / count);
  views.offset_standard_error = views.rms * std::sqrt(series->residual_memory / count);
  views.independent_share = 1.0 / series->residual_memory;
  views.num_samples = series->size();
  views.time = binByTime(*series, segments);
  views.travel = binByQuantile(*series, series->travel);
  views.travel_rate = binByQuantile(*series, series->rate);
  views.surface = mapForce(*series);
  views.direction = compareDirections(*series);
  views.spectrum = spectrumOf(*series, segments, strut, noise_floor);
  std::tie(views.whiteness, views.cross_correlation) = correlate(*series, strut, noise_floor);
  return views;
}

}  // namespace suspension_health_monitor
