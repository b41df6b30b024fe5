#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/blocks/strut_equations.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// @return b1 [1/s], at least that of kBlockTuning.least_damping.
inline double leastDamping(double b1, double b0) {
  return std::max(b1, 2.0 * kBlockTuning.least_damping * std::sqrt(b0));
}

/// A value of each band of the noise, without the heap.
using BandVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, NoiseBands::kMost, 1>;

/// What is known of the parameters before the data of a window: independent normal distributions.
struct BlockPrior {
  BlockVector mean, stddev;  ///< infinite: nothing is known
};

/// The parameters of a window of blocks, and how sure they are.
struct WindowEstimate {
  int blocks = 0;          ///< of the window
  BlockVector theta;       ///< as BlockParameter, then the columns
  BlockMatrix covariance;  ///< of theta
  double inflation = 1.0;  ///< of the covariance: cells scatter so much more than their noise explains
  double explained = 0.0;  ///< share of the body's power
  double alike = 0.0;      ///< relative standard deviation of b1 or b0 by noise of neighbours' wheels, see WindowFit
  bool is_settled = true;  ///< the equations are solved where b1 and b0 are above 0, to a standard deviation
  double amplified = 0.0;  ///< power of the body's motion over that of the wheel's
  double rate = 0.0;       ///< rms of the travel rate [m/s]
  double travel = 0.0;     ///< rms of the travel [m]
  double roughest = 1.0;   ///< information of the best quarter of the window, of four in turn, over the mean one's
  double age = 0.0;        ///< of the information on b1, b0, before the end of the newest block [s]
  std::optional<ChangedStretch> change;  ///< of a whole drive
  BandVector noise;                      ///< power of e per bin of each band: the unexplained spectrum

  /// @param i  b1 or b0. A damping below kBlockTuning.least_damping is known as well as that one is: a strut without a
  /// damper is one, too.
  double relativeStddev(int i) const {
    return std::sqrt(covariance(i, i)) / (i == kBlockDamping ? leastDamping(theta[0], theta[1]) : theta[i]);
  }
  /// @param powers  means over blocks of the sums over bins. By Parseval the mean square of a signal over a block of
  /// length T is 2 / (T^2 mean(hann^2)) times that, mean(hann^2) = 3/8.
  void setMotion(const StrutBlock::Band::Powers& powers, double length) {
    rate = std::sqrt(2.0 * powers[StrutBlock::Band::kRate] / 0.375) / length;
    travel = std::sqrt(2.0 * powers[StrutBlock::Band::kTravel] / 0.375) / length;
  }
  /// @return g: friction f acts as g f of b1 [s/m]. Of a normal distribution of the rate the least squares line through
  /// Coulomb's law has this slope.
  double frictionGain() const { return rate > 0.0 ? std::sqrt(2.0 / M_PI) / rate : 0.0; }
  /// @pre the first force is dry friction.
  DryFriction dryFriction() const {
    constexpr int i = kNumBlockParameters;
    const double gain = frictionGain();
    return {theta[i], std::sqrt(covariance(i, i)), gain, covariance(0, i), gain * rate / travel};
  }
  bool isUsable() const;  ///< finite, with b1, b0 above 0
  double worst() const { return std::max(relativeStddev(kBlockDamping), relativeStddev(kBlockStiffness)); }
};

/// What blocks are weighted by: the noise's spectrum and its share in the wheel's motion.
struct BlockWeights {
  BandVector noise;        ///< s2, by band
  BandVector share_scale;  ///< s2 over the power of the wheel's motion: the scale of the column of r
  BandVector median;       ///< of the blocks: power of e per bin, by band; empty: not known yet

  /// @return power of e of a block over the median, mean over the bands; the median has to be known.
  /// @param power  of e per bin, by band.
  double overMedian(const Eigen::Ref<const Eigen::ArrayXd>& power) const { return (power / median.array()).mean(); }
  /// @param power  of e per bin of a block, by band.
  /// @return 1, or less for a block that is much noisier than the median.
  double of(const Eigen::Ref<const Eigen::ArrayXd>& power) const;
};

/// Power of the residual at theta in a band, or in a sum of bands. It is linear in the parameters, but for r, which it
/// does not depend on, and for the weight 1 / A.
double residualPower(const Eigen::MatrixXd& moments, const BlockVector& theta);

/// The same per bin of every band of a block.
BandVector residualPowers(const StrutBlock& block, const NoiseBands& bands, const BlockVector& theta);

/// The score Z'e of a band at theta, and its information, with the column of r scaled.
BlockVector scoreOf(const StrutBlock::Band& band, const BlockVector& theta, double share_scale);
BlockMatrix withShare(const Eigen::MatrixXd& products, double share_scale);

/// Solves normal equations whose units differ by orders of magnitude.
/// @return the inverse of `normal`, and the solution: not finite if there is none.
std::pair<BlockMatrix, BlockVector> solvedNormal(const BlockMatrix& normal, const BlockVector& right);

/// @return the covariance of parameters by noise alone, H^-1 (c Z'Z + P) H^-1': bins under a Hann window are
/// correlated, and so are blocks that overlap by half (c). Where the wheel's motion is little more than noise the
/// regressors have parts that the instruments know nothing of, so that Z'Z is not H.
/// @param instruments  sum of Z'Z / s2.  @param inverse  H^-1.
BlockMatrix covarianceByNoise(const BlockMatrix& instruments, const BlockMatrix& inverse, const BlockPrior& prior,
                              int blocks);

