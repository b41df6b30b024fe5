#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/compare/comparison.h"

namespace suspension_health_monitor {

/// All segments one after the other, one entry per sample, the means of residual and missing force taken off.
struct ResidualSeries {
  std::vector<double> residual, missing, travel, rate, wheel;
  std::vector<std::size_t> begins;                     ///< of the segments, and the end of the last one
  double period = 0.0;                                 ///< T [s]
  double natural_period = 0.0;                         ///< of the strut, in samples
  double offset = 0.0;                                 ///< mean residual [m/s^2]
  double residual_memory = 1.0, missing_memory = 1.0;  ///< samples per independent one, >= 1

  std::size_t size() const { return residual.size(); }
};

/// @return nothing if nothing moves.
std::optional<ResidualSeries> makeSeries(const std::vector<ComparedSegment>& segments, const LinearStrut& strut);

inline constexpr double kCovered = 0.99;        ///< of the samples, by even edges
inline constexpr std::size_t kFewestInBin = 8;  ///< samples that a mean is taken of

double sumOfSquares(const std::vector<double>& values);

/// The correlation of two of the series.
class Correlation {
 public:
  /// The arguments must outlive it.
  Correlation(const ResidualSeries& series, const std::vector<double>& a, const std::vector<double>& b);

  /// @return sum over k of a(k) b(k - lag) within segments, over the root of both sums of squares.
  double at(int lag) const;

 private:
  const ResidualSeries& series_;
  const std::vector<double>& a_;
  const std::vector<double>& b_;
  double scale_;
};

/// @return the values below which the shares of all lie, each one of the values.
std::vector<double> quantiles(std::vector<double> values, const std::vector<double>& shares);

/// @param segments  those of the series.
std::vector<TimeBin> binByTime(const ResidualSeries& series, const std::vector<ComparedSegment>& segments);

/// @param x  one value per sample.
std::vector<ResidualBin> binByQuantile(const ResidualSeries& series, const std::vector<double>& x);

DirectionLoop compareDirections(const ResidualSeries& series);

ForceSurface mapForce(const ResidualSeries& series);

/// @return autocorrelation of the residual, and its correlation with w'', each with the bands of ResidualCorrelation.
std::pair<ResidualCorrelation, ResidualCorrelation> correlate(const ResidualSeries& series, const LinearStrut& strut,
                                                              double noise_floor);

/// @param segments  those of the series.
/// @return nothing if not even two windows fit into the segments.
std::optional<ResidualSpectrum> spectrumOf(const ResidualSeries& series, const std::vector<ComparedSegment>& segments,
                                           const LinearStrut& strut, double noise_floor);

}  // namespace suspension_health_monitor
