#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"

namespace suspension_health_monitor {

/// How far two models differ on the same held-out stretches: paired t test and likelihood ratio.
struct PairedTest {
  double removed_share = 0.0;  ///< 1 - (mean square after) / (mean square before)
  double t = 0.0;              ///< mean difference of a stretch over its standard error
  double log_ratio = 0.0;      ///< likelihood ratio n ln(before / after) for n independent squared residuals
};

/// @param before, after  sums of squares by stretch, of equal length >= 2.
/// @param independent  how many independent squared residuals `before` is worth, see HoldOut::independentSquares().
PairedTest testPaired(const std::vector<double>& before, const std::vector<double>& after, double independent);

/// @return true if chance alone gets so far with at most the given probability. One way of looking is enough: t is weak
/// where an effect acts in a few violent moments, the likelihood ratio where it acts gently all the time.
bool isSignificant(const PairedTest& comparison, double probability);

/// Hold-out validation: which samples are fitted and which are kept to compare models by. Contiguous blocks, every
/// third one held out (but for the first two natural periods of a segment). The held-out blocks are cut into stretches
/// of one natural period, about as long as the free run remembers.
class HoldOut {
 public:
  std::vector<SampleMask> training;  ///< per segment of all records

  /// @param residuals  per segment of all records, as ModelFit has them.
  /// @param outlier  a [m/s^2], > 0, of the loss that fits minimise: 2 a^2 (sqrt(1 + (r/a)^2) - 1). It is softer on
  /// outliers than r^2, which it is without `outlier`: a few blows do not decide what is missing.
  /// @return sum of losses of each held-out stretch.
  std::vector<double> stretchLosses(const Residuals& residuals,
                                    double outlier = std::numeric_limits<double>::infinity()) const;

  /// How many independent squares the held-out residuals are worth, being coloured: N / (1 + 2 sum_k rho_k^2), rho
  /// their autocorrelation at the lags of up to one stretch. Bartlett, "On the theoretical specification and sampling
  /// properties of autocorrelated time-series", Supplement to the Journal of the Royal Statistical Society 8 (1946).
  double independentSquares(const Residuals& residuals) const;

  /// @return sum of squared residuals of the training samples.
  double trainingError(const Residuals& residuals) const;

  double rmse(const Residuals& residuals) const;

  /// @return 100 (1 - rmse / standard deviation of the held-out measurement).
  double fitPercent(double rmse) const { return 100.0 * (1.0 - rmse / deviation_); }

  /// @return sum of squares of the held-out measurement about its mean.
  double measuredSquares() const { return samples_ * deviation_ * deviation_; }

 private:
  friend std::optional<HoldOut> splitHoldOut(const Records& records, double stiffness_to_mass);

  struct Stretch {
    std::size_t segment, first, last;  // last is one past the end
  };

  std::vector<Stretch> stretches_;
  double samples_ = 0.0;
  double deviation_ = 0.0;
};

/// Natural periods without a gap that have eight held-out stretches, and blocks of a record: longer than a natural
/// period, the five held out have two stretches.
inline constexpr double kEnoughPeriods = 15.0;

/// @return nothing if there are fewer than eight held-out stretches.
std::optional<HoldOut> splitHoldOut(const Records& records, double stiffness_to_mass);

}  // namespace suspension_health_monitor
