#pragma once

#include <array>
#include <boost/circular_buffer.hpp>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/blocks/window_fit.h"

namespace suspension_health_monitor {

/// Windows [blocks]. The largest is a minute at T = 2 s: far longer than a damper stays the same temperature, shorter
/// than health/oldest_data asks for.
inline constexpr std::array kBlockWindows{3, 4, 6, 8, 12, 16, 24, 32, 48, 64};

/// The estimate over a drive of any length: the normal equations of WindowFit, summed block by block with the weights
/// and at the parameters of their time. The equations are linear in b1 and b0 whatever they are weighted by, so that
/// this is consistent; memory and cost do not grow with the drive. The sums are kept at up to 16 instants, evenly
/// spread over the drive, so that every stretch between two of them can be compared with the rest. Cost per block:
/// O(bands * parameters^2), no allocation.
class DriveFit {
 public:
  DriveFit(const BlockBand& band, const BlockColumns& columns);

  /// @param weights  of the blocks about this one.  @param theta  parameters then.
  void add(const StrutBlock& block, const BlockWeights& weights, const BlockVector& theta);

  /// @return the estimate of what was added; empty: too little for one.
  std::optional<WindowEstimate> estimate(const BlockPrior& prior) const;

  int blocks() const { return all_.blocks; }

 private:
  /// Sums over blocks.
  struct Sums {
    int blocks = 0;
    Eigen::MatrixXd information, spread, scatter;  // of Z'R / s2, Z'Z / s2, and of the scores' products
    Eigen::VectorXd right;
    StrutBlock::Band::Powers powers = StrutBlock::Band::Powers::Zero();
    double unexplained = 0.0, weight = 0.0;

    Sums operator-(const Sums& other) const;
  };
  /// An even number. When the list is full, every second instant is dropped: a long drive keeps 8 to 16.
  static constexpr std::size_t kMostInstants = 16;

  std::optional<WindowEstimate> estimate(const Sums& sums, const BlockPrior& prior) const;
  void findChange(const BlockPrior& prior, WindowEstimate& whole) const;

  double length_;  // T [s]
  NoiseBands bands_;
  BlockColumns columns_;
  Sums all_;
  std::vector<Sums> before_;           // of the blocks before each instant; only the first num_instants_ count
  std::size_t num_instants_ = 1;       // the start of the drive
  int blocks_between_ = 1;             // two instants
  std::vector<BlockVector> previous_;  // scores of the block before, by band
};

/// The newest blocks of one strut top and the estimate that they give.
///
/// The window is the smallest one that knows b1 and b0 well enough (kBlockTuning.enough), or the one that knows them
/// best: short on a rough road, long on a smooth one, with no memory to choose. What changes slowly, the delay, the
/// forces' columns and the neighbours', is known from all blocks and comes to a window as its prior; if the newest
/// blocks contradict that, the windows begin without it. Blocks are linearised at the estimate of their time, and again
/// where that is stale. Cost per block: some ten linearisations at most, after the start; no allocation.
class BlockEstimator {
 public:
  BlockEstimator(const BlockBand& band, const BlockColumns& columns);

  /// @return the place of the next block, to be filled; the newest then is the one before.
  StrutBlock& next();

  /// Takes in the block that next() gave.
  /// @return the estimate; nullptr: none yet, or too little is known.
  const WindowEstimate* update();

  /// @return of all blocks kept, with the data alone, up to kSlowEvery blocks ago.
  const std::optional<WindowEstimate>& ofAllBlocks() const { return of_all_; }

  /// @return of some of the blocks kept, with the data alone; nothing if they do not tell. Not for the sample path.
  /// @param from  age of the newest block, 0: of all.  @param count  blocks.
  std::optional<WindowEstimate> ofBlocks(int from, int count);

  /// @param each  as WindowFit::setWheelNoise.
  void setWheelNoise(const std::vector<WheelNoise>& each) { window_fit_.setWheelNoise(each); }

  /// A block that is kept, 0 the newest, to have its instruments predicted again: then call linearise() with it.
  StrutBlock& block(int age) { return ring_.rbegin()[age]; }
  const StrutBlock& block(int age) const { return ring_.rbegin()[age]; }
  int count() const { return count_; }                        ///< blocks kept
  int numBlocks() const { return drive_.blocks() + count_; }  ///< since the start
  void linearise(StrutBlock& block) { equations_.linearise(theta_, block); }

  /// Forgets what all blocks told of slow parameters, as they told it before the wheels' noise was known.
  void forgetSlow();

  /// What is known of a slow parameter from all blocks is so many times as large now, as a neighbour's coefficient is
  /// that has changed with its strut.  @param stddev  of the factor.
  void scaleSlow(int parameter, double factor, double stddev);

  /// @return the estimate over all blocks so far, those of `before` among them; empty: too little is known. Of no more
  /// blocks than are kept it is iterated until it stands still. Not for the sample path.
  std::optional<WindowEstimate> overTheDrive();

  /// Another drive, perhaps of another vehicle: nothing is known any more, but to overTheDrive().
  void restart();

  const StrutEquations& equations() const { return equations_; }
  const BlockVector& theta() const { return theta_; }  ///< to linearise at, and for models
  bool hasTheta() const { return has_theta_; }

  /// @return true if there are blocks enough for an estimate.
  bool hasBlocks() const { return count_ >= kBlockWindows.front(); }

  /// @return true if the newest blocks alone tell nothing of the strut.
  bool newestSayNothing() const { return !(newest_worst_ < kBlockTuning.says_nothing); }

  /// Goes on with this estimate, as of blocks of another length.
  void begin(const BlockVector& theta, const BlockPrior& slow);
  const BlockPrior& slowPrior() const { return slow_; }

 private:
  const std::vector<const StrutBlock*>& newest(int count, int from = 0);
  void scaleSlow();
  double delayStddev() const;
  bool start();
  bool startBy(int window);
  bool startAt(const BlockVector& linear, int window);
  void learnSlow();
  void lookAtSensors();
  bool contradictsSlow();
  bool contradictsShorter(const WindowEstimate& estimate);
  bool leavesMoreThanMedian(int blocks);
  void retire(const StrutBlock& block);
  void retireAll();
  void refine(int window, const BlockPrior& prior);
  bool isStale(const StrutBlock& block) const;
  bool fit(int window, const BlockPrior& prior, WindowEstimate& result, bool is_near = false, int from = 0);

  StrutEquations equations_;
  WindowFit window_fit_;
  boost::circular_buffer<StrutBlock> ring_;  // always full; of the newest count_ blocks, and of places to be filled
  int count_ = 0;
  int updates_ = 0, waits_ = 0;       // blocks until another start
  BlockPrior first_, slow_, scaled_;  // of kBlockTuning alone; with what all blocks tell of slow parameters; now
  BlockVector factor_, factor_stddev_;
  BlockWeights weights_;  // of all blocks; with their median
  double scatter_ = 1.0;
  DriveFit drive_;  // the blocks that are kept no longer
  BlockVector theta_;
  bool has_theta_ = false;
  double newest_worst_ = 0.0;  // larger relative standard deviation of b1 and b0 by the newest blocks, kWindows[0]
  double reported_worst_ = HUGE_VAL;  // WindowEstimate::worst() of what update() returned last
  WindowEstimate best_, trial_;
  std::optional<WindowEstimate> of_all_;
  struct Shorter {
    int blocks;
    Eigen::Vector2d theta, stddev;
  };
  std::vector<Shorter> shorter_;  // windows of the newest update
  std::vector<const StrutBlock*> pointers_;
  std::vector<double> sorted_;
};

}  // namespace suspension_health_monitor
