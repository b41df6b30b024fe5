#include "suspension_health_monitor/internal/health/corner_comparison.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

enum Part { kDamping, kStiffness, kStrut };
using Deviation = Eigen::Array3d;  // ln of a ratio by Part; kStrut: damping less stiffness, free of the load

// One corner against the healthy strut.
struct Change {
  Deviation size = Deviation::Zero();
  Deviation variance = Deviation::Zero();  // correlation of damping and stiffness neglected
};

using Changes = std::array<Change, kNumCorners>;
using Members = std::vector<std::size_t>;

// @return by corner; nothing: the healthy values of one are not known.
// @param valid  corners; the others change nothing.  @param from_healthy  false: all from 1, for ratios between them.
std::optional<Changes> changesOf(const std::array<CornerState, kNumCorners>& corners, const Members& valid,
                                 bool from_healthy) {
  Baseline one;
  one.damping_to_mass = one.stiffness_to_mass = 1.0;
  Changes changes;
  for (const std::size_t corner : valid) {
    const auto& [estimate, healthy] = corners[corner];
    const MeasuredChange change = changeFrom(from_healthy ? healthy : one, estimate);
    if (!change.damping || !change.stiffness) return std::nullopt;
    const Measured &damping = *change.damping, &stiffness = *change.stiffness;
    const double of_damping = square(damping.stddev), of_stiffness = square(stiffness.stddev);
    changes[corner] = {{damping.value, stiffness.value, damping.value - stiffness.value},
                       {of_damping, of_stiffness, of_damping + of_stiffness}};
  }
  return changes;
}

// Of an even number it is the mean of the middle two, which prefers neither sign.
Deviation medianOf(const Changes& changes, const Members& members) {
  Deviation median;
  for (const Part part : {kDamping, kStiffness, kStrut}) {
    std::vector<double> sizes;
    for (const std::size_t corner : members) sizes.push_back(changes[corner].size[part]);
    std::sort(sizes.begin(), sizes.end());
    median[part] = 0.5 * (sizes[(sizes.size() - 1) / 2] + sizes[sizes.size() / 2]);
  }
  return median;
}

Change against(const Change& one, const Change& other) {
  return {one.size - other.size, one.variance + other.variance};
}

Members without(std::size_t corner, Members members) {
  members.erase(std::remove(members.begin(), members.end(), corner), members.end());
  return members;
}

constexpr std::size_t sameAxle(std::size_t corner) { return corner ^ 1u; }

bool has(const Members& members, std::size_t corner) {
  return std::find(members.begin(), members.end(), corner) != members.end();
}

// As ln of a ratio.
double leastDamage() { return std::abs(std::log1p(-HealthThresholds().damping_warn)); }

bool counts(double deviation, double variance) {
  return std::abs(deviation) > leastDamage() && square(deviation) > square(kProven) * variance;
}

// Dampers and springs get weaker. That one of them got stronger explains the same by another load, so it is said only
// where that the other one got weaker would need a load that is none between two wheels.
Part changedPart(const Deviation& deviation) {
  const Part weaker = deviation[kStrut] < 0.0 ? kDamping : kStiffness,
             other = weaker == kDamping ? kStiffness : kDamping;
  const bool is_load = std::abs(deviation[other]) < leastDamage();
  return is_load || std::abs(deviation[weaker]) >= std::abs(deviation[other]) ? weaker : other;
}

// Another load changes damping and stiffness of a corner alike, and not as much as the other wheel's. So where only one
// of the two is damaged the other one of the same corner says what the load did.
void accuse(CornerComparisonReport& report, std::size_t corner, const Change& ratio,
            const std::optional<std::size_t>& partner = {}) {
  const Part part = changedPart(ratio.size), other = part == kDamping ? kStiffness : kDamping;
  const bool both = counts(ratio.size[other], ratio.variance[other]);
  const double size = both ? ratio.size[part] : ratio.size[part] - ratio.size[other];
  report.verdicts[corner] = part == kDamping ? CornerVerdict::kDamper : CornerVerdict::kSpring;
  report.level = HealthLevel::kWarn;
  report.damages.push_back(
      {corner, std::expm1(size), std::sqrt(both ? ratio.variance[part] : ratio.variance[kStrut]), partner});
}

