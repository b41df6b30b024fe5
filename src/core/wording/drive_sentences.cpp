#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kBeyond = 0.05;  // on either side: intervals of 90 %, as the curves' bands
constexpr double kCoarse = 4.0;   // [%]: of a narrower interval whole percents say too little

/// Damping with the damper's curve, or stiffness with the spring's.
struct Part {
  const char *name, *element, *unit;
  double scale;  // unit in SI
  std::optional<double> change;
  double stddev;  // of ln(1 + change)
  const CurveChange& curve;

  bool isProven() const {
    return change && std::abs(*change) > kLeastChange && std::abs(std::log1p(*change)) > kProven * stddev;
  }
};

/// @return e.g. "in rebound above 0.3 m/s".
std::string placeOf(const CurveChange::Range& range, const Part& part) {
  const double from = std::abs(range.from) / part.scale, to = std::abs(range.to) / part.scale;
  const std::string where = range.to_end ? formatted("above %.2g ", from)
                            : from == to ? formatted("at %.2g ", from)
                                         : formatted("from %.2g to %.2g ", from, to);
  return (range.from > 0.0 ? "in compression " : "in rebound ") + where + part.unit;
}

/// @return where a curve has changed; of one that has not, although the number has, that.
std::string describeCurve(const Part& part) {
  std::vector<std::string> softer, stiffer;
  for (const CurveChange::Range& range : part.curve.ranges)
    (range.softer ? softer : stiffer).push_back(placeOf(range, part));
  if (!softer.empty()) softer.front() = "softer " + softer.front();
  if (!stiffer.empty()) stiffer.front() = "stiffer " + stiffer.front();
  if (!part.curve.ranges.empty()) return join({join(softer, " and "), join(stiffer, " and ")});
  if (!part.isProven() || std::abs(*part.change) < kClearlyMore * part.curve.least) return {};
  return std::string("though the ") + part.element + "'s curve shows no change: perhaps only the road differs";
}

std::string describe(const Part& part, const std::string& other) {
  if (!part.change || !std::isfinite(part.stddev)) return {};
  const double half = normalQuantile(kBeyond) * part.stddev, log = std::log1p(*part.change);
  const double low = 100.0 * std::expm1(log - half), high = 100.0 * std::expm1(log + half);
  const int digits = high - low < kCoarse ? 1 : 0;
  const auto [least, most] = std::minmax({std::abs(low), std::abs(high)});
  const std::string size = part.isProven()
                               ? formatted("%s %.*f %% %s ", part.name, digits, 100.0 * std::abs(*part.change),
                                           *part.change < 0.0 ? "below" : "above") +
                                     other + formatted(" (90 %%: %.*f to %.*f %%)", digits, least, digits, most)
                               : formatted("%s within %+.*f to %+.*f %%", part.name, digits, low, digits, high);
  return join({size, describeCurve(part)});
}

}  // namespace

std::string describe(const DriveChange& change, const std::string& other) {
  const StrutChange& strut = change.strut;
  const Part damping{"damping", "damper", "m/s", 1.0, strut.damping, strut.damping_stddev, change.damper};
  const Part stiffness{"stiffness", "spring", "mm", 1e-3, strut.stiffness, strut.stiffness_stddev, change.spring};
  const std::string sizes = join({describe(damping, other), describe(stiffness, other)}, "; ");
  const double payload = strut.payload.value_or(0.0);
  const bool is_loaded = std::abs(payload) > kLeastChange;
  if (sizes.empty()) return {};
  const bool is_proven = damping.isProven() || stiffness.isProven();
  const bool is_changed = is_proven || is_loaded || !damping.curve.ranges.empty() || !stiffness.curve.ranges.empty();
  const std::string against = is_proven ? "" : (is_changed ? "against " : "no certain change against ") + other + ": ";
  return against + join({sizes, is_loaded ? "body mass " + sideInPercent(payload) : ""}, "; ");
}

}  // namespace suspension_health_monitor
