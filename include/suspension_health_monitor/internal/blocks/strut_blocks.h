#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"
#include "suspension_health_monitor/internal/blocks/sliding_friction.h"

namespace suspension_health_monitor {

/// What the blocks tell of a strut.
struct BlockEstimate : WindowEstimate {
  Stamp stamp{};              ///< end of the newest block
  double length = 0.0;        ///< T of its blocks [s]
};

/// From the readings of a strut's two sensors, each on its own stamps, to estimates after every half block:
/// FourierIntegrals -> StrutBlock -> BlockEstimator. Readings may come in any order between the streams, as long as
/// none runs four blocks ahead. The blocks' length follows the bounce: from some two to kMostPeriods of it in a
/// block.
class StrutBlocks {
 public:
  /// @param period  the longest sampling time of the two streams [s].
  /// @param effects  columns that come by pushForces(); none: dry friction is looked for.
  StrutBlocks(const BlockOptions& options, double period, std::size_t effects = 0);

  /// Takes in one reading. Where the stamps of a stream go back the blocks begin anew (restart()).
  /// @return the estimate if this reading completes a block; nullptr else.
  const BlockEstimate* push(Side side, Stamp stamp, double acceleration);

  /// Takes in both sensors' readings of one instant, if both are numbers.
  /// @param lag  by which the body's clock is late, as far as it is known.
  const BlockEstimate* push(const CornerSample& sample, Stamp lag = {});

  /// Takes in the effects' forces over the body's mass at one instant, by their present coefficients' unit.
  const BlockEstimate* pushForces(Stamp stamp, const double* forces);

  /// @return the newest estimate; nullptr: none yet.
  const BlockEstimate* estimate() const { return has_estimate_ ? &estimate_ : nullptr; }
  const BlockEstimator& estimator() const { return *estimator_; }

  /// @return over all readings so far, before restart(), too; empty: too little is known. Not for the sample path.
  std::optional<BlockEstimate> overTheDrive();

  /// Another drive, perhaps of another vehicle: nothing is known any more, but to overTheDrive().
  void restart();

 private:
  static constexpr double kLeastUpperEdge = 2.5, kMostPeriods = 6.0;  // of the bounce in a block; 1.6 of a usual one

  void begin(double length);
  const BlockEstimate* takeBlocks();
  bool isPassed(long half) const;
  void fill(long half, StrutBlock& block);
  void follow(double damping, double stiffness);

  BlockOptions options_;
  double period_;
  std::size_t effects_;
  std::optional<Stamp> origin_;
  std::array<std::optional<Stamp>, 2> last_;  // of the sprung and the unsprung sensor
  std::optional<BlockEstimator> estimator_;
  std::vector<FourierIntegrals> streams_;  // sprung, unsprung with friction, effects
  std::optional<SlidingFriction> friction_;
  Eigen::ArrayXcd body_;  // integrals of z'' of the block that is filled
  long next_half_ = 1;    // the second half of the next block
  BlockEstimate estimate_;
  bool has_estimate_ = false;
};

}  // namespace suspension_health_monitor