// Accuses the corner furthest from the others, takes it out, and so on.
Members takeOutDamaged(const Changes& changes, Members members, CornerComparisonReport& report) {
  while (members.size() >= 3) {
    const auto deviation = [&](std::size_t corner) {
      return changes[corner].size[kStrut] - medianOf(changes, without(corner, members))[kStrut];
    };
    const std::size_t worst = *std::max_element(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(deviation(a)) < std::abs(deviation(b));
    });
    const Members others = without(worst, members);
    Change median{medianOf(changes, others)};
    for (const std::size_t other : others) median.variance = median.variance.max(changes[other].variance);
    if (!counts(deviation(worst), (median.variance + changes[worst].variance)[kStrut])) break;
    const std::size_t partner = sameAxle(worst);
    accuse(report, worst, against(changes[worst], has(others, partner) ? changes[partner] : median));
    members = others;
  }
  return members;
}

// Of corners that are not damaged: whose mass has changed.
void findLoad(const Changes& changes, const Members& healthy, CornerComparisonReport& report) {
  Members loaded;
  for (const std::size_t corner : healthy) {
    if (!counts(changes[corner].size[kStiffness], changes[corner].variance[kStrut])) continue;
    report.verdicts[corner] = CornerVerdict::kLoad;
    loaded.push_back(corner);
  }
  if (!loaded.empty()) report.load = std::expm1(medianOf(changes, loaded)[kStiffness]);
  const double common = medianOf(changes, healthy)[kStrut];
  if (counts(common, 0.0)) report.dampers = std::expm1(common);
}

void compareWithAll(const Changes& changes, const Members& valid, CornerComparisonReport& report) {
  for (const std::size_t corner : valid) {
    const Deviation deviation = changes[corner].size - medianOf(changes, without(corner, valid));
    report.damping_deviation[corner] = std::expm1(deviation[kDamping]);
    report.stiffness_deviation[corner] = std::expm1(deviation[kStiffness]);
  }
  findLoad(changes, takeOutDamaged(changes, valid, report), report);
}

void compareAxles(const Changes& changes, const Members& valid, CornerComparisonReport& report) {
  for (const std::size_t left : {std::size_t{0}, std::size_t{2}}) {
    const std::size_t right = sameAxle(left);
    if (!has(valid, left) || !has(valid, right)) {
      report.verdicts[left] = report.verdicts[right] = CornerVerdict::kCannotTell;
      continue;
    }
    const Change ratio = against(changes[left], changes[right]);
    if (!counts(ratio.size[kStrut], ratio.variance[kStrut])) continue;
    const std::size_t weaker = ratio.size[changedPart(ratio.size)] < 0.0 ? left : right, other = sameAxle(weaker);
    accuse(report, weaker, against(changes[weaker], changes[other]), other);
  }
}

// A baseline that was learned may be that of a damaged vehicle: then its own left and right differ.
void compareBaselines(std::array<CornerState, kNumCorners> corners, const Members& valid,
                      CornerComparisonReport& report) {
  for (const std::size_t corner : valid) {
    auto& [estimate, healthy] = corners[corner];
    if (!healthy.learned) return;
    estimate.damping_to_mass = *healthy.damping_to_mass;
    estimate.stiffness_to_mass = *healthy.stiffness_to_mass;
    estimate.damping_to_mass_stddev = healthy.damping_to_mass_stddev;
    estimate.stiffness_to_mass_stddev = healthy.stiffness_to_mass_stddev;
  }
  CornerComparisonReport then = report;
  compareAxles(*changesOf(corners, valid, false), valid, then);
  if (!then.damages.empty()) report = then;
}

}  // namespace

std::optional<CornerPlaces> cornersAmong(const std::vector<std::string>& struts) {
  CornerPlaces places{};
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    const auto corner = std::find(struts.begin(), struts.end(), kCornerNames[i]);
    if (corner == struts.end()) return std::nullopt;
    places[i] = corner - struts.begin();
  }
  return places;
}

CornerComparisonReport compareCorners(const std::array<CornerState, kNumCorners>& corners) {
  CornerComparisonReport report;
  Members valid;
  for (std::size_t corner = 0; corner < kNumCorners; ++corner)
    (corners[corner].estimate.valid() ? valid : report.missing).push_back(corner);
  if (valid.size() < 3) return report;
  report.level = report.missing.empty() ? HealthLevel::kOk : HealthLevel::kStale;
  for (const std::size_t corner : valid) report.verdicts[corner] = CornerVerdict::kAlike;
  const std::optional<Changes> changes = changesOf(corners, valid, true);
  report.by_nominal = changes.has_value();
  if (changes)
    compareWithAll(*changes, valid, report);
  else
    compareAxles(*changesOf(corners, valid, false), valid, report);  // a valid estimate is above 0
  if (changes && report.damages.empty()) compareBaselines(corners, valid, report);
  return report;
}

}  // namespace suspension_health_monitor
