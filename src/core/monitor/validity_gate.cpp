#include "suspension_health_monitor/internal/monitor/validity_gate.h"

#include <array>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

bool agree(double a, double a_stddev, double b, double b_stddev) {
  const double apart = std::abs(a - b);
  return apart <= kLeastDifference * std::abs(b) || apart <= kCertain * std::hypot(a_stddev, b_stddev);
}

bool isKnown(double relative_stddev) { return relative_stddev <= kMostRelativeStddev; }

using Rule = std::pair<EstimateDoubt, bool (*)(const EstimateFacts&)>;

constexpr std::array kRules{
    // Every parameter has the time in its unit: a wrong period makes all wrong.
    Rule{EstimateDoubt::kWrongPeriod, [](const EstimateFacts& f) { return !f.period_fits; }},
    // However well a strut fits them: readings in another unit are not those of this one.
    Rule{EstimateDoubt::kWrongUnit, [](const EstimateFacts& f) { return !f.unit_fits; }},
    // After a start or a gap the filter still holds what was before: estimates are those of before.
    Rule{EstimateDoubt::kNoRows, [](const EstimateFacts& f) { return !f.has_row; }},
    // The start values still count, or the noise of a few rows.
    Rule{EstimateDoubt::kFewRows, [](const EstimateFacts& f) { return !(f.rows >= f.fewest_rows); }},
    // Parked since the start, or a road too smooth for these sensors.
    Rule{EstimateDoubt::kNotExcited,
         [](const EstimateFacts& f) { return !isKnown(f.damping_stddev) && !isKnown(f.stiffness_stddev); }},
    Rule{EstimateDoubt::kDampingNotExcited, [](const EstimateFacts& f) { return !isKnown(f.damping_stddev); }},
    Rule{EstimateDoubt::kStiffnessNotExcited, [](const EstimateFacts& f) { return !isKnown(f.stiffness_stddev); }},
    // No strut between these two signals.
    Rule{EstimateDoubt::kNotExplained, [](const EstimateFacts& f) { return !(f.explained >= kMajority); }},
    // A spring and a damper have positive rates.
    Rule{EstimateDoubt::kNotAStrut, [](const EstimateFacts& f) { return !f.is_physical; }},
    // Swapped topics, wrong positions, a dead gyro: not even changes are known.
    Rule{EstimateDoubt::kVehicleFile, [](const EstimateFacts& f) { return std::isinf(f.absolute_stddev); }},
    // Parked for long: the strut may have been mended meanwhile.
    Rule{EstimateDoubt::kOldData, [](const EstimateFacts& f) { return !(f.age <= f.oldest); }},
    // LS and LA know neither the noise of the regressors nor the clocks' difference.
    Rule{EstimateDoubt::kDisagrees, [](const EstimateFacts& f) { return !f.agrees; }},
    // However small the rows' residuals: parameters whose free run is worse than a constant are not the strut's.
    Rule{EstimateDoubt::kFreeRunFails, [](const EstimateFacts& f) { return f.free_run_fails; }},
    // Last: all else may be said of the strut.
    Rule{EstimateDoubt::kModelError, [](const EstimateFacts& f) { return !isKnown(f.absolute_stddev); }},
};

}  // namespace

bool agree(const StrutEstimate& a, const StrutEstimate& b) {
  return agree(a.damping_to_mass, a.damping_to_mass_stddev, b.damping_to_mass, b.damping_to_mass_stddev) &&
         agree(a.stiffness_to_mass, a.stiffness_to_mass_stddev, b.stiffness_to_mass, b.stiffness_to_mass_stddev);
}

EstimateDoubt doubtOf(const EstimateFacts& facts) {
  const auto rule = std::find_if(kRules.begin(), kRules.end(), [&](const Rule& r) { return r.second(facts); });
  return rule == kRules.end() ? EstimateDoubt::kNone : rule->first;
}

}  // namespace suspension_health_monitor
