#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

inline constexpr std::size_t kNumCorners = 4;
inline constexpr std::array<std::string_view, kNumCorners> kCornerNames{"front_left", "front_right", "rear_left",
                                                                        "rear_right"};

/// The places of the corners among the struts of a vehicle.
using CornerPlaces = std::array<std::size_t, kNumCorners>;

/// @return nothing if a strut is missing that has the name of a corner.
std::optional<CornerPlaces> cornersAmong(const std::vector<std::string>& struts);

/// What is known of one strut of four; so far nothing.
struct CornerState {
  StrutEstimate estimate;
  Baseline healthy;
};

enum class CornerVerdict : unsigned char {
  kCannotTell = 0,
  kAlike = 1,   ///< as the others, and as it was
  kLoad = 2,    ///< damping and stiffness changed by the same share: the mass did
  kDamper = 3,  ///< its damping left that of the others
  kSpring = 4   ///< its stiffness did
};

/// A corner whose damper or spring is damaged; which of them the verdict says.
struct CornerDamage {
  std::size_t corner;
  double change;                       ///< of its damping or stiffness against the others', as a share [-]
  double stddev;                       ///< of ln(1 + change)
  std::optional<std::size_t> partner;  ///< the wheel that it was compared with; none: all others, by nominal values
};

/// The facts; describe() makes a sentence of them (wording/monitor_sentences.h).
struct CornerComparisonReport {
  HealthLevel level = HealthLevel::kStale;  ///< kWarn: a corner is damaged
  std::array<CornerVerdict, kNumCorners> verdicts{};
  std::array<std::optional<double>, kNumCorners> damping_deviation{};    ///< from the others, as a share [-]
  std::array<std::optional<double>, kNumCorners> stiffness_deviation{};  ///< likewise
  std::vector<CornerDamage> damages;                                     ///< worst first
  std::optional<double> load;        ///< median change of stiffness/mass of the corners with kLoad, as a share [-]
  std::optional<double> dampers;     ///< change of damping that all corners without damage show alike
  bool by_nominal = true;            ///< false: the wheels of an axle were compared
  std::vector<std::size_t> missing;  ///< corners without a valid estimate

  std::size_t numValid() const { return kNumCorners - missing.size(); }
};

/// Compares the four struts of a vehicle: what moves all of them, or an axle, is load; what moves one is damage.
///
/// With q = ln(b / healthy), as changeFrom() has it, load divides b1 and b0 alike, so e = q_damping - q_stiffness does
/// not see it. A corner whose e leaves the median of the other corners is damaged; it is taken out, and the rest is
/// compared anew. The other wheel of the axle carries the same load, so it shows whether damper or spring changed.
/// What all dampers do alike (they warm up) accuses none. Without the healthy values of all corners the two wheels of
/// each axle are compared with each other; the weaker one is accused, since dampers and springs fail that way. So are
/// healthy values that were learned, since a damaged vehicle may have taught them.
/// Fewer than three valid corners say nothing: of two that differ either may be the one. Three that are alike are no
/// proof of the fourth: kStale.
CornerComparisonReport compareCorners(const std::array<CornerState, kNumCorners>& corners);

}  // namespace suspension_health_monitor
