#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"

namespace suspension_health_monitor {

/// Spectra of what several IMUs read, all axes, and between all of them: means over half overlapping blocks of 8 s
/// under Hann's window, each IMU on its own stamps (FourierIntegrals). Cost per reading: O(bins), no memory.
class ImuSpectra {
 public:
  explicit ImuSpectra(std::size_t imus);

  /// Stamps of an IMU increase; a reading that does not is left out.
  void push(std::size_t imu, Stamp stamp, const Eigen::Vector3d& acceleration);

  /// Another drive.
  void restart();

  /// @return blocks in which an IMU lacks nothing.
  double blocks(std::size_t imu) const {
    return counts_(static_cast<Eigen::Index>(imu), static_cast<Eigen::Index>(imu));
  }

  /// @return rms along a direction in the axes of an IMU between two frequencies [m/s^2].
  double rms(std::size_t imu, const Eigen::Vector3d& direction, double from_hz, double to_hz) const;

  /// @param up  of each IMU, in its axes.
  /// @return by bin the spectra along these directions, between all IMUs, [m^2/s^4] per bin.
  std::vector<Eigen::MatrixXcd> along(const std::vector<Eigen::Vector3d>& up) const;

  const BlockBand& band() const { return band_; }

 private:
  struct Stream {
    FourierIntegrals integrals;
    std::optional<Stamp> last = {};
  };

  void takeBlocks(long end);

  BlockBand band_;
  Modulation modulation_;
  std::vector<Stream> streams_;
  std::optional<Stamp> origin_;
  long next_half_ = 1;
  std::vector<Eigen::MatrixXcd> sums_;  // by bin, of three axes by IMU
  Eigen::MatrixXd counts_;              // blocks that both IMUs have
};

/// An IMU that moves like the body over a wheel, which has the other.
struct BodyOverWheel {
  std::size_t body = 0, wheel = 0;  ///< places of the IMUs
  /// One reads upward, the other downward, by the axes that were given.
  bool is_reversed = false;
  /// The body's IMU is the one of this wheel alone, so that the numbers below are those of the strut, else of the body.
  bool is_own = true;
  double explained = 0.0;  ///< share of the body's motion by all wheels, weighted over frequency
  double damping_to_mass = 0.0, stiffness_to_mass = 0.0;  ///< b1 [1/s], b0 [1/s^2]
  double delay = 0.0;                                     ///< by which the body's clock is late [s]
};

/// Which IMUs are those of bodies, and over which wheels. A wheel shakes far more than the body above it, and what the
/// body does is what all wheels make of it through springs and dampers, (B20) in doc/equations.md: of the body at any
/// point i, with accelerations,
///     z_i'' = sum over wheels j of (b1_ij / s + b0_ij / s^2) w_j'' - (a_1 / s + a_0 / s^2) z_i''.
/// The damper of a wheel pushes no point harder than the one above it: b1_ij is largest there.
/// @param spectra  as ImuSpectra::along().  @param rates  by IMU [Hz].
/// @param may_serve_several  by IMU: it has a gyro, so that it may tell what the body does above several wheels.
/// @return a pair for each wheel, by the wheels' places.
std::vector<BodyOverWheel> findBodiesOverWheels(const std::vector<Eigen::MatrixXcd>& spectra, const BlockBand& band,
                                                const std::vector<double>& rates,
                                                const std::vector<bool>& may_serve_several);

}  // namespace suspension_health_monitor
