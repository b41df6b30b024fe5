#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

#include "suspension_health_monitor/identification/regression_row.h"
#include "suspension_health_monitor/identification/regressor_noise.h"
#include "suspension_health_monitor/identification/row_moments.h"
#include "suspension_health_monitor/identification/running_mean.h"
#include "suspension_health_monitor/identification/suspension_regression.h"

namespace suspension_health_monitor {

/// @param fit  of the rows.
/// @return information of either parameter over that of noise as large as what the fit leaves [-].
std::array<double, kNumStrutParameters> excitationOf(const RowMoments& rows, const StrutFit& fit,
                                                     const RegressorNoise& noise);

/// Whether the rows of a strut tell anything of its damping and of its stiffness, or only of the sensors' noise, as
/// those of a parked vehicle do.
///
/// It is asked of the rows alone, so that a strut that breaks does not look parked: what does the best strut between
/// none and twice the one that is known (the largest of late) leave of psi? Rows tell of a strut if that is less than
/// half. They tell of parameter i if, besides, the information of its regressor, the mean of phi_i^2, is clear of what
/// that rest would put there, were it white noise of both sensors: excitationOf(), 1 for noise.
/// - A parameter is held once two blocks, each of a horizon and more, do not tell of it, and its information has fallen
///   below a tenth of the usual, that of blocks that told of it over ten memories: readings that no strut explains on
///   a road as rough as ever are not rest.
/// - It is held no longer when the rows since then, up to eight blocks, tell of it and not by chance, or when eight
///   blocks in a row have more than a tenth of the usual information: that is no rest, though the strut is not within
///   twice the one that is known. No single row does: a wrong reading is in 2 L + 1 of them.
/// A constant of phi_0 is the offset between the sensors and not counted.
/// Looked at is every eighth row: rows change slowly. Cost per row: O(1) whatever L, no allocation. Free of units.
class Excitation {
 public:
  static constexpr int kJudgeEvery = 8;  // rows

  /// @param horizon_samples  L of the filter.  @param forgetting_factor  of the estimator.
  /// @param noise  of the same filter.
  Excitation(int horizon_samples, double forgetting_factor, const RegressorNoise& noise);

  /// Takes in a row, to be called every kJudgeEvery rows.
  /// @param theta  estimate, as many entries as the regressor: b1 [1/s], b0 [1/s^2], and those of effects.
  /// @return true if excited() or excitation() may have changed.
  [[gnu::noinline]] bool judge(const RegressionRow& row, const Eigen::VectorXd& theta);

  /// From now on there is a strut that is worth being held, and that others are measured by; before, everything counts
  /// as excited. To be called every kJudgeEvery rows of a strut that is valid.
  /// @param strut  (b1 [1/s], b0 [1/s^2]), above 0.
  void know(const Eigen::Vector2d& strut);

  bool excited(StrutParameter i) const { return parts_[i].excited; }

  /// @return information of parameter i over what noise alone would give, by the newest judgement [-]; NaN before it.
  double excitation(StrutParameter i) const { return parts_[i].excitation; }

  /// Starts a block anew after a gap; what was excited stays so.
  void reset();

  /// As it began: no strut is known, and nothing is held.
  void restart();

 private:
  static constexpr int kMostBlocks = 8;  // that are judged together

  /// What is known of one parameter's part of the rows.
  struct Part {
    double usual = 0.0;   // mean phi_i^2 of the blocks that told of it
    double blocks = 0.0;  // in that mean
    double excitation = std::numeric_limits<double>::quiet_NaN();
    int rough_blocks = 0;  // in a row, since it is held, that have a tenth of the usual information
    bool excited = true;

    void learnUsual(double information, double most_blocks);
  };

  void closeBlock();
  void judgeExcited(const RowMoments& recent);
  void judgeHeld();

  int looks_per_block_;
  double most_blocks_;  // of the usual
  double kept_;         // of the largest strut, per look
  RegressorNoise noise_;
  std::array<double, kMostBlocks> least_share_;  // of psi^2 that a strut explains and chance does not, by blocks
  RowMoments block_, before_;                    // the newest block and the one before it
  RowMoments window_;                            // the blocks since something was held
  int looks_ = 0;                                // of the block
  int blocks_ = 0;                               // closed without a gap, up to 2
  int window_blocks_ = 0;
  RunningMean offset_;                              // of phi_0
  Eigen::Vector2d most_ = Eigen::Vector2d::Zero();  // of the best strut; 0: none is known
  std::array<Part, kNumStrutParameters> parts_;
  bool is_held_ = false;  // either of them
};

}  // namespace suspension_health_monitor
