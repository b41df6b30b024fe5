#include "suspension_health_monitor/internal/health/drive_change.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "suspension_health_monitor/internal/health/baseline.h"
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

CurveChange changeOf(const ForceCurve& now, const ForceCurve& other, const Measured& mass) {
  CurveChange change;
  const double heavier = std::exp(mass.value);
  const std::vector<double> sides[] = {nodesOf(now, other, 1.0), nodesOf(now, other, -1.0)};
  const double limit = limitFor(std::fmax(1.0, static_cast<double>(sides[0].size() + sides[1].size())));
  for (const std::vector<double>& nodes : sides) {
    std::optional<CurveChange::Range> open;
    const auto close = [&] {
      if (open) change.ranges.push_back(*open);
      open.reset();
    };
    for (const double x : nodes) {
      const double before = other.forceAt(x), force = heavier * now.forceAt(x), more = force - before;
      const double stddev = std::hypot(heavier * now.stddevAt(x), other.stddevAt(x), mass.stddev * force);
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

DriveChange changeOf(const StrutEstimate& now, const StrutCurves& curves, const StrutEstimate& other,
                     const StrutCurves& other_curves, double payload_range) {
  const StrutChange strut = splitChange(changeFrom(baselineOf(other, {}), now), payload_range, 0.0);
  Measured mass{0.0, 0.0};
  if (const double payload = strut.payload.value_or(0.0); payload != 0.0) {
    // The load's part of the standard deviation of what is left without it.
    const double variance = square(strut.stiffness_stddev) - square(strut.measured.stiffness->stddev);
    mass = {std::log1p(payload), std::sqrt(std::max(0.0, variance))};
  }
  return {strut, changeOf(curves.damper, other_curves.damper, mass),
          changeOf(curves.spring, other_curves.spring, mass)};
}

}  // namespace suspension_health_monitor
