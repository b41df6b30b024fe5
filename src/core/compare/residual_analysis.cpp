#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "bin_range.h"
#include "residual_series.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/compare/tuning.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

const std::vector<double> kShares{0.0, 0.01, 0.03, 0.06, 0.1,  0.2,  0.3,  0.4, 0.5,
                                  0.6, 0.7,  0.8,  0.9,  0.94, 0.97, 0.99, 1.0};
const std::vector<double> kLoopShares{0.0, 0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 1.0};

/// Sums over the samples of a bin.
struct BinSums {
  double count = 0.0, missing = 0.0, missing_square = 0.0, residual_square = 0.0;

  void add(double m, double r) {
    count += 1.0;
    missing += m;
    missing_square += square(m);
    residual_square += square(r);
  }

  void fill(double memory, ResidualBin& bin) const {
    bin.count = static_cast<std::size_t>(count);
    if (count == 0.0) return;
    bin.mean = missing / count;
    bin.rms = std::sqrt(residual_square / count);
    if (count < 2.0) return;
    const double variance = std::max(0.0, missing_square / count - square(bin.mean));
    bin.standard_error = std::sqrt(variance * memory / (count - 1.0));
  }
};

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
    std::vector<BinSums> sums(count);
    std::vector<Eigen::Matrix3d> products(count, Eigen::Matrix3d::Zero());
    for (std::size_t s = first; s < last; ++s)
      for (std::size_t k = 0; k < segments[s].size(); ++k) {
        const double share = (segments[s].time(k) - from) / (to - from);
        const std::size_t i = std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)));
        const std::size_t n = series.begins[s] + k;
        sums[i].add(series.residual[n], series.residual[n]);
        const Eigen::Vector3d row(series.rate[n], series.travel[n], series.missing[n]);
        products[i] += row * row.transpose();
      }
    for (std::size_t i = 0; i < count; ++i) {
      TimeBin& bin = bins.emplace_back();
      bin.drive = segments[first].drive;
      bin.from = from + (to - from) * static_cast<double>(i) / static_cast<double>(count);
      bin.to = from + (to - from) * static_cast<double>(i + 1) / static_cast<double>(count);
      sums[i].fill(series.residual_memory, bin);
      fillErrors(products[i], series.missing_memory, bin);
    }
  });
  return bins;
}

/// @param x  one value per sample.
std::vector<ResidualBin> binByQuantile(const ResidualSeries& series, const Eigen::VectorXd& x) {
  const std::vector<double> edges = quantiles(x, kShares);
  std::vector<BinSums> sums(edges.size() - 1);
  for (std::size_t n = 0; n < series.size(); ++n) sums[binOf(edges, x[n])].add(series.missing[n], series.residual[n]);
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
  std::vector<BinSums> sums(cells * cells);
  for (std::size_t n = 0; n < series.size(); ++n)
    sums[binOf(surface.travel_edges, series.travel[n]) * cells + binOf(surface.rate_edges, series.rate[n])].add(
        series.missing[n], series.residual[n]);
  surface.mean = surface.standard_error = surface.rms = Eigen::MatrixXd::Zero(cells, cells);
  surface.count = Eigen::MatrixXi::Zero(cells, cells);
  double explained = 0.0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      ResidualBin cell;
      sums[i * cells + j].fill(series.missing_memory, cell);
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
