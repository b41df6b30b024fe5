#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/internal/health/assessment.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {

inline constexpr std::size_t kNumCorners = 4;
inline constexpr std::array<std::string_view, kNumCorners> kCornerNames{"front_left", "front_right", "rear_left",
                                                                        "rear_right"};

/// What is known of one strut of four.
struct CornerState {
  bool valid = false;
  double damping_to_mass = 0.0;                                              ///< b1 [1/s]
  double stiffness_to_mass = 0.0;                                            ///< b0 [1/s^2]
  double damping_to_mass_stddev = 0.0;                                       ///< [1/s]
  double stiffness_to_mass_stddev = 0.0;                                     ///< [1/s^2]
  std::optional<double> nominal_damping_to_mass, nominal_stiffness_to_mass;  ///< of the healthy strut
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
  std::optional<std::size_t> partner;  ///< the wheel that it was compared with; none: all others, by nominal values
};

/// The facts; describe() makes a sentence of them (wording/monitor_sentences.h).
struct CornerComparisonReport {
  HealthLevel level = HealthLevel::kStale;  ///< kWarn: a corner is damaged
  std::array<CornerVerdict, kNumCorners> verdicts{};
  std::array<std::optional<double>, kNumCorners> damping_deviation{};    ///< from the others, as a share [-]
  std::array<std::optional<double>, kNumCorners> stiffness_deviation{};  ///< likewise
  std::vector<CornerDamage> damages;                                     ///< worst first
  std::optional<double> load;          ///< median change of stiffness/mass of the corners with kLoad, as a share [-]
  std::optional<double> dampers;       ///< change of damping that all corners without damage show alike
  bool by_nominal = true;              ///< false: the wheels of an axle were compared
  std::optional<std::size_t> missing;  ///< a corner without a valid estimate
  std::size_t num_missing = 0;

  std::size_t numValid() const { return kNumCorners - num_missing; }
};

struct CornerComparisonOptions {
  double threshold = 0.15;        ///< deviation from the others that counts, as a share [-]
  double significance = kProven;  ///< and how many of its standard deviations it must be
};

/// Compares the four struts of a vehicle: what moves all of them, or an axle, is load; what moves one is damage.
///
/// With q = ln(b / nominal), load divides b1 and b0 alike, so e = q_damping - q_stiffness does not see it. A corner
/// whose e leaves the median of the other corners is damaged; it is taken out, and the rest is compared anew. Whether
/// damper or spring did it is told against the other wheel of the axle, which carries the load that it does.
/// What all dampers do alike (they warm up) accuses none. Without nominal values of all corners the two wheels of each
/// axle are compared with each other; the weaker one is accused, since dampers and springs fail that way.
/// Fewer than three valid corners say nothing: of two that differ either may be the one. Three that are alike are no
/// proof of the fourth: kStale.
CornerComparisonReport compareCorners(const std::array<CornerState, kNumCorners>& corners,
                                      const CornerComparisonOptions& options = {});

}  // namespace suspension_health_monitor
