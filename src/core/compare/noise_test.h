#pragma once

#include <cmath>
#include <vector>

#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {

/// Adjacent bins, summed up.
struct BinRange {
  std::size_t first = 0, last = 0;  // last is one past the end
  double count = 0.0, sum = 0.0, squares = 0.0;

  void add(const ResidualBin& bin) {
    const auto n = static_cast<double>(bin.count);
    count += n;
    sum += n * bin.mean;
    squares += n * bin.rms * bin.rms;
  }
  double mean() const { return sum / count; }
  double rms() const { return std::sqrt(squares / count); }
};

/// Tests whether bins of a view show more than noise.
class NoiseTest {
 public:
  static constexpr int kFewest = 30;  ///< samples of a bin or a cell: fewer say nothing

  /// The arguments must outlive it.
  NoiseTest(const ResidualViews& views, double noise_floor);

  /// @return how many standard errors chance passes in none of `tests` two-sided tests, but with probability
  /// kFalseAlarm.
  static double limitFor(double tests) { return normalQuantile(0.5 * kFalseAlarm / tests); }

  /// @return true if a mean is beyond chance, and more than a quarter of the noise floor.
  bool isForce(double mean, double standard_error, double limit) const;

  /// @return true if a mean square is more than noise: significantly, and by so much that what is
  /// left counts as structure (kStructured).
  bool exceedsNoise(double mean_square, double count, double limit) const;

  /// @return rms of the samples that a range leaves out; 0 if there are none.
  double rmsElsewhere(const BinRange& range) const;

  /// @return the two ranges of bins with a force of one sign that hold most of it, the stronger first. The second only
  /// if the model is not better in it than elsewhere.
  std::vector<BinRange> forces(const std::vector<ResidualBin>& bins) const;

  /// @return the two ranges of bins whose residual is more than noise, those that hold most of it, each with `contrast`
  /// times the rms of the samples elsewhere.
  std::vector<BinRange> noisy(const std::vector<ResidualBin>& bins, double contrast) const;

  double numSamples() const { return static_cast<double>(views_.num_samples); }

 private:
  const ResidualViews& views_;
  double noise_floor_;
};

}  // namespace suspension_health_monitor
