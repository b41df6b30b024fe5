#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/blocks/window_fit.h"

namespace suspension_health_monitor {

/// The estimate over a drive of any length: the normal equations of WindowFit, summed block by block with the weights
/// and at the parameters of their time. The equations are linear in b1 and b0 whatever they are weighted by, so that
/// this is consistent; memory and cost do not grow with the drive. Cost per block: O(bands * parameters^2), no
/// allocation.
class DriveFit {
 public:
  static constexpr int kFewestBlocks = 3;  ///< as of the smallest window

  DriveFit(const BlockBand& band, const BlockColumns& columns);

  /// @param weights  of the blocks about this one.  @param theta  parameters then.
  void add(const StrutBlock& block, const BlockWeights& weights, const BlockVector& theta);

  /// @return the estimate of what was added; empty: too little for one.
  std::optional<WindowEstimate> estimate(const BlockPrior& prior) const;

  int blocks() const { return blocks_; }

 private:
  double length_;  // T [s]
  NoiseBands bands_;
  BlockColumns columns_;
  int blocks_ = 0;
  BlockMatrix information_, spread_, scatter_;  // sums of Z'R / s2, Z'Z / s2, and of the scores' products
  BlockVector right_;
  std::vector<BlockVector> previous_;  // scores of the block before, by band
  double body_ = 0.0, unexplained_ = 0.0, rate_ = 0.0, travel_ = 0.0, weight_ = 0.0;
};

}  // namespace suspension_health_monitor
