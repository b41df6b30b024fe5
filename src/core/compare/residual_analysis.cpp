#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <tuple>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/periodogram.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kCovered = 0.99;  // of the samples, by even edges

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

double sumOfSquares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += square(value);
  return sum;
}

/// @param segments  those of the series.
/// @return nothing if not even two windows fit into the segments.
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
  const double far = band * (limitFor(lags) / kHalfBand - 1.0);  // beyond the band
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

/// The arguments must outlive what is returned.
/// @return the correlation of two of the series by lag: sum over k of a(k) b(k - lag) within segments, over the root of
/// both sums of squares.
auto correlation(const ResidualSeries& series, const std::vector<double>& a, const std::vector<double>& b) {
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
  const auto own = correlation(series, series.residual, series.residual);
  const auto road = correlation(series, series.wheel, series.wheel);
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
  const auto cross = correlation(series, series.residual, series.wheel);
  const double sizes = std::sqrt(sumOfSquares(series.residual) * sumOfSquares(series.wheel)) / count;
  for (int lag = -lags; lag <= lags; ++lag) {
    // Noise on w'' is in the model's input with its own sign, so in the residual with the opposite one.
    const double noise_square = share * noise_floor * noise_floor;
    const double left =
        lag > 0 && sizes > 0.0 ? -noise_square * through[static_cast<std::size_t>(lag) - 1] / sizes : 0.0;
    addLag(lag, series.period, cross(lag), left, cross_band, cross_correlation);
  }
  countOutside(cross_band, 1.0 + wheel_squares, cross_correlation);
  return {std::move(whiteness), std::move(cross_correlation)};
}

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
  const auto own = correlation(series, values, values);
  double sum = 1.0;
  for (int lag = 1; lag <= static_cast<int>(most); ++lag) {
    const double rho = own(lag);
    if (rho < vanished) break;
    sum += 2.0 * rho;
  }
  return sum;
}

/// @return nothing if nothing moves.
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

constexpr double kMostTimeBins = 24.0;    // of all drives together
constexpr double kShortestTimeBin = 4.0;  // natural periods
const std::vector<double> kShares{0.0, 0.01, 0.03, 0.06, 0.1,  0.2,  0.3,  0.4, 0.5,
                                  0.6, 0.7,  0.8,  0.9,  0.94, 0.97, 0.99, 1.0};
const std::vector<double> kLoopShares{0.0, 0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 1.0};
constexpr int kCells = 12;  // of the force surface, either way; even: one edge is 0

/// Sums over the samples of a bin.
struct BinSums {
  double count = 0.0, missing = 0.0, missing_square = 0.0, residual_square = 0.0;

  void add(double m, double r) {
    count += 1.0;
    missing += m;
    missing_square += square(m);
    residual_square += square(r);
  }

  double standardError(double memory) const {
    if (count < 2.0) return 0.0;
    const double mean = missing / count;
    return std::sqrt(std::max(0.0, missing_square / count - square(mean)) * memory / (count - 1.0));
  }

  void fill(double memory, ResidualBin& bin) const {
    bin.count = static_cast<std::size_t>(count);
    if (count == 0.0) return;
    bin.mean = missing / count;
    bin.rms = std::sqrt(residual_square / count);
    bin.standard_error = standardError(memory);
  }
};

/// The bin of a value; the outermost take in what lies beyond.
std::size_t binOf(const std::vector<double>& edges, double value) {
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return static_cast<std::size_t>(above - edges.begin()) - 1;
}

std::vector<ResidualBin> makeBins(const std::vector<double>& edges, const std::vector<BinSums>& sums, double memory) {
  std::vector<ResidualBin> bins(sums.size());
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].from = edges[i];
    bins[i].to = edges[i + 1];
    sums[i].fill(memory, bins[i]);
  }
  return bins;
}

/// @return the values below which the shares of all lie, each one of the values.
std::vector<double> quantiles(std::vector<double> values, const std::vector<double>& shares) {
  std::sort(values.begin(), values.end());
  std::vector<double> edges;
  for (const double share : shares)
    edges.push_back(values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))]);
  return edges;
}

/// Even edges around 0 that cover nearly all values.
std::vector<double> evenEdges(const std::vector<double>& values) {
  const auto [from, to] = coveredRange(values);
  const double reach = std::max(std::abs(from), std::abs(to));
  std::vector<double> edges;
  for (int i = 0; i <= kCells; ++i) edges.push_back(reach * (2.0 * i / kCells - 1.0));
  return edges;
}

/// What one stretch of time says of the strut's numbers: normal equations of missing force on (v, d).
class LocalFit {
 public:
  void add(double rate, double travel, double missing) {
    const Eigen::Vector2d row(rate, travel);
    gram_ += row * row.transpose();
    moment_ += missing * row;
    square_ += square(missing);
  }

  void fill(double memory, TimeBin& bin) const {
    const Eigen::LDLT<Eigen::Matrix2d> factors(gram_);
    if (bin.count < kFewestInBin || !(factors.rcond() > 1e-14)) return;
    const Eigen::Vector2d solution = factors.solve(moment_);
    const double left = std::max(0.0, square_ - moment_.dot(solution)) / (static_cast<double>(bin.count) - 2.0);
    const Eigen::Matrix2d covariance = left * memory * factors.solve(Eigen::Matrix2d::Identity());
    bin.damping_error = solution[0];
    bin.stiffness_error = solution[1];
    bin.damping_error_stddev = std::sqrt(std::max(0.0, covariance(0, 0)));
    bin.stiffness_error_stddev = std::sqrt(std::max(0.0, covariance(1, 1)));
  }

