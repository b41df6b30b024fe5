#include "suspension_health_monitor/internal/monitor/validity_gate.h"

#include <algorithm>
#include <array>

namespace suspension_health_monitor {
namespace {

struct Rule {
  EstimateDoubt doubt;
  bool (*applies)(const EstimateFacts&);
};

constexpr std::array kRules{
    // Every parameter has the time in its unit: a wrong period makes all wrong.
    Rule{EstimateDoubt::kWrongPeriod, [](const EstimateFacts& f) { return !f.period_fits; }},
    // After a start or a gap the filter still holds what was before: estimates are those of before.
    Rule{EstimateDoubt::kNoRows, [](const EstimateFacts& f) { return !f.has_row; }},
    // Without any noise there is no motion but a stuck sensor or a simulated vehicle at rest.
    Rule{EstimateDoubt::kSensorStuck, [](const EstimateFacts& f) { return !f.sensor_moves; }},
    // The start values still count, or the noise of a few rows.
    Rule{EstimateDoubt::kFewRows, [](const EstimateFacts& f) { return !(f.rows >= f.fewest_rows); }},
    // Parked: rows are noise, the estimates are held as they were.
    Rule{EstimateDoubt::kNotExcited, [](const EstimateFacts& f) { return !f.excites_damping && !f.excites_stiffness; }},
    Rule{EstimateDoubt::kDampingNotExcited, [](const EstimateFacts& f) { return !f.excites_damping; }},
    Rule{EstimateDoubt::kStiffnessNotExcited, [](const EstimateFacts& f) { return !f.excites_stiffness; }},
    // Noise and what is folded back drive no strut, though the wheel seems to move like that.
    Rule{EstimateDoubt::kWrongReadings, [](const EstimateFacts& f) { return !(f.wrong_share <= kMostWrongShare); }},
    // The regression takes any motion of the body for the wheel's doing.
    Rule{EstimateDoubt::kOutsideForce, [](const EstimateFacts& f) { return f.outside_force; }},
    // No strut between these two signals.
    Rule{EstimateDoubt::kNotExplained, [](const EstimateFacts& f) { return !(f.explained >= kLeastExplained); }},
    // A level that changes looks like travel that no spring answers.
    Rule{EstimateDoubt::kOffsetChanges, [](const EstimateFacts& f) { return !(f.level_share <= kMostWrongShare); }},
    // A spring and a damper have positive rates.
    Rule{EstimateDoubt::kNotAStrut, [](const EstimateFacts& f) { return !f.is_physical; }},
    // A larger skew would explain more, and the strut would be another one.
    Rule{EstimateDoubt::kClockSkew, [](const EstimateFacts& f) { return !f.skew_is_known; }},
    // An estimate without a standard deviation cannot be judged.
    Rule{EstimateDoubt::kNoSpread, [](const EstimateFacts& f) { return !f.has_stddev; }},
    // However small the rows' residuals: parameters whose free run is worse than a constant are not the strut's.
    Rule{EstimateDoubt::kFreeRunFails, [](const EstimateFacts& f) { return f.free_run_fails; }},
};

}  // namespace

EstimateDoubt doubtOf(const EstimateFacts& facts) {
  const auto rule = std::find_if(kRules.begin(), kRules.end(), [&](const Rule& r) { return r.applies(facts); });
  return rule == kRules.end() ? EstimateDoubt::kNone : rule->doubt;
}

}  // namespace suspension_health_monitor
