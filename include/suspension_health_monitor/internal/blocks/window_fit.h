#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "suspension_health_monitor/internal/blocks/strut_equations.h"

namespace suspension_health_monitor {

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
  double explained = 0.0;  ///< share of the body's power by b1 and b0 alone
  double alike = 0.0;      ///< relative standard deviation of b1 or b0 by noise of neighbours' wheels, see WindowFit
  double rate = 0.0;       ///< rms of the travel rate [m/s]
  double age = 0.0;        ///< of the information on b1, b0, before the end of the newest block [s]
  Eigen::VectorXd noise;   ///< power of e per bin of each band: the unexplained spectrum

  double relativeStddev(int i) const { return std::sqrt(covariance(i, i)) / theta[i]; }
  bool isUsable() const;  ///< finite, with b1, b0 above 0
  double worst() const { return std::max(relativeStddev(kBlockDamping), relativeStddev(kBlockStiffness)); }
};

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
/// A block that is unusual(ly noisy) counts less (BlockWeights). Covariance: bins under a Hann window are correlated,
/// and so are blocks that overlap by half (kBinCorrelation, kBlockCorrelation), times the factor by which the scores of
/// cells scatter more than that. Source: Pintelon, Schoukens (2012), ch. 9 and 11; sandwich covariance after P. J.
/// Huber, The behavior of maximum likelihood estimates under nonstandard conditions (1967).
///
/// Noise of the neighbours' wheels is in their regressors and in all instruments, and counts as information N of the sum
/// I. It draws coefficients to those of struts that move like them by I^-1 N theta: nothing, unless the struts move so
/// much alike that noise tells them apart. Then theta is not known, but for its size, that of the own b1 and b0:
///     covariance + I^-1 N diag(size^2) N' I^-1'.
/// Its power is what the band with least of it in e lets it have, if the body's sensor is as noisy as the wheels'.
/// Cost: O(blocks * bands *
/// parameters^2), no allocation after the construction.
class WindowFit {
 public:
  static constexpr double kBinCorrelation = 1.944;    ///< 1 + 2 ((2/3)^2 + (1/6)^2): squared correlations of Hann bins
  static constexpr double kBlockCorrelation = 0.167;  ///< that of half overlapped blocks, summed likewise

  WindowFit(const NoiseBands& bands, const BlockColumns& columns, int most_blocks);

  /// Blocks are new, or have been linearised anew: to be called before the next fit(). Otherwise the blocks of each
  /// fit() are those of the one before it, some of the newest of them, or these and older ones.
  void newBlocks();

  /// @param blocks  linearised, the newest last.
  /// @param prior  as it is.  @param start  of the iteration over weights.
  /// @param usual  power of e per bin of each band of usual blocks; empty: not known yet.
  /// @param least_inflation  that is known from other windows.
  void fit(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, const BlockVector& start,
           const Eigen::VectorXd& usual, double least_inflation, WindowEstimate& result);

  /// @param each  by band; empty: a strut alone.
  void setWheelNoise(const std::vector<WheelNoise>& each) { wheel_noise_ = each; }

  /// @return power of e per bin, blocks by bands, of the newest fit.
  auto power() const { return power_.topRows(blocks_); }

  /// @return median over blocks that share no reading of the squared distance between their own b1, b0, over what noise
  /// makes of it, at least 1; of the newest fit.
  double scatterBetweenBlocks(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta);

 private:
  /// Of blocks of a band, weighted.
  struct Sum {
    Eigen::MatrixXd information, moments;
    Eigen::VectorXd score, share;
    double wheel_power = 0.0;

    void setZero();
    void add(double weight, const StrutBlock::Band& band);
  };

  void gather(const std::vector<const StrutBlock*>& blocks);
  bool weigh(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta, const Eigen::VectorXd& usual);
  void measureNoise(const BlockVector& theta);
  bool solve(const BlockPrior& prior, BlockVector& theta);
  void describe(const std::vector<const StrutBlock*>& blocks, const BlockPrior& prior, double least_inflation,
                WindowEstimate& result);
  void widenByAlike(WindowEstimate& result);
  void takeScore(const StrutBlock& block, int b, int i, const BlockVector& theta);
  double inflation(const std::vector<const StrutBlock*>& blocks, const BlockVector& theta,
                   const Eigen::Matrix2d& covariance);

  NoiseBands bands_;
  BlockColumns columns_;
  int blocks_ = 0;
  Eigen::ArrayXXd power_;                // of e per bin, blocks by bands
  Eigen::ArrayXd weight_;                // of blocks, the newest first
  std::vector<Sum> sums_;                // by band, over the newest gathered_ blocks
  int gathered_ = 0;
  double weights_ = 0.0;
  std::vector<WheelNoise> wheel_noise_;  // by band
  BlockVector size_;
  Eigen::VectorXd noise_, share_scale_;  // s2 and that of the column of r, by band
  BlockMatrix normal_, inverse_, prior_information_;
  Eigen::Matrix2Xd previous_;  // by band
  BlockVector right_, step_, scale_;
  Eigen::PartialPivLU<BlockMatrix> lu_;
  std::vector<double> medians_;
  std::vector<Eigen::Vector2d> own_;
  std::vector<Eigen::Matrix2d> own_covariance_;
};

}  // namespace suspension_health_monitor
