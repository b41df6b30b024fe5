#include "suspension_health_monitor/internal/compare/curve_change.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

/// @return the nodes of both curves on one side, where both reach, outwards.
std::vector<double> nodesOf(const ForceCurve& now, const ForceCurve& other, double side) {
  std::vector<double> nodes;
  for (const ForceCurve* curve : {&now, &other})
    for (const double x : curve->at)
      if (side * x > 0.0 && now.covers(x) && other.covers(x)) nodes.push_back(x);
  std::sort(nodes.begin(), nodes.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return nodes;
}

}  // namespace

CurveChange changeOf(const ForceCurve& now, const ForceCurve& other, const MassRatio& mass) {
  CurveChange change;
  const std::vector<double> sides[] = {nodesOf(now, other, 1.0), nodesOf(now, other, -1.0)};
  const double limit = limitFor(std::fmax(1.0, static_cast<double>(sides[0].size() + sides[1].size())));
  for (const std::vector<double>& nodes : sides) {
    std::optional<CurveChange::Range> open;
    const auto close = [&] {
      if (open) change.ranges.push_back(*open);
      open.reset();
    };
    for (const double x : nodes) {
      const double before = other.forceAt(x), force = now.forceAt(x), more = mass.value * force - before;
      const double stddev = std::hypot(mass.value * now.stddevAt(x), other.stddevAt(x), mass.stddev * force);
      const double least = std::max(limit * stddev, kLeastChange * std::abs(before));
      change.least = std::min(change.least, least / std::abs(before));
      const bool softer = x * more < 0.0;
      if (open && open->softer != softer) close();
      if (std::abs(more) <= least) continue;
      if (!open) open = {x, x, false, softer};
      open->to = x;
      open->to_end = x == nodes.back();
    }
    close();
  }
  return change;
}

}  // namespace suspension_health_monitor
