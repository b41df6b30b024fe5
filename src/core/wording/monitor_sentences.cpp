#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

#include <cmath>

#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

// More standard deviations than that nobody needs to count.
constexpr long kBeyondDoubt = 10;

std::string describeSignificance(long sigmas) {
  if (sigmas == 0) return {};
  return sigmas > kBeyondDoubt ? " (beyond doubt)" : formatted(" (%ld sigma)", sigmas);
}

std::string describeChange(const std::string& parameter, const std::optional<double>& change, double significance,
                           const std::string& reference) {
  if (!change) return {};
  if (std::lround(100.0 * *change) == 0) return parameter + " at " + reference;
  const std::string text =
      parameter + " " + sizeInPercent(*change) + (*change < 0.0 ? " below " : " above ") + reference;
  return std::isfinite(significance) ? text + describeSignificance(std::lround(significance)) : text;
}

std::string describePayload(double change) {
  if (std::lround(100.0 * change) == 0) return {};
  return "body mass " + sizeInPercent(change) + (change < 0.0 ? " below" : " above");
}

const char* referenceOf(bool learned) { return learned ? "baseline" : "nominal"; }

std::string describeChanges(const HealthReport& report) {
  const std::string reference = referenceOf(report.learned);
  return join({describeChange("damping", report.damping_change, report.damping_significance, reference),
               describeChange("stiffness", report.stiffness_change, report.stiffness_significance, reference),
               describePayload(report.payload_change.value_or(0.0))});
}

std::string describe(LoadDoubt doubt) {
  switch (doubt) {
    case LoadDoubt::kNone: return "";
    case LoadDoubt::kLoadOrDamper: return "payload or damper: cannot tell yet";
    case LoadDoubt::kLoadOrSpring: return "payload or spring: cannot tell yet";
    case LoadDoubt::kLoadOrBoth: return "payload, or damper and spring worn alike: one strut alone cannot tell";
  }
  return "";
}

std::string describeJudgement(const HealthReport& report) {
  if (report.level == HealthLevel::kStale && report.uncertain && report.load_doubt != LoadDoubt::kNone)
    return describe(report.load_doubt);
  if (report.level == HealthLevel::kStale && report.uncertain && report.friction_doubt)
    return "cannot tell: dry friction, or a damper that is not linear, makes too much of the difference between this "
           "road and that of the baseline (learn one on such a road)";
  if (report.level == HealthLevel::kStale && report.uncertain)
    return "cannot tell: estimates too uncertain to prove a change (drive on, or on a rougher road)";
  if (report.level == HealthLevel::kStale && report.doubt == EstimateDoubt::kNone)
    return "cannot tell yet: a new level must last for health/confirm_time";
  if (report.level == HealthLevel::kStale) return "cannot tell: " + describe(report.doubt);
  const std::string changes = describeChanges(report);
  if (!changes.empty()) return join({changes, describe(report.load_doubt)}, "; ");
  if (!report.learning) return "estimates valid; no nominal values given to judge them by";
  return "learning the baseline: " + sizeInPercent(*report.learning) + " of the learning time" +
         (report.learning_restarted ? " (begun anew: the strut was changing)" : "");
}

std::string describeShared(const HealthReport& report) {
  if (!report.shared_damping_change) return "";
  const double change = *report.shared_damping_change;
  return "all dampers " + sizeInPercent(change) + (change < 0.0 ? " softer: warm?" : " stiffer: cold?");
}

std::string nameOf(std::size_t corner) { return std::string(kCornerNames[corner]); }

std::string describe(const CornerDamage& damage, CornerVerdict verdict) {
  return nameOf(damage.corner) + (verdict == CornerVerdict::kDamper ? " damping " : " stiffness ") +
         sizeInPercent(damage.change) + (damage.change < 0.0 ? " below " : " above ") +
         (damage.partner ? nameOf(*damage.partner) + " (no baseline)" : "the other corners") + ": damage";
}

std::string describeLoad(const CornerComparisonReport& report) {
  std::vector<std::string> names;
  for (std::size_t corner = 0; corner < kNumCorners; ++corner)
    if (report.verdicts[corner] == CornerVerdict::kLoad) names.push_back(nameOf(corner));
  return (names.size() == report.numValid() ? "all corners" : join(names)) + " stiffness/mass " +
         sizeInPercent(*report.load) + (*report.load < 0.0 ? " down: payload" : " up: unloaded");
}

}  // namespace

const char* nameOf(HealthLevel level) {
  switch (level) {
    case HealthLevel::kOk: return "OK";
    case HealthLevel::kWarn: return "WARN";
    case HealthLevel::kError: return "ERROR";
    case HealthLevel::kStale: break;
  }
  return "STALE";
}

std::string describeSilent(const std::vector<std::string>& topics) {
  return topics.empty() ? "" : join(topics) + (topics.size() == 1 ? " is" : " are") + " silent";
}

std::string describeNoReading(double seconds, const std::vector<std::string>& silent, const std::string& before) {
  const std::string why = silent.empty() ? "" : ", " + describeSilent(silent);
  return formatted("cannot tell: no reading accepted for %.0f s", seconds) + why + "; before: " + before;
}

std::string describe(const HealthReport& report) {
  return join({describe(report.sensor), describeJudgement(report), describeShared(report),
               report.early_warning && report.level == HealthLevel::kOk ? "early warning: a change is certain" : "",
               report.outliers ? "outliers or saturation present (residuals have heavy tails)" : ""},
              "; ");
}

std::string describe(const StrutChange& change, const Baseline& healthy) {
  const std::string reference = referenceOf(healthy.learned);
  const auto part = [&](const char* parameter, const std::optional<double>& size, double stddev) {
    return describeChange(parameter, size, std::abs(std::log1p(size.value_or(0.0))) / stddev, reference);
  };
  return join({part("damping", change.damping, change.damping_stddev),
               part("stiffness", change.stiffness, change.stiffness_stddev),
               describePayload(change.payload.value_or(0.0))});
}

std::string describe(const CornerComparisonReport& report) {
  if (report.numValid() < 3)
    return "cannot tell: " + std::to_string(report.numValid()) + " of 4 corners have a valid estimate, 3 are needed";
  std::vector<std::string> parts;
  for (const CornerDamage& damage : report.damages) parts.push_back(describe(damage, report.verdicts[damage.corner]));
  if (report.load) parts.push_back(describeLoad(report));
  if (report.dampers)
    parts.push_back("damping of all other corners alike " + sizeInPercent(*report.dampers) +
                    (*report.dampers < 0.0 ? " down: warm or worn dampers" : " up: cold dampers"));
  if (parts.empty() && !report.by_nominal) parts.emplace_back("left and right alike (no baseline)");
  if (parts.empty()) parts.emplace_back(report.missing.empty() ? "all corners alike" : "the other corners alike");
  for (const std::size_t corner : report.missing) parts.push_back("no valid estimate of " + nameOf(corner));
  return join(parts, "; ");
}

}  // namespace suspension_health_monitor
