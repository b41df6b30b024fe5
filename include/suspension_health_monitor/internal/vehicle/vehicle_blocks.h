#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/blocks/sliding_friction.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/internal/vehicle/coupled_tops.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_claims.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

namespace suspension_health_monitor {

/// What the blocks tell of a strut. On a body with several b1 and b0 are the coefficients of its own travel at its own
/// top, with its share of an anti-roll bar. Their covariance is that of noise and of the scatter of blocks: a change is
/// judged by it. That of absolute values has the model's error as well (fitRigidBody).
struct TopEstimate : WindowEstimate {
  Stamp stamp{};        ///< end of the newest block
  double length = 0.0;  ///< T of its blocks [s]
  std::size_t strut = 0;
  double friction = 0.0;  ///< over the body's mass [m/s^2]

  /// @return the damping that takes as much power as friction does [1/s].
  double frictionDamping() const { return frictionGain() * friction; }
};

/// From the readings of all sensors of a vehicle, each on its own stamps, to estimates of every strut after every half
/// block: VehicleSpectra -> StrutBlock -> BlockEstimator, one per strut top. Readings may come in any order between the
/// streams, as long as none runs four blocks ahead. The blocks' length follows the bounce: from some two to
/// kMostPeriods of it in a block.
///
/// Of several struts the rows of a top hold the travel and travel rate of all, since all move it through the body,
/// (B20) in doc/equations.md:
///     z_i'' = sum_j a_ij F_j,  a_ij = 1/M + x_i x_j / Iyy + y_i y_j / Ixx.
/// Instruments are what the model of all rows makes of the wheels (CoupledTops). A neighbour's columns are slow, but in
/// proportion to its own: b_ij / b_jj = a_ij / a_jj belongs to the body, whatever wears.
///
/// Their work is spread: a reading that completes a half block fills the blocks, and each reading after it updates one
/// top. Of a strut alone that reading brings the estimate.
class VehicleBlocks {
 public:
  /// @param period  the longest sampling time of the streams [s].  @param length  of the first blocks [s].
  /// @param effects  of a strut alone, whose forces are columns (pushEffects()); 0: dry friction is, of every strut.
  VehicleBlocks(const VehicleChannels& vehicle, double period, double length = kBlockTuning.length,
                std::size_t effects = 0);

  /// Takes in one reading. Where the stamps of a sensor go back the blocks begin anew (restart()).
  /// @return an estimate that is new; nullptr: none is.
  const TopEstimate* push(const VehicleReading& reading);
  /// All readings of an instant, of struts that have two accelerometers each.
  void push(const VehicleSample& sample) {
    forReadings(sample, [this](const VehicleReading& reading) { push(reading); });
  }
  /// The effects' forces over the body's mass at one instant, by their present coefficients' unit.
  const TopEstimate* pushEffects(Stamp stamp, const double* forces);
  /// What both sensors of a strut alone read at one instant, if both are numbers.
  /// @param lag  by which the body's clock is late, as far as it is known.
  const TopEstimate* push(const CornerSample& sample, Stamp lag = {});

  /// @return the newest estimate of a strut; nullptr: none yet.
  const TopEstimate* estimate(std::size_t strut = 0) const { return has_[strut] ? &estimates_[strut] : nullptr; }

  /// @return the estimate of a strut over all blocks, before restart(), too; nothing if they do not tell, or if tracks
  /// are too much alike. Not for the sample path.
  std::optional<TopEstimate> overTheDrive(std::size_t strut = 0);

  /// What all blocks kept say of all tops, with the data alone. Allocates when `rows` is empty.
  /// @return false: they do not know all tops, and `rows` is incomplete.
  bool rows(BodyRows& rows) const;
  /// @return likewise all blocks since the first. Not for the sample path.
  std::optional<BodyRows> rowsOverTheDrive();
  /// @return the rows of the older and of the newer half of the blocks; empty if they do not tell. Not for the sample
  /// path.
  std::vector<BodyRows> rowsOfHalves();

  const BlockEstimator& estimator(std::size_t strut = 0) const { return estimators_[strut]; }
  const VehicleChannels& vehicle() const { return vehicle_; }

  /// @return what the blocks kept say of the vehicle file, to be worked through. Allocates.
  VehicleClaims claims() const { return claims(vehicle_); }
  /// @param vehicle  as it is measured, if what was given as the tops' was made of the body's IMU.
  VehicleClaims claims(const VehicleChannels& vehicle) const;

  /// @return true if the gyro of the body's IMU has died: blocks are kept out as long as it is dead.
  bool hasDeadGyro() const { return spectra_->hasDeadGyro(); }

  /// Another drive: nothing is known any more, but to overTheDrive().
  void restart();

 private:
  static double lengthOf(const BlockEstimator& estimator) { return estimator.equations().band().length; }
  /// @return the time that their blocks cover [s].
  static double coveredBy(const std::vector<BlockEstimator>& estimators) {
    return estimators.empty() ? 0.0 : lengthOf(estimators.front()) / 2.0 * estimators.front().numBlocks();
  }
  void begin(double length);
  std::size_t size() const { return vehicle_.struts.size(); }
  bool isAlone() const { return size() == 1; }
  bool looksForFriction() const { return columns_.has_friction; }
  /// Of the known forces, among the forces' columns.
  int firstKnownForce() const { return columns_.forces - static_cast<int>(vehicle_.known_forces.size()); }
  std::optional<double> timeOf(std::size_t stream, Stamp stamp);
  const TopEstimate* work();
  void takeBlock();
  void fillNeighbours();
  void predict(int age);
  const TopEstimate* update(std::size_t strut);
  void scaleNeighbours(std::size_t strut);
  void updateModel();
  /// @param estimate_of  a strut, if it is known.  @return false: one is not, and the rows are not complete.
  template <class EstimateOf>
  bool setRows(const EstimateOf& estimate_of, BodyRows& rows) const;
  void follow();

  VehicleChannels vehicle_;
  std::size_t effects_;
  double period_, length_;
  BlockColumns columns_;
  std::optional<Stamp> origin_;
  std::optional<VehicleSpectra> spectra_;
  std::optional<CoupledTops> model_;        // of two struts or more
  std::vector<BlockEstimator> estimators_;  // by strut, as all that follow
  std::vector<BlockEstimator> longest_;     // of the lengths before the one that covered most, for overTheDrive()
  std::vector<SlidingFriction> friction_;
  std::vector<TopEstimate> estimates_;
  std::vector<bool> has_;
  std::vector<std::optional<Stamp>> last_;  // by Sensor and place; then of the effects
  Modulation modulation_;
  Eigen::ArrayXXcd motions_;  // H_1, H_0 of every w'' - z''
  BodyRows rows_;
  bool has_model_ = false;
  std::size_t to_update_ = 0;  // tops that the newest block has not come to yet
  int to_predict_ = 0;         // blocks to be predicted again, the newest last
  long next_half_ = 1;         // the second half of the next block
  long newest_half_ = 0;       // of the newest block
};

}  // namespace suspension_health_monitor
