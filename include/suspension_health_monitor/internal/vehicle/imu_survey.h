#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/internal/signal/stream_gate.h"
#include "suspension_health_monitor/internal/signal/white_level.h"
#include "suspension_health_monitor/internal/vehicle/gravity.h"

namespace suspension_health_monitor {

/// What the readings of one IMU are like, whatever it is mounted on. Cost per reading: O(1).
class ImuSurvey {
 public:
  static constexpr std::size_t kFewest = 64;  ///< readings, whose median spacing is the period to begin with

  /// @param acceleration  in the IMU's axes [m/s^2].
  void add(Stamp stamp, const Eigen::Vector3d& acceleration);

  /// The next reading belongs to another drive.
  void restart() { last_.reset(); }

  /// A message that says that it carries no acceleration.
  void addNotMeasured() { ++not_measured_; }

  /// @return false: there are too few readings for anything below.
  bool isKnown() const { return !gates_.empty(); }

  std::uint64_t messages() const { return messages_; }
  std::uint64_t notMeasured() const { return not_measured_; }
  const RejectCounts& rejected(int axis) const { return gates_[axis].rejected(); }
  double rate() const { return 1.0 / period_.mean(); }               ///< [Hz]
  double jitter() const { return std::sqrt(jitter_.mean()); }        ///< standard deviation of spacings, over T
  double lost() const { return lost_ / (lost_ + taken_); }           ///< share of readings, pauses left out [-]
  double noise(int axis) const { return noise_[axis].deviation(); }  ///< white, at most [m/s^2]
  double largest(int axis) const { return largest_[axis]; }          ///< magnitude [m/s^2]
  /// All axes read the same again and again.
  bool isStill() const {
    return std::all_of(gates_.begin(), gates_.end(), [](const StreamGate& gate) { return gate.isStill(); });
  }

  /// @return false: the drive is too short to tell whether there is gravity in the readings.
  bool tellsGravity() const { return gravity_.isKnown(); }

  /// @return of the axis that gravity is nearest to; nothing: it is not in the readings, or they are too few.
  std::optional<MountClaim::Finding> gravity() const;

 private:
  void follow(Stamp stamp);
  void judge(Stamp stamp, const Eigen::Vector3d& acceleration);

  std::uint64_t messages_ = 0, not_measured_ = 0;
  std::vector<std::pair<Stamp, Eigen::Vector3d>> first_;
  std::vector<StreamGate> gates_;  // by axis, once the period is known
  std::vector<WhiteLevel> noise_ = std::vector<WhiteLevel>(3, WhiteLevel(1.0));
  std::array<double, 3> largest_{};
  MountClaim gravity_;
  std::optional<Stamp> last_;
  RunningMean period_{1.0};  // of spacings without a gap [s]
  RunningMean jitter_{1.0};  // squared distance of spacings from whole periods, over T
  double lost_ = 0.0, taken_ = 0.0;
};

}  // namespace suspension_health_monitor
