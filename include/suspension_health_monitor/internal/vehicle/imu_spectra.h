#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"

namespace suspension_health_monitor {

/// What an IMU measures in its own axes: acceleration [m/s^2], then angular rate [rad/s], 0 without a gyro.
using SixAxes = Eigen::Matrix<double, 6, 1>;

/// Spectra of signals and between them.
struct ImuSignals {
  BlockBand band;
  std::vector<double> rates;                   ///< by IMU [Hz]
  Eigen::ArrayXcd s;                           ///< by bin of the band [rad/s]
  std::vector<Eigen::MatrixXcd> spectra = {};  ///< by bin of the band, signals by signals
  /// By signal the IMU: first one of each along the axis that points up [m/s^2], then three of each IMU with a gyro,
  /// angular accelerations [rad/s^2].
  std::vector<std::size_t> owners = {};

  std::size_t imus() const { return rates.size(); }
};

/// Spectra of what several IMUs measure, in all axes, and between all of them: means over half overlapping blocks of
/// 8 s under Hann's window, each IMU on its own stamps (FourierIntegrals). Cost per reading: O(bins), no memory.
class ImuSpectra {
 public:
  explicit ImuSpectra(std::size_t imus);

  /// Stamps of an IMU increase; a reading that does not is left out, and one that is not finite.
  void push(std::size_t imu, Stamp stamp, const SixAxes& reading);

  /// Another drive.
  void restart();

  /// @return blocks in which an IMU lacks nothing.
  double blocks(std::size_t imu) const { return counts_(imu, imu); }

  /// @return rms along a direction in the axes of an IMU between two frequencies [m/s^2].
  double rms(std::size_t imu, const Eigen::Vector3d& direction, double from_hz, double to_hz) const;

  /// @param up  of each IMU, in its axes; 0: it is left out.  @param has_gyro  by IMU.  @param rates  by IMU [Hz].
  ImuSignals along(const std::vector<Eigen::Vector3d>& up, const std::vector<bool>& has_gyro,
                   const std::vector<double>& rates) const;

 private:
  struct Stream {
    FourierIntegrals integrals;
    std::optional<Stamp> last = {};
  };

  static bool isBehind(const Stream& a, const Stream& b) { return a.integrals.openHalf() < b.integrals.openHalf(); }
  void takeBlocks(long end);

  BlockBand band_;
  Modulation modulation_;
  FourierIntegrals::Phases phases_;
  std::vector<Stream> streams_;
  std::optional<Stamp> origin_;
  long next_half_ = 1;
  std::vector<Eigen::MatrixXcd> sums_;  // by bin, of six axes by IMU
  Eigen::MatrixXd counts_;              // blocks that both IMUs have
};

}  // namespace suspension_health_monitor
