#include "suspension_health_monitor/internal/wording/drive_sentences.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kBeyond = 0.05;  // on either side: intervals of 90 %, as the curves' bands

/// Damping with the damper's curve, or stiffness with the spring's.
struct Part {
  const char *name, *element, *unit;
  double scale;  // unit in SI
  std::optional<double> change;
  double stddev;  // of ln(1 + change)
  const CurveChange& curve;

  bool isProven() const { return change && DriveChange::isProven(*change, stddev); }
};

std::string describe(const CurveChange::Range& range, const Part& part) {
  const double from = std::abs(range.from) / part.scale, to = std::abs(range.to) / part.scale;
  const std::string where = range.to_end ? formatted("above %.2g", from)
                            : from == to ? formatted("at %.2g", from)
                                         : formatted("from %.2g to %.2g", from, to);
  return std::string(range.softer ? "softer" : "stiffer") + (range.from > 0.0 ? " in compression " : " in rebound ") +
         where + ' ' + part.unit;
}

/// @return where a curve has changed; of one that has not, although the number has, that.
std::string describeCurve(const Part& part) {
  std::vector<std::string> ranges;
  for (const CurveChange::Range& range : part.curve.ranges) ranges.push_back(describe(range, part));
  if (!ranges.empty()) return join(ranges, " and ");
  if (!part.isProven() || std::abs(*part.change) < kClearlyMore * part.curve.least) return {};
  return std::string("though the ") + part.element + "'s curve shows no change: perhaps the road";
}

std::pair<long, long> percentInterval(double change, double stddev, double beyond) {
  const double half = normalQuantile(beyond) * stddev;
  const auto percent = [&](double shift) { return std::lround(100.0 * std::expm1(std::log1p(change) + shift)); };
  return {percent(-half), percent(half)};
}

std::string describe(const Part& part, const std::string& other) {
  if (!part.change || !std::isfinite(part.stddev)) return {};
  std::string size;
  if (part.isProven()) {
    const std::string interval = intervalOf(*part.change, part.stddev, kBeyond);
    size = std::string(part.name) + ' ' + sizeInPercent(*part.change) + (*part.change < 0.0 ? " below " : " above ") +
           other + (interval.empty() ? "" : " (90 %: " + interval + ")");
  } else {
    const auto [low, high] = percentInterval(*part.change, part.stddev, kBeyond);
    size = formatted("%s within %+ld to %+ld %%", part.name, low, high);
  }
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
  const std::string mass =
      is_loaded ? "body mass " + sizeInPercent(payload) + (payload < 0.0 ? " below" : " above") : "";
  return against + join({sizes, mass}, "; ");
}

std::string intervalOf(double change, double stddev, double beyond) {
  if (!std::isfinite(stddev)) return {};
  const auto ends = percentInterval(change, stddev, beyond);
  const long sign = change < 0.0 ? -1 : 1;
  const auto [low, high] = std::minmax({sign * ends.first, sign * ends.second});
  if (low == high) return {};
  if (low >= 0) return formatted("%ld to %ld %%", low, high);
  const bool is_below = change < 0.0;
  return formatted("%ld %% %s to %ld %% %s", -low, is_below ? "above" : "below", high, is_below ? "below" : "above");
}

}  // namespace suspension_health_monitor
