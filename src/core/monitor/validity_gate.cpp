#include "suspension_health_monitor/internal/monitor/validity_gate.h"

#include <cmath>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

bool agree(double a, double a_stddev, double b, double b_stddev) {
  const double apart = std::abs(a - b);
  return apart <= kLeastDifference * std::abs(b) || apart <= kCertain * std::hypot(a_stddev, b_stddev);
}

bool isKnown(double relative_stddev) { return relative_stddev <= kMostRelativeStddev; }

}  // namespace

bool agree(const StrutEstimate& a, const StrutEstimate& b) {
  return agree(a.damping_to_mass, a.damping_to_mass_stddev, b.damping_to_mass, b.damping_to_mass_stddev) &&
         agree(a.stiffness_to_mass, a.stiffness_to_mass_stddev, b.stiffness_to_mass, b.stiffness_to_mass_stddev);
}

EstimateDoubt doubtOf(const EstimateFacts& f) {
  // Every parameter has the time in its unit: a wrong period makes all wrong.
  if (!f.period_fits) return EstimateDoubt::kWrongPeriod;
  // However well a strut fits them: readings in another unit are not those of this one.
  if (!f.unit_fits) return EstimateDoubt::kWrongUnit;
  // After a start or a gap the filter still holds what was before: estimates are those of before.
  if (!f.has_row) return EstimateDoubt::kNoRows;
  // The start values still count, or the noise of a few rows.
  if (!(f.rows >= f.fewest_rows)) return EstimateDoubt::kFewRows;
  // Parked since the start, or a road too smooth for these sensors.
  if (!isKnown(f.damping_stddev) && !isKnown(f.stiffness_stddev)) return EstimateDoubt::kNotExcited;
  if (!isKnown(f.damping_stddev)) return EstimateDoubt::kDampingNotExcited;
  if (!isKnown(f.stiffness_stddev)) return EstimateDoubt::kStiffnessNotExcited;
  // No strut between these two signals.
  if (!(f.explained >= kMajority)) return EstimateDoubt::kNotExplained;
  // A spring and a damper have positive rates.
  if (!f.is_physical) return EstimateDoubt::kNotAStrut;
  // Swapped topics, wrong positions, a dead gyro: not even changes are known.
  if (std::isinf(f.absolute_stddev)) return EstimateDoubt::kVehicleFile;
  // Parked for long: the strut may have been mended meanwhile.
  if (!(f.age <= f.oldest)) return EstimateDoubt::kOldData;
  // LS and LA know neither the noise of the regressors nor the clocks' difference.
  if (!f.agrees) return EstimateDoubt::kDisagrees;
  // However small the rows' residuals: parameters whose free run is worse than a constant are not the strut's.
  if (f.free_run_fails) return EstimateDoubt::kFreeRunFails;
  // Last: all else may be said of the strut.
  if (!isKnown(f.absolute_stddev)) return EstimateDoubt::kModelError;
  return EstimateDoubt::kNone;
}

}  // namespace suspension_health_monitor
