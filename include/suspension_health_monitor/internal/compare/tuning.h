#pragma once

#include <cstddef>

namespace suspension_health_monitor {

/// The numbers of a comparison that are no options.
struct CompareTuning {
  double covered = 0.99;            ///< of the samples, by even edges
  double most_time_bins = 24.0;     ///< of all drives together
  double shortest_time_bin = 4.0;   ///< natural periods
  int force_cells = 12;             ///< of the force surface, either way; even: one edge is 0
  std::size_t fewest_samples = 30;  ///< of a bin or a cell: fewer say nothing
  double contrast_in_time = 1.5;    ///< of rmse in a region to rmse elsewhere
  double least_trend = 0.08;        ///< change of a parameter over a drive, of its value
  double negligible = 0.25;         ///< of the noise floor: smaller mean forces are not named
  std::size_t most_ranges = 2;      ///< that are named of one variable
  double fewest_lags = 20.0, most_lags = 500.0;
  double lags_outside = 0.05;           ///< of the lags, by chance
  double memory_periods = 3.0;          ///< natural periods that a correlation is followed over
  std::size_t bins = 28;                ///< of what is missing over one variable
  std::size_t columns = 18, rows = 14;  ///< likewise over two
  std::size_t fewest_in_cell = 3;       ///< samples
  std::size_t probes = 200;             ///< samples that tell whether a law depends on a variable
};

inline constexpr CompareTuning kCompareTuning;

}  // namespace suspension_health_monitor
