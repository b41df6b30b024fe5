#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// A linear strut that fits may begin with, by the blocks of drives.
struct RoughStrut {
  LinearStrut strut;                 ///< dry friction is part of its damping
  double explained = 0.0;            ///< share of the body's power [-]
  double clock_offset = 0.0;         ///< by which the body's clock is late [s]
  double clock_offset_stddev = 0.0;  ///< [s]

  /// @param lag  by which the body's clock was taken for late [s].
  explicit RoughStrut(const WindowEstimate& estimate, double lag = 0.0);

  /// @return true if the clocks differ beyond doubt, by more than half a sample and 2.5 ms.
  bool clocksDiffer(double period) const;

  /// @return L that proposeHorizon() proposes.
  int horizonSamples(double period) const;
};

/// Looks for a strut in drives with blocks of some lengths; where it sees none, with the body's clock late by some
/// times a hundredth of a block, too: beyond that the way to the delay may end elsewhere.
/// @param period  sampling time [s].  @param length  of the first blocks [s].
/// @return nothing: the drives show no damped spring.
std::optional<RoughStrut> roughStrut(const std::vector<Drive>& drives, double period,
                                     double length = kBlockTuning.length);

}  // namespace suspension_health_monitor
