#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "suspension_health_monitor/residual_views.h"

namespace suspension_health_monitor {

/// Adjacent bins, summed up.
struct BinRange {
  double from = 0.0, to = 0.0;  // edges
  double count = 0.0, sum = 0.0, squares = 0.0;

  void add(const ResidualBin& bin) {
    const auto n = static_cast<double>(bin.count);
    count += n;
    sum += n * bin.mean;
    squares += n * bin.rms * bin.rms;
    to = bin.to;
  }
  double mean() const { return sum / count; }
  double rms() const { return std::sqrt(squares / count); }
};

/// Ranges of adjacent bins with the same mark; mark 0 is none.
inline std::vector<BinRange> rangesOf(const std::vector<ResidualBin>& bins, const std::vector<int>& marks) {
  std::vector<BinRange> ranges;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (marks[i] == 0) continue;
    if (i == 0 || marks[i] != marks[i - 1]) ranges.push_back({bins[i].from});
    ranges.back().add(bins[i]);
  }
  return ranges;
}

/// @return the edges of so many bins of one width.
inline std::vector<double> evenEdges(double from, double to, std::size_t bins) {
  std::vector<double> edges;
  for (std::size_t i = 0; i <= bins; ++i)
    edges.push_back(from + (to - from) * (static_cast<double>(i) / static_cast<double>(bins)));
  return edges;
}

/// The bin of a value; the outermost take in what lies beyond.
inline std::size_t binOf(const std::vector<double>& edges, double value) {
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return static_cast<std::size_t>(above - edges.begin()) - 1;
}

/// The narrowest band that holds a share of a density, as [first, last).
inline std::pair<std::size_t, std::size_t> narrowestBand(const std::vector<double>& density, double share) {
  const double wanted = share * std::accumulate(density.begin(), density.end(), 0.0);
  std::pair<std::size_t, std::size_t> best{0, density.size()};
  double inside = 0.0;
  for (std::size_t first = 0, last = 0; last < density.size();) {
    inside += density[last++];
    while (inside - density[first] >= wanted) inside -= density[first++];
    if (inside >= wanted && last - first < best.second - best.first) best = {first, last};
  }
  return best;
}

}  // namespace suspension_health_monitor
