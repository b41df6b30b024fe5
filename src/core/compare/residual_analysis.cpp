#include "suspension_health_monitor/internal/compare/residual_analysis.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "residual_series.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
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