 private:
  Eigen::Matrix2d gram_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero();
  double square_ = 0.0;
};

/// Calls take(first, last, from, to) for each drive: its segments, last being one past the end, and its time [s].
template <class Take>
void forEachDrive(const std::vector<ComparedSegment>& segments, const Take& take) {
  for (std::size_t first = 0, last = 0; first < segments.size(); first = last) {
    while (last < segments.size() && segments[last].drive == segments[first].drive) ++last;
    take(first, last, segments[first].start, segments[last - 1].time(segments[last - 1].size()));
  }
}

/// @param segments  those of the series.
std::vector<TimeBin> binByTime(const ResidualSeries& series, const std::vector<ComparedSegment>& segments) {
  double duration = 0.0;
  forEachDrive(segments, [&](std::size_t, std::size_t, double from, double to) { duration += to - from; });
  const double width = std::max(duration / kMostTimeBins, kShortestTimeBin * series.natural_period * series.period);
  std::vector<TimeBin> bins;
  forEachDrive(segments, [&](std::size_t first, std::size_t last, double from, double to) {
    const auto count = static_cast<std::size_t>(std::max(1.0, std::floor((to - from) / width)));
    std::vector<BinSums> sums(count);
    std::vector<LocalFit> fits(count);
    for (std::size_t s = first; s < last; ++s)
      for (std::size_t k = 0; k < segments[s].size(); ++k) {
        const double share = (segments[s].time(k) - from) / (to - from);
        const std::size_t i = std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)));
        const std::size_t n = series.begins[s] + k;
        sums[i].add(series.residual[n], series.residual[n]);
        fits[i].add(series.rate[n], series.travel[n], series.missing[n]);
      }
    for (std::size_t i = 0; i < count; ++i) {
      TimeBin& bin = bins.emplace_back();
      bin.drive = segments[first].drive;
      bin.from = from + (to - from) * static_cast<double>(i) / static_cast<double>(count);
      bin.to = from + (to - from) * static_cast<double>(i + 1) / static_cast<double>(count);
      sums[i].fill(series.residual_memory, bin);
      fits[i].fill(series.missing_memory, bin);
    }
  });
  return bins;
}

/// @param x  one value per sample.
std::vector<ResidualBin> binByQuantile(const ResidualSeries& series, const std::vector<double>& x) {
  const std::vector<double> edges = quantiles(x, kShares);
  std::vector<BinSums> sums(edges.size() - 1);
  for (std::size_t n = 0; n < x.size(); ++n) sums[binOf(edges, x[n])].add(series.missing[n], series.residual[n]);
  return makeBins(edges, sums, series.missing_memory);
}

DirectionLoop compareDirections(const ResidualSeries& series) {
  const std::vector<double> edges = quantiles(series.travel, kLoopShares);
  std::vector<BinSums> forth(edges.size() - 1), back(edges.size() - 1);
  for (std::size_t n = 0; n < series.size(); ++n)
    (series.rate[n] > 0.0 ? forth : back)[binOf(edges, series.travel[n])].add(series.missing[n], series.residual[n]);
  DirectionLoop loop;
  loop.compressing = makeBins(edges, forth, series.missing_memory);
  loop.extending = makeBins(edges, back, series.missing_memory);
  double weight = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < forth.size(); ++i) {
    const ResidualBin& c = loop.compressing[i];
    const ResidualBin& e = loop.extending[i];
    if (std::min(c.count, e.count) < kFewestInBin) continue;
    const auto count = static_cast<double>(c.count + e.count);
    weight += count;
    loop.gap += count * (c.mean - e.mean);
    variance += count * count * (square(c.standard_error) + square(e.standard_error));
    loop.area += (c.mean - e.mean) * (c.to - c.from);
  }
  if (weight == 0.0) return loop;
  loop.gap /= weight;
  loop.gap_standard_error = std::sqrt(variance) / weight;
  return loop;
}

ForceSurface mapForce(const ResidualSeries& series) {
  ForceSurface surface;
  surface.travel_edges = evenEdges(series.travel);
  surface.rate_edges = evenEdges(series.rate);
  std::vector<BinSums> sums(kCells * kCells);
  for (std::size_t n = 0; n < series.size(); ++n)
    sums[binOf(surface.travel_edges, series.travel[n]) * kCells + binOf(surface.rate_edges, series.rate[n])].add(
        series.missing[n], series.residual[n]);
  surface.mean = surface.standard_error = surface.rms = Eigen::MatrixXd::Zero(kCells, kCells);
  surface.count = Eigen::MatrixXi::Zero(kCells, kCells);
  double explained = 0.0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const BinSums& cell = sums[static_cast<std::size_t>(i * kCells + j)];
      surface.count(i, j) = static_cast<int>(cell.count);
      if (cell.count < 2.0) continue;
      surface.mean(i, j) = cell.missing / cell.count;
      surface.rms(i, j) = std::sqrt(cell.residual_square / cell.count);
      surface.standard_error(i, j) = cell.standardError(series.missing_memory);
      explained += cell.count * (square(surface.mean(i, j)) - square(surface.standard_error(i, j)));
    }
  const double whole = sumOfSquares(series.missing);
  if (whole > 0.0) surface.explained_share = std::clamp(explained / whole, 0.0, 1.0);
  return surface;
}

}  // namespace

std::pair<double, double> coveredRange(std::vector<double> values) {
  const std::vector<double> ends = quantiles(std::move(values), {0.5 * (1.0 - kCovered), 0.5 * (1.0 + kCovered)});
  return {ends[0], ends[1]};
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
