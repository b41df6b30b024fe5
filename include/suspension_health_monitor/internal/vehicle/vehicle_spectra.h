#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"
#include "suspension_health_monitor/internal/blocks/strut_equations.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_tops.h"

namespace suspension_health_monitor {

/// The Fourier integrals of all streams of a vehicle, each on its own stamps, and what they make of a block.
///
/// Where the body's IMU tells what a strut's top at r does, (B21) in doc/equations.md,
///     z'' = a_z + alpha_x r_y - alpha_y r_x + w_z (w_x r_x + w_y r_y) - (w_x^2 + w_y^2) r_z,  alpha = w',
/// the derivative of the rate w moves onto the modulating function: H_p(alpha) = H_(p+1)(w). The products are channels
/// of their own. Nothing is differentiated.
class VehicleSpectra {
 public:
  VehicleSpectra(const BlockBand& band, const VehicleTops& tops);

  /// Take in readings [m/s^2], [rad/s]; stamps of each stream increase.  @param time  since half block 0 began [s].
  /// @param direction  of friction, -1 to 1.
  void pushWheel(std::size_t strut, double time, double acceleration, double direction);
  void pushTop(std::size_t strut, double time, double acceleration);
  void pushBody(double time, const Eigen::Vector3d& acceleration, const Eigen::Vector3d& rate);
  void pushForce(std::size_t force, double time, double value);
  void pushEffects(double time, const double* forces);

  /// The next reading of every stream is its first one.
  void restart();

  /// @return true if all streams are beyond this half block.
  bool isPassed(long half) const;
  /// @return true if nothing is missing in this half block and the one before.
  bool isWhole(long half) const;
  /// @return the first half block that no stream has completed.
  long newestOpen() const;

  /// Fills in what was measured in the block that ends with this half block, but for the neighbours.
  void fill(std::size_t strut, long half, StrutBlock& block);

 private:
  enum BodyChannel : std::size_t { kAz, kWx, kWy, kWzWx, kWzWy, kWx2Wy2, kBodyChannels };

  /// @return true if it is true of every stream.
  template <class Predicate>
  bool areAll(const Predicate& predicate) const;
  void fillByBody(const Eigen::Vector3d& position, long half, StrutBlock& block);

  BlockBand band_;
  VehicleTops tops_;
  Modulation modulation_;
  std::vector<FourierIntegrals> wheels_, own_, body_, forces_, effects_;
  std::vector<std::size_t> own_of_;  // by strut, in own_
  Eigen::ArrayXcd channel_, derivative_;
};

}  // namespace suspension_health_monitor
