#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <unsupported/Eigen/MatrixFunctions>

#include "bin_range.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/compare/tuning.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/math/periodogram.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

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
std::optional<ResidualSpectrum> spectrumOf(const ResidualSeries& series, const std::vector<ComparedSegment>& segments,
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

const double kHalfBand =
    normalQuantile(0.5 * kCompareTuning.lags_outside);  // half the band's width, in standard deviations
const double kUnlikely = normalQuantile(0.01);          // of the number of lags outside

/// Response of z'' to a unit sample of w'' through G(s) = (b1 s + b0) / (s^2 + b1 s + b0): e^{At}, held over a sample.
Eigen::VectorXd impulseResponse(const LinearStrut& strut, double period, std::size_t length) {
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
auto crossCorrelation(const ResidualSeries& series, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
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
std::pair<ResidualCorrelation, ResidualCorrelation> correlate(const ResidualSeries& series, const LinearStrut& strut,
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
double memoryOf(const ResidualSeries& series, const Eigen::VectorXd& values) {
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
std::optional<ResidualSeries> makeSeries(const std::vector<ComparedSegment>& segments, const LinearStrut& strut) {
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

const std::vector<double> kShares{0.0, 0.01, 0.03, 0.06, 0.1,  0.2,  0.3,  0.4, 0.5,
                                  0.6, 0.7,  0.8,  0.9,  0.94, 0.97, 0.99, 1.0};
const std::vector<double> kLoopShares{0.0, 0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 1.0};

/// @param bin  whose mean, standard error and rms are sums until finish(): of the missing force, of its squares, and of
/// the residual's squares.
void add(double missing, double residual, ResidualBin& bin) {
  ++bin.count;
  bin.mean += missing;
  bin.standard_error += square(missing);
  bin.rms += square(residual);
}

void finish(double memory, ResidualBin& bin) {
  if (bin.count == 0) return;
  const auto count = static_cast<double>(bin.count);
  bin.mean /= count;
  bin.rms = std::sqrt(bin.rms / count);
  const double variance = std::max(0.0, bin.standard_error / count - square(bin.mean));
  bin.standard_error = count < 2.0 ? 0.0 : std::sqrt(variance * memory / (count - 1.0));
}

std::vector<ResidualBin> binsBetween(const std::vector<double>& edges) {
  std::vector<ResidualBin> bins;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) bins.push_back({edges[i], edges[i + 1]});
  return bins;
}

/// @return the values below which the shares of all lie, each one of the values.
std::vector<double> quantiles(Eigen::VectorXd values, const std::vector<double>& shares) {
  std::sort(values.data(), values.data() + values.size());
  std::vector<double> edges;
  for (const double share : shares)
    edges.push_back(values[std::lround(share * static_cast<double>(values.size() - 1))]);
  return edges;
}

/// Even edges around 0 that cover nearly all values.
std::vector<double> edgesAround0(const Eigen::VectorXd& values) {
  const auto [from, to] = coveredRange(values);
  const double reach = std::max(std::abs(from), std::abs(to));
  return evenEdges(-reach, reach, kCompareTuning.force_cells);
}

/// What one stretch of time says of the strut's numbers: least squares of missing force on (v, d).
/// @param products  of (v, d, missing force) with each other, summed.
void fillErrors(const Eigen::Matrix3d& products, double memory, TimeBin& bin) {
  const Eigen::LDLT<Eigen::Matrix2d> factors(products.topLeftCorner<2, 2>());
  if (bin.count < kFewestForScatter || !(factors.rcond() > 1e-14)) return;
  const Eigen::Vector2d moment = products.topRightCorner<2, 1>(), solution = factors.solve(moment);
  const double variance = std::max(0.0, products(2, 2) - moment.dot(solution)) / (static_cast<double>(bin.count) - 2.0);
  const Eigen::Matrix2d covariance = variance * memory * factors.solve(Eigen::Matrix2d::Identity());
  bin.damping_error = solution[0];
  bin.stiffness_error = solution[1];
  bin.damping_error_stddev = std::sqrt(std::max(0.0, covariance(0, 0)));
  bin.stiffness_error_stddev = std::sqrt(std::max(0.0, covariance(1, 1)));
}

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
  const double width = std::max(duration / kCompareTuning.most_time_bins,
                                kCompareTuning.shortest_time_bin * series.natural_period * series.period);
  std::vector<TimeBin> bins;
  forEachDrive(segments, [&](std::size_t first, std::size_t last, double from, double to) {
    const auto count = static_cast<std::size_t>(std::max(1.0, std::floor((to - from) / width)));
    const std::size_t before = bins.size();
    bins.resize(before + count);
    std::vector<Eigen::Matrix3d> products(count, Eigen::Matrix3d::Zero());
    for (std::size_t s = first; s < last; ++s)
      for (std::size_t k = 0; k < segments[s].size(); ++k) {
        const double share = (segments[s].time(k) - from) / (to - from);
        const std::size_t i = std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)));
        const std::size_t n = series.begins[s] + k;
        add(series.residual[n], series.residual[n], bins[before + i]);
        const Eigen::Vector3d row(series.rate[n], series.travel[n], series.missing[n]);
        products[i] += row * row.transpose();
      }
    for (std::size_t i = 0; i < count; ++i) {
      TimeBin& bin = bins[before + i];
      bin.drive = segments[first].drive;
      bin.from = from + (to - from) * static_cast<double>(i) / static_cast<double>(count);
      bin.to = from + (to - from) * static_cast<double>(i + 1) / static_cast<double>(count);
      finish(series.residual_memory, bin);
      fillErrors(products[i], series.missing_memory, bin);
    }
  });
  return bins;
}

/// @param x  one value per sample.
std::vector<ResidualBin> binByQuantile(const ResidualSeries& series, const Eigen::VectorXd& x) {
  const std::vector<double> edges = quantiles(x, kShares);
  std::vector<ResidualBin> bins = binsBetween(edges);
  for (std::size_t n = 0; n < series.size(); ++n) add(series.missing[n], series.residual[n], bins[binOf(edges, x[n])]);
  for (ResidualBin& bin : bins) finish(series.missing_memory, bin);
  return bins;
}

DirectionLoop compareDirections(const ResidualSeries& series) {
  const std::vector<double> edges = quantiles(series.travel, kLoopShares);
  DirectionLoop loop;
  loop.compressing = loop.extending = binsBetween(edges);
  for (std::size_t n = 0; n < series.size(); ++n)
    add(series.missing[n], series.residual[n],
        (series.rate[n] > 0.0 ? loop.compressing : loop.extending)[binOf(edges, series.travel[n])]);
  double weight = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < loop.compressing.size(); ++i) {
    ResidualBin &c = loop.compressing[i], &e = loop.extending[i];
    for (ResidualBin* bin : {&c, &e}) finish(series.missing_memory, *bin);
    if (std::min(c.count, e.count) < kFewestForScatter) continue;
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
  constexpr int cells = kCompareTuning.force_cells;  // either way
  ForceSurface surface;
  surface.travel_edges = edgesAround0(series.travel);
  surface.rate_edges = edgesAround0(series.rate);
  std::vector<ResidualBin> bins(cells * cells);
  for (std::size_t n = 0; n < series.size(); ++n)
    add(series.missing[n], series.residual[n],
        bins[binOf(surface.travel_edges, series.travel[n]) * cells + binOf(surface.rate_edges, series.rate[n])]);
  surface.mean = surface.standard_error = surface.rms = Eigen::MatrixXd::Zero(cells, cells);
  surface.count = Eigen::MatrixXi::Zero(cells, cells);
  double explained = 0.0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      ResidualBin& cell = bins[i * cells + j];
      finish(series.missing_memory, cell);
      surface.count(i, j) = static_cast<int>(cell.count);
      if (cell.count < 2) continue;
      surface.mean(i, j) = cell.mean;
      surface.rms(i, j) = cell.rms;
      surface.standard_error(i, j) = cell.standard_error;
      explained += static_cast<double>(cell.count) * (square(cell.mean) - square(cell.standard_error));
    }
  const double whole = series.missing.squaredNorm();
  if (whole > 0.0) surface.explained_share = std::clamp(explained / whole, 0.0, 1.0);
  return surface;
}

}  // namespace

std::pair<double, double> coveredRange(Eigen::VectorXd values) {
  const std::vector<double> ends =
      quantiles(std::move(values), {0.5 * (1.0 - kCompareTuning.covered), 0.5 * (1.0 + kCompareTuning.covered)});
  return {ends[0], ends[1]};
}

std::optional<ResidualViews> viewResidual(const std::vector<ComparedSegment>& segments, const LinearStrut& strut,
                                          const NoiseFloor& noise_floor) {
  const std::optional<ResidualSeries> series = makeSeries(segments, strut);
  if (!series) return std::nullopt;
  const auto count = static_cast<double>(series->size());
  ResidualViews views;
  views.offset = series->offset;
  views.rms = series->residual.norm() / std::sqrt(count);
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
