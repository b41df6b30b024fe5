#include "suspension_health_monitor/internal/compare/residual_analysis.h"

#include <cmath>

#include "residual_bins.h"
#include "residual_correlation.h"
#include "residual_series.h"
#include "residual_spectrum.h"

namespace suspension_health_monitor {

std::optional<ResidualViews> viewResidual(const std::vector<ComparedSegment>& segments, const ExpectedNoise& noise) {
  const std::optional<ResidualSeries> series = makeSeries(segments, noise);
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
  views.spectrum = spectrumOf(*series, segments, noise);
  ResidualCorrelations correlations = correlate(*series, noise);
  views.whiteness = std::move(correlations.whiteness);
  views.cross_correlation = std::move(correlations.cross);
  return views;
}

}  // namespace suspension_health_monitor
