#include <cmath>

#include "suspension_health_monitor/internal/health/assessment.h"

namespace suspension_health_monitor {
namespace {

std::string percentOf(double change) { return std::to_string(std::lround(100.0 * std::abs(change))) + " %"; }

const char* direction(double change) { return change < 0.0 ? " below" : " above"; }

std::string describeChange(const char* parameter, const std::optional<double>& change, double significance,
                           const char* reference) {
  if (!change) return {};
  if (std::lround(100.0 * std::abs(*change)) == 0) return std::string(parameter) + " at " + reference;
  std::string text = std::string(parameter) + " " + percentOf(*change) + direction(*change) + " " + reference;
  if (std::isfinite(significance)) text += " (" + std::to_string(std::lround(significance)) + " sigma)";
  return text;
}

void append(std::string& text, const std::string& part, const char* separator = ", ") {
  if (part.empty()) return;
  if (!text.empty()) text += separator;
  text += part;
}

std::string describeChanges(const HealthReport& report) {
  const char* reference = report.learned ? "baseline" : "nominal";
  std::string text = describeChange("damping", report.damping_change, report.damping_significance, reference);
  append(text, describeChange("stiffness", report.stiffness_change, report.stiffness_significance, reference));
  if (report.payload_change && std::lround(100.0 * std::abs(*report.payload_change)) != 0)
    append(text, "body mass " + percentOf(*report.payload_change) + direction(*report.payload_change));
  return text;
}

std::string describeJudgement(const HealthReport& report) {
  if (report.level == HealthLevel::kStale && report.uncertain)
    return "cannot tell: estimates too uncertain to prove a change (drive on, or on a rougher road)";
  if (report.level == HealthLevel::kStale && report.estimate_valid)
    return "cannot tell yet: a new level must last for health/confirm_time";
  if (report.level == HealthLevel::kStale) return "cannot tell: " + std::string(describe(report.doubt));
  const std::string changes = describeChanges(report);
  if (!changes.empty()) return changes;
  if (!report.learning) return "estimates valid; no nominal values given to judge them by";
  return "learning the baseline: " + std::to_string(std::lround(100.0 * *report.learning)) + " % of the learning time" +
         (report.learning_restarted ? " (begun anew: the strut was changing)" : "");
}

}  // namespace

std::string describe(const HealthReport& report) {
  std::string text = describe(report.sensor);
  append(text, describeJudgement(report), "; ");
  if (report.early_warning) append(text, "early warning: a small change is certain", "; ");
  if (report.outliers) append(text, "outliers or saturation present (LS and LA disagree)", "; ");
  return text;
}

}  // namespace suspension_health_monitor
