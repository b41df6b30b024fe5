#pragma once

#include <cmath>
#include <vector>

#include "suspension_health_monitor/discrepancy/residual_views.h"

namespace suspension_health_monitor {

/// Adjacent bins, summed up.
struct BinRun {
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

/// Decides what is worse than noise.
class BinJudge {
 public:
  /// The arguments must outlive it.
  BinJudge(const ResidualViews& views, const ExpectedNoise& noise);

  /// @return how many standard errors chance passes in none of `tests` two-sided tests, but for one time in 1000.
  static double limitFor(double tests);

  /// @return true if a mean is beyond chance, and more than a quarter of the noise floor.
  bool isForce(double mean, double standard_error, double limit) const;

  /// @return true if a mean square is more than noise: significantly, and by a quarter.
  bool isLoud(double mean_square, double count, double limit) const;

  /// @return rms of the samples that a run leaves out; 0 if there are none.
  double rmsElsewhere(const BinRun& run) const;

  /// @return the two runs of bins with a force of one sign that hold most of it, the stronger first. The second only if
  /// the model is not better in it than elsewhere.
  std::vector<BinRun> forces(const std::vector<ResidualBin>& bins) const;

  /// @return the two runs of loud bins that hold most, each `contrast` times as loud as the rest.
  std::vector<BinRun> loud(const std::vector<ResidualBin>& bins, double contrast) const;

  double numSamples() const { return static_cast<double>(views_.num_samples); }

 private:
  const ResidualViews& views_;
  const ExpectedNoise& noise_;
};

}  // namespace suspension_health_monitor
