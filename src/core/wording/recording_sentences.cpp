#include "suspension_health_monitor/internal/wording/recording_sentences.h"

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/signal/tuning.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSpike = 50.0;  // mean deviations

std::string describeSpike(const char* side, const StreamGate& gate) {
  if (!(gate.farthest() > kSpike * gate.deviation() && gate.deviation() > 0.0)) return {};
  return formatted(
      "; a %s reading is %.3g m/s^2 off the mean, %.0f times as far as usual: a spike? %s_range keeps out "
      "what lies beyond it",
      side, gate.farthest(), gate.farthest() / gate.deviation(), side);
}

// Of readings whose fourth powers vanish nothing can be computed, see isUsable().
std::string describeStillness(const char* side, const StreamGate& gate) {
  if (gate.clock().period() == 0.0 || gate.deviation() > 1e-60) return {};
  return formatted("; the %s readings differ by %.3g m/s^2 only: a dead sensor, or not in m/s^2?", side,
                   gate.deviation());
}

std::string healthyValue(const char* name, const std::optional<double>& value, double stddev, const char* unit) {
  if (!value) return {};
  const std::string spread = stddev > 0.0 ? formatted(" +- %.2g", stddev) : "";
  return formatted("%s %.5g", name, *value) + spread + ' ' + unit;
}

std::string describe(AlignmentJudge::Verdict verdict) {
  switch (verdict) {
    case AlignmentJudge::Verdict::kApart: return "the sensors read at different instants";
    case AlignmentJudge::Verdict::kLoneReadings: return "many readings find no partner: the sensors' rates differ";
    case AlignmentJudge::Verdict::kInterrupted:
      return "readings are lost so often that the integral filter would hardly ever be full";
    case AlignmentJudge::Verdict::kDoesWell: break;
  }
  return "";
}

}  // namespace

std::string describeRejected(const RejectCounts& rejected) {
  std::string text;
  for (const auto& [reason, count] : rejected.byName()) text += "; rejected " + reason + ": " + std::to_string(count);
  return text;
}

std::string describe(const ChangedStretch& stretch) {
  return formatted(
      "the strut changes over the drive, or is no plain spring and damper: from about %.0f to %.0f s damping/mass is "
      "%+.0f %% and stiffness/mass %+.0f %% off the rest; identify a drive, or a part of one, in which nothing changes",
      stretch.from, stretch.to, 100.0 * stretch.damping, 100.0 * stretch.stiffness);
}

std::string describeSlowReadings(const StreamGrid& grid) {
  const double spacing = grid.longestPeriod();
  if (spacing < 1.5 * grid.period()) return "";
  return formatted("readings come every %.4g s (%.4g Hz), but sample_period = %.4g [s]", spacing, 1.0 / spacing,
                   grid.period());
}

std::string describeAlignment(const StreamGrid& grid) {
  if (!grid.resamples()) return "paired";
  const bool is_interrupted = grid.verdict() == AlignmentJudge::Verdict::kInterrupted;
  const std::string slow = is_interrupted ? describeSlowReadings(grid) : "";
  const std::string why = slow.empty() ? describe(grid.verdict()) : slow;
  return why.empty() ? "resampled" : "resampled because " + why;
}

std::string describeNoPeriod(const std::string& where, std::size_t count) {
  const std::size_t fewest = PeriodMeasurement::kFewestOfRecording;
  return "the sample period cannot be measured: fewer than " + std::to_string(fewest) + " increasing stamps " + where +
         " (of " + std::to_string(count) + " readings; " + std::to_string(fewest + 1) + " of each are enough)";
}

std::string describeNoStart(const std::string& where) {
  return "the sample period cannot be measured: too few readings with increasing stamps " + where + " (" +
         std::to_string(FirstReadings::kSpacings + 1) + " of each are enough)";
}

std::string describeNoRow(const SuspensionMonitor& monitor, const StreamGrid& grid, const RejectCounts& rejected) {
  if (monitor.input().rows > 0) return {};
  const int enough = MonitorSettings(monitor.options()).samplesOfRow(monitor.period());
  std::string message = "no regression row: an uninterrupted stretch of more than two horizons is needed (" +
                        std::to_string(enough) + formatted(" samples, %.3g s", enough * monitor.period()) +
                        "; usable samples in all: " + std::to_string(monitor.input().samples) +
                        ", gaps: " + std::to_string(monitor.input().gaps) + ")";
  const std::string slow = describeSlowReadings(grid);
  if (!slow.empty()) message += "; " + slow;
  return message + describeRejected(rejected);
}

std::string describeShortPeriod(double sample_period, const std::optional<double>& spacing) {
  if (!spacing || *spacing <= kSignalTuning.slowest * sample_period) return {};
  return formatted("sample_period = %.9g [s], must be at least %.6g: the stamps come every %.6g s", sample_period,
                   *spacing / kSignalTuning.slowest, *spacing);
}

std::string describeReference(const Baseline& baseline, const std::string& file) {
  if (baseline.isEmpty()) return "nothing: no nominal values, no baseline_file, and no baseline was learned";
  const std::string values =
      join({healthyValue("damping/mass", baseline.damping_to_mass, baseline.damping_to_mass_stddev, "1/s"),
            healthyValue("stiffness/mass", baseline.stiffness_to_mass, baseline.stiffness_to_mass_stddev, "1/s^2")});
  if (!baseline.learned) return "nominal values: " + values;
  if (!file.empty()) return "the baseline of " + file + ": " + values;
  return formatted("the baseline learned from %.2f s to %.2f s: ", toSeconds(baseline.from), toSeconds(baseline.to)) +
         values;
}

std::string describeSuspicions(const MonitorReport& report, const StreamGrid* grid) {
  SensorReport sensor = report.health.sensor;
  const bool is_negative = report.la.damping_to_mass < -kProven * report.la.damping_to_mass_stddev;
  if (is_negative && (sensor.fault == SensorFault::kNone || sensor.fault == SensorFault::kUnrelated))
    sensor.fault = SensorFault::kNegativeDamping;
  const std::string found = sensor.fault == SensorFault::kNone ? "" : "; " + describe(sensor);
  // That readings do not belong together may have a reason that these streams show.
  if (grid == nullptr || (!found.empty() && sensor.fault != SensorFault::kUnrelated)) return found;
  const StreamGate &body = grid->gate(indexOf(Side::kSprung)), &wheel = grid->gate(indexOf(Side::kUnsprung));
  std::string text = describeStillness("sprung", body) + describeStillness("unsprung", wheel);
  text += describeSpike("sprung", body) + describeSpike("unsprung", wheel);
  if (body.deviation() > kMuchMore * wheel.deviation() && wheel.deviation() > 0.0)
    text += "; the sprung IMU shakes far more than the unsprung one: swapped, or not in m/s^2?";
  return text.empty() ? found : text;
}

}  // namespace suspension_health_monitor
