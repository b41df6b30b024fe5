#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/identification/regression_row.h"
#include "suspension_health_monitor/internal/identification/regressor_noise.h"
#include "suspension_health_monitor/internal/identification/row_moments.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"

namespace suspension_health_monitor {

/// @param fit  of the rows.
/// @return information of either parameter over that of noise as large as what the fit leaves [-].
std::array<double, kNumStrutParameters> excitationOf(const RowMoments& rows, const StrutFit& fit,
                                                     const RegressorNoise& noise);

/// Whether the rows of a strut tell anything of its damping and of its stiffness, or only of the sensors' noise, as
/// those of a parked vehicle do; and whether it is the wheel at all that moves the body.
///
/// It is asked of the rows alone, by blocks of a horizon and more, so that a strut that breaks does not look parked.
/// What does the best strut between none and twice the known one (the largest within ten memories) leave of psi? Rows
/// tell of a strut if that is less than half. They tell of parameter i if, besides, the information of its regressor,
/// the mean of phi_i^2, is clear of what that rest would put there, were it white noise of both sensors:
/// excitationOf(), 1 for noise.
/// - A parameter is held once two blocks do not tell of it, and its information has fallen below a tenth of the usual,
///   that of blocks that told of it over ten memories: readings that no strut explains on a road as rough as ever are
///   not rest. Beside one that is held the other one is held, too, unless it would be released.
/// - It is held no longer when the rows since then, up to eight blocks, tell of it and not by chance, or when eight
///   blocks in a row have more than a tenth of the usual information: that is no rest, though the strut is not within
///   twice the known one. No single row does: a wrong reading is in 2 L + 1 of them.
/// A constant of phi_0 is the offset between the sensors and not counted.
///
/// A body that wind, people or an engine move over a wheel that stands looks like a strut without damping,
/// b0 = omega^2, which no regression can tell from a true one. But the wheel then moves little. So a force from
/// outside is suspected while the wheel's part of a block is below 1 % of the usual (a tenth of the amplitude) and the
/// body's is more than twice the wheel's; before any block of a valid strut is known, while the body's is more than
/// nine times the wheel's.
/// Cost per row: O(1) whatever L, no allocation. Free of units.
class Excitation {
 public:
  /// Information of a parameter over the noise's: less would pull it by a fifth.
  static constexpr double kLeastExcitation = 4.5;

  /// @param horizon_samples  L of the filter.  @param forgetting_factor  of the estimator.
  /// @param noise  of the same filter.
  Excitation(int horizon_samples, double forgetting_factor, const RegressorNoise& noise);

  /// Takes in a row.
  /// @param output  psi without what effects make of it.
  /// @param wheel_output  what psi would be of the wheel's own acceleration: I_2^2 w'' [m/s^2].
  /// @return true if the row has closed a block: all that follows may have changed.
  bool add(const RegressionRow& row, double output, double wheel_output);

  /// From now on there is a strut that is worth being held, and that others are measured by; before, everything counts
  /// as excited. To be called for every row of a strut that is valid.
  /// @param strut  (b1 [1/s], b0 [1/s^2]), above 0.
  void know(const Eigen::Vector2d& strut);

  /// @return true once a strut is known.
  bool knowsStrut() const { return most_.all(); }

  bool excited(StrutParameter i) const { return parts_[i].excited; }

  /// @return information of parameter i over what noise alone would give, by the newest judgement [-]; NaN before it.
  double excitation(StrutParameter i) const { return parts_[i].excitation; }

  /// @return true while something else than the wheel moves the body.
  bool outsideForce() const { return outside_force_; }

  /// Starts a block anew after a gap; what was excited stays so.
  void reset();

  /// As it began: no strut is known, and nothing is held.
  void restart();

  const RegressorNoise& noise() const { return noise_; }

 private:
  static constexpr std::size_t kWheel = kNumStrutParameters;  // position of the wheel's part

  /// The usual information of one quantity: the mean over blocks that told of it.
  struct Usual {
    double mean = 0.0, blocks = 0.0;
    void learn(double information, double most_blocks);
  };

  /// What is known of one parameter's part of the rows.
  struct Part {
    double excitation = std::numeric_limits<double>::quiet_NaN();
    int rough_blocks = 0;  // in a row, since it is held, that have a tenth of the usual information
    bool excited = true;
  };

  /// Rows in a row.
  struct Block {
    RowMoments moments;              // without what effects make of psi
    double body = 0.0, wheel = 0.0;  // sums of squares of psi, and of what it would be of the wheel's own acceleration
    int rows = 0, blocks = 0;
    Block& operator+=(const Block& other);
  };

  /// What some rows tell of the parameters.
  struct Told {
    bool of_strut;  ///< the best strut leaves less than half of psi
    std::array<double, kNumStrutParameters> excitation;
    double least;  ///< that releases a parameter which is held

    bool releases(std::size_t i) const { return of_strut && excitation[i] >= least; }
  };

  Told toldBy(const Block& rows) const;
  void closeBlock();
  void judgeWheel();
  void judgeExcited(const Block& recent);
  void judgeHeld();
  bool isHeld() const { return !(parts_[kDampingToMass].excited && parts_[kStiffnessToMass].excited); }

  int block_rows_;
  double most_blocks_;  // of the usual
  RegressorNoise noise_;
  Block block_, before_;                            // the present one; the one before it, without a gap
  Block since_held_;                                // those since something is held
  LimitedMean offset_;                              // of phi_0
  Eigen::Vector2d most_ = Eigen::Vector2d::Zero();  // of the best strut; 0: none is known
  std::array<Part, kNumStrutParameters> parts_;
  std::array<Usual, kNumStrutParameters + 1> usual_;  // of damping, stiffness and wheel
  bool is_known_ = false;                             // the strut was valid in the present block
  bool outside_force_ = false;
};

}  // namespace suspension_health_monitor