/// What noise of power 1 of every wheel of a vehicle does in one band of a strut top's equations.
struct WheelNoise {
  BlockMatrix information;  ///< that it adds to Z'R, per block
  double output = 0.0;      ///< its power in e, per bin
};

/// Weighted least squares with instruments over a window of linearised blocks.
///
/// The power s2 of e in each band is measured: the mean of the window's cells (block times band) at the estimate. It
/// weights the bins, so that what the strut does not explain, whatever it is, counts as little as it should:
///     theta = (sum Z'R / s2 + P)^-1 (sum Z'(e + R theta_at) / s2 + P mean),  P = diag(1 / prior variance).
/// A block that is much noisier than the median counts less (BlockWeights). Covariance: bins under a Hann window are
/// correlated, and so are blocks that overlap by half (kBinCorrelation, kBlockCorrelation), times the factor by which
/// the scores of cells scatter more than that. Source: Pintelon, Schoukens (2012), ch. 9 and 11; sandwich covariance
/// after P. J. Huber, The behavior of maximum likelihood estimates under nonstandard conditions (1967).
///
/// Noise of the neighbours' wheels is in their regressors and in all instruments, and counts as information N of the
/// sum I. It draws coefficients to those of struts that move like them by I^-1 N theta: nothing, unless the struts move
/// so much alike that noise tells them apart. Then theta is not known, but for its size, that of the own b1 and b0:
///     covariance + I^-1 N diag(size^2) N' I^-1'.
/// Its power is what the band with least of it in e lets it have, if the body's sensor is as noisy as the wheels'.
/// Windows that are nested share their sums. Cost: O(blocks * bands *
/// parameters^2), no allocation after the construction.
class WindowFit {
 public:
  /// A score is a real part, which has half of the power of complex noise: sums of squared correlations over two.
  static constexpr double kBinCorrelation = 0.972;    ///< (1 + 2 ((2/3)^2 + (1/6)^2)) / 2, of Hann bins
  static constexpr double kBlockCorrelation = 0.083;  ///< that of neighbouring blocks, which overlap by half

  WindowFit(const BlockBand& band, const BlockColumns& columns, int most_blocks);

  /// @param blocks  linearised, the newest last.
  /// @param start  of the iteration over weights.
  /// @param median  of the blocks: power of e per bin of each band; empty: not known yet.
  /// @param least_inflation  that is known from other windows.
  /// @param is_near  most blocks are of the strut at start: they are weighed there first, as one blow that outweighs
  /// all else would draw a fit to itself that begins with equal weights. These find a strut that has changed sooner.
  void fit(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, const BlockVector& start,
           const BandVector& median, double least_inflation, WindowEstimate& result, bool is_near = false);

  /// @param each  by band; empty: a strut alone.
  void setWheelNoise(const std::vector<WheelNoise>& each) { wheel_noise_ = each; }

  /// @return power of e per bin, bands by blocks, of the newest fit.
  auto power() const { return power_.leftCols(blocks_); }

  /// @return those of the newest fit, without the median.
  const BlockWeights& weights() const { return weights_; }

  /// @return true if the two sensors' gains differ by more than links and laws with memory make of them. A gain is the
  /// same at all frequencies. What a spring with memory makes of it differs between bands by half of itself and more;
  /// so does what the other struts of a vehicle do, where bands tell nothing.
  /// @param estimate  of the newest fit.
  bool gainsDiffer(const WindowEstimate& estimate) const;

  /// @return median over blocks that share no reading of the squared distance between their own b1, b0, over what noise
  /// makes of it, at least 1; of the newest fit.
  double scatterBetweenBlocks(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta);

 private:
  void gather(const std::vector<const StrutBlock*>& blocks);
  bool weigh(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta);
  void measureNoise(const BlockVector& theta);
  void sum(const BlockPrior& prior);
  void widenByAlike(const BlockMatrix& inverse, WindowEstimate& result);
  void describe(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, double least_inflation,
                WindowEstimate& result);
  double inflation(const std::vector<const StrutBlock*>& blocks, const WindowEstimate& result,
                   const BlockMatrix& inverse, const BlockPrior& prior);

  double length_;  // T [s]
  NoiseBands bands_;
  BlockColumns columns_;
  int blocks_ = 0;
  Eigen::ArrayXXd power_;  // of e per bin, bands by blocks
  Eigen::ArrayXd weight_;  // of blocks, the newest first
  Eigen::ArrayXd present_;
  std::vector<StrutBlock::Band> sums_;  // by band, over the newest gathered_ blocks, weighted
  std::vector<long> versions_;
  int gathered_ = 0;
  double sum_of_weights_ = 0.0;
  std::vector<WheelNoise> wheel_noise_;  // by band
  BlockWeights weights_;
  BlockMatrix normal_, spread_;  // sums of Z'R / s2 and of Z'Z / s2; the former with the prior's
  BlockVector right_;
  Eigen::Vector2d solved_ = Eigen::Vector2d::Zero();  // b1, b0 as the equations have them
  Eigen::Matrix2Xd previous_;                         // by band
  std::vector<double> distances_;
  std::vector<Eigen::Vector2d> own_;
  std::vector<Eigen::Matrix2d> own_covariance_;
};

}  // namespace suspension_health_monitor
