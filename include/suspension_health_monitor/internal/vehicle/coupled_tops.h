#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/blocks/block_estimator.h"
#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"
#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

namespace suspension_health_monitor {

/// The Fourier integrals of all streams of a vehicle, each on its own stamps, and what they make of a block.
///
/// Where the body's IMU tells what a strut's top at r does, (B21) in doc/equations.md,
///     z'' = a_z + alpha_x r_y - alpha_y r_x + w_z (w_x r_x + w_y r_y) - (w_x^2 + w_y^2) r_z,  alpha = w',
/// the derivative of the rate w moves onto the modulating function: H_p(alpha) = H_(p+1)(w). The products are channels
/// of their own. Nothing is differentiated.
class VehicleSpectra {
 public:
  /// @param effects  of the one strut that there is; 0: there is dry friction.
  VehicleSpectra(const BlockBand& band, const VehicleChannels& vehicle, std::size_t effects);

  /// Takes in a reading; stamps of each sensor increase.  @param time  since half block 0 began [s].
  /// @param direction  of friction, -1 to 1, with that of a wheel.
  void push(const VehicleReading& reading, double time, double direction);
  /// @param forces  of the effects, per body mass.
  void pushEffects(double time, const double* forces) { streams_.back().push(time, forces, phases_); }

  /// The next reading of every stream is its first one.
  void restart() {
    for (FourierIntegrals& stream : streams_) stream.restart();
  }

  /// @return true if all streams are beyond this half block.
  bool isPassed(long half) const;
  /// @return true if nothing is missing in this half block and the one before.
  bool isWhole(long half) const;
  /// @return the first half block that no stream has completed.
  long newestOpen() const;

  /// Fills in what was measured in the block that ends with this half block, but for the neighbours.
  void fill(std::size_t strut, long half, StrutBlock& block);

  /// Takes in a block of the body, and finds out whether its gyro has died while the vehicle drove: an axis turns a
  /// tenth as much as on average, or less, while the body moves up and down as before. By chance the power of a block,
  /// of a dozen independent numbers or more, is not a hundred times smaller than on average. VehicleClaims finds a gyro
  /// that never turned.
  /// @return true if it was so in the newest block, up to this half block, in which the body moved.
  bool checkGyro(long half);
  bool hasDeadGyro() const { return has_dead_gyro_; }  ///< at the last checkGyro()

 private:
  enum BodyChannel : std::size_t { kAz, kWx, kWy, kWzWx, kWzWy, kWx2Wy2, kBodyChannels };

  void fillByBody(const Eigen::Vector3d& position, long half, StrutBlock& block);

  BlockBand band_;
  VehicleChannels vehicle_;
  Modulation modulation_;
  FourierIntegrals::Phases phases_;
  std::size_t num_effects_;
  std::vector<FourierIntegrals> streams_;  // of the wheels, the tops with a sensor, the body, the forces, the effects
  std::vector<std::size_t> top_of_;        // by strut, in streams_
  std::size_t body_ = 0, forces_ = 0;      // likewise; the first one
  Eigen::ArrayXcd channel_, derivative_;
  RunningMeans<3> body_power_{0.99};  // of a_z, w_x, w_y: of the last hundred blocks
  bool has_dead_gyro_ = false;
};

/// Where the column of strut j is among the neighbours of strut i, as StrutBlock::neighbours has them: the rate's; the
/// travel's is the next.
inline int neighbourColumn(std::size_t i, std::size_t j) { return 2 * static_cast<int>(j < i ? j : j - 1); }

/// Column of the travel rate of strut j in the row of strut i; that of its travel is the next.
inline int rateColumn(const BlockColumns& columns, std::size_t i, std::size_t j) {
  return j == i ? int{kBlockDamping} : columns.firstNeighbour() + neighbourColumn(i, j);
}

/// What the model of all rows makes of the wheels alone, in the bins of one block, (B22) in doc/equations.md: with Q(s)
/// = b1 s + b0 (matrices)
///     Z = (s^2 I + Q)^-1 (Q X + s^2 c F).
/// These motions are free of the noise of all body sensors: instruments. Source: R. Pintelon, J. Schoukens, System
/// Identification: A Frequency Domain Approach, 2012, ch. 9 (instrumental variables by a model's output).
/// Cost: O(bins * struts^3), no allocation after the construction.
class CoupledTops {
 public:
  CoupledTops(const BlockBand& band, std::size_t struts, std::size_t forces);

  void setRows(const BodyRows& rows);
  const BodyRows& rows() const { return rows_; }

  /// @param blocks  of all struts.  @param age  of the block.  @param first_force  among their force columns.
  void predict(const std::vector<BlockEstimator>& blocks, int age, int first_force);

  /// @return by band what noise of power 1 of every wheel does in the equations of one strut top: that of wheel j is in
  /// the regressors s / A, 1 / A of its own travel, by T = s^2 (s^2 I + Q)^-1 in the instruments of all struts, and by
  /// I - T in the outputs.
  const std::vector<WheelNoise>& wheelNoise(std::size_t strut, const StrutEquations& equations);

  /// @return H_0(w_j'' - z_j'') of the newest prediction, bins by struts.
  const Eigen::ArrayXXcd& travel() const { return travel_; }

 private:
  using Small = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, 0, kMostStruts, kMostStruts>;
  using SmallVector = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 1, 0, kMostStruts, 1>;

  Small loopAt(Eigen::Index bin) const;  // s^2 I + Q

  Eigen::ArrayXcd s_;
  BodyRows rows_;
  Eigen::ArrayXXcd wheels_, forces_, travel_;
  Eigen::PartialPivLU<Small> lu_;
  std::vector<Small> follows_;  // T by bin
  std::vector<WheelNoise> noise_;
};

}  // namespace suspension_health_monitor
