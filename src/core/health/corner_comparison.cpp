#include "suspension_health_monitor/internal/health/corner_comparison.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

/// One corner on a logarithmic scale.
struct Change {
  double damping = 0.0, stiffness = 0.0;  // ln(b / reference)
  double strut = 0.0;                     // damping - stiffness, free of the load
  double variance = 0.0;                  // of that, correlation neglected
};

using Changes = std::array<Change, kNumCorners>;
using Members = std::vector<std::size_t>;

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 != 0 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double medianOfOthers(const Changes& changes, const Members& members, std::size_t corner, double Change::*quantity) {
  std::vector<double> values;
  for (const std::size_t other : members)
    if (other != corner) values.push_back(changes[other].*quantity);
  return medianOf(std::move(values));
}

constexpr std::size_t sameAxle(std::size_t corner) { return corner ^ 1u; }

bool has(const Members& members, std::size_t corner) {
  return std::find(members.begin(), members.end(), corner) != members.end();
}

bool counts(double deviation, double variance, const CornerComparisonOptions& options) {
  return std::abs(deviation) > std::abs(std::log1p(-options.threshold)) &&
         deviation * deviation > options.significance * options.significance * variance;
}

bool isUsableCorner(const CornerState& corner) {
  return corner.valid && corner.damping_to_mass > 0.0 && corner.stiffness_to_mass > 0.0;
}

bool hasNominal(const CornerState& corner) {
  return corner.nominal_damping_to_mass.value_or(0.0) > 0.0 && corner.nominal_stiffness_to_mass.value_or(0.0) > 0.0;
}

Change changeOf(const CornerState& corner, bool from_nominal) {
  Change change;
  change.damping = std::log(corner.damping_to_mass / (from_nominal ? *corner.nominal_damping_to_mass : 1.0));
  change.stiffness = std::log(corner.stiffness_to_mass / (from_nominal ? *corner.nominal_stiffness_to_mass : 1.0));
  change.strut = change.damping - change.stiffness;
  change.variance = square(corner.damping_to_mass_stddev / corner.damping_to_mass) +
                    square(corner.stiffness_to_mass_stddev / corner.stiffness_to_mass);
  return change;
}

void accuse(CornerComparisonReport& report, std::size_t corner, double damping_deviation, double stiffness_deviation,
            const std::optional<std::size_t>& partner = {}) {
  const bool damper = std::abs(damping_deviation) >= std::abs(stiffness_deviation);
  report.verdicts[corner] = damper ? CornerVerdict::kDamper : CornerVerdict::kSpring;
  report.level = HealthLevel::kWarn;
  report.damages.push_back({corner, std::expm1(damper ? damping_deviation : stiffness_deviation), partner});
}

// Accuses the corner furthest from the others, takes it out, and so on.
Members takeOutDamaged(const Changes& changes, Members members, const CornerComparisonOptions& options,
                       CornerComparisonReport& report) {
  while (members.size() >= 3) {
    const auto deviation = [&](std::size_t corner) {
      return changes[corner].strut - medianOfOthers(changes, members, corner, &Change::strut);
    };
    const std::size_t worst = *std::max_element(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(deviation(a)) < std::abs(deviation(b));
    });
    double variance = 0.0;
    for (const std::size_t other : members)
      if (other != worst) variance = std::max(variance, changes[other].variance);
    if (!counts(deviation(worst), variance + changes[worst].variance, options)) break;
    members.erase(std::find(members.begin(), members.end(), worst));
    const std::size_t partner = sameAxle(worst);
    const bool paired = has(members, partner);
    const double reference_damping =
        paired ? changes[partner].damping : medianOfOthers(changes, members, worst, &Change::damping);
    const double reference_stiffness =
        paired ? changes[partner].stiffness : medianOfOthers(changes, members, worst, &Change::stiffness);
    accuse(report, worst, changes[worst].damping - reference_damping, changes[worst].stiffness - reference_stiffness);
  }
  return members;
}

// Of corners that are not damaged: whose mass has changed.
void findLoad(const Changes& changes, const Members& healthy, const CornerComparisonOptions& options,
              CornerComparisonReport& report) {
  std::vector<double> stiffness_changes, strut_changes;
  for (const std::size_t corner : healthy) {
    strut_changes.push_back(changes[corner].strut);
    if (!counts(changes[corner].stiffness, changes[corner].variance, options)) continue;
    report.verdicts[corner] = CornerVerdict::kLoad;
    stiffness_changes.push_back(changes[corner].stiffness);
  }
  if (!stiffness_changes.empty()) report.load = std::expm1(medianOf(stiffness_changes));
  const double common = medianOf(strut_changes);
  if (counts(common, 0.0, options)) report.dampers = std::expm1(common);
}

void compareAxles(const Changes& changes, const Members& valid, const CornerComparisonOptions& options,
                  CornerComparisonReport& report) {
  for (const std::size_t left : {std::size_t{0}, std::size_t{2}}) {
    const std::size_t right = sameAxle(left);
    if (!has(valid, left) || !has(valid, right)) {
      for (const std::size_t corner : {left, right}) report.verdicts[corner] = CornerVerdict::kCannotTell;
      continue;
    }
    const double damping_ratio = changes[left].damping - changes[right].damping;
    const double stiffness_ratio = changes[left].stiffness - changes[right].stiffness;
    if (!counts(damping_ratio - stiffness_ratio, changes[left].variance + changes[right].variance, options)) continue;
    const bool damper = std::abs(damping_ratio) >= std::abs(stiffness_ratio);
    const bool left_is_weaker = (damper ? damping_ratio : stiffness_ratio) < 0.0;
    const double sign = left_is_weaker ? 1.0 : -1.0;
    accuse(report, left_is_weaker ? left : right, sign * damping_ratio, sign * stiffness_ratio,
           left_is_weaker ? right : left);
  }
}

}  // namespace

CornerComparisonReport compareCorners(const std::array<CornerState, kNumCorners>& corners,
                                      const CornerComparisonOptions& options) {
  CornerComparisonReport report;
  Members valid;
  for (std::size_t corner = 0; corner < kNumCorners; ++corner) {
    if (!isUsableCorner(corners[corner])) {
      report.missing = corner;
      ++report.num_missing;
      continue;
    }
    valid.push_back(corner);
    report.by_nominal = report.by_nominal && hasNominal(corners[corner]);
  }
  if (valid.size() < 3) return report;
  report.level = HealthLevel::kOk;
  Changes changes{};
  for (const std::size_t corner : valid) {
    changes[corner] = changeOf(corners[corner], report.by_nominal);
    report.verdicts[corner] = CornerVerdict::kAlike;
  }
  if (report.by_nominal) {
    for (const std::size_t corner : valid) {
      const Change& change = changes[corner];
      report.damping_deviation[corner] =
          std::expm1(change.damping - medianOfOthers(changes, valid, corner, &Change::damping));
      report.stiffness_deviation[corner] =
          std::expm1(change.stiffness - medianOfOthers(changes, valid, corner, &Change::stiffness));
    }
    const Members healthy = takeOutDamaged(changes, valid, options, report);
    findLoad(changes, healthy, options, report);
  } else {
    compareAxles(changes, valid, options, report);
  }
  if (report.missing && report.level == HealthLevel::kOk) report.level = HealthLevel::kStale;
  return report;
}

}  // namespace suspension_health_monitor
