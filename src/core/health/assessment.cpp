#include "suspension_health_monitor/health/assessment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

void checkThresholds(const char* parameter, double warn, double error) {
  if (!(error >= warn))
    throw std::invalid_argument("health/" + std::string(parameter) + "_error = " + std::to_string(error) +
                                ", must be at least health/" + parameter + "_warn = " + std::to_string(warn));
}

std::optional<double> relativeChange(double value, const std::optional<double>& nominal) {
  if (!nominal) return std::nullopt;
  return value / *nominal - 1.0;
}

HealthLevel judge(const std::optional<double>& change, double warn, double error) {
  if (!change || std::abs(*change) < warn) return HealthLevel::kOk;
  return std::abs(*change) < error ? HealthLevel::kWarn : HealthLevel::kError;
}

// Both worse than `level`, or both better. Not being able to tell confirms nothing but itself.
bool confirmEachOther(HealthLevel level, HealthLevel a, HealthLevel b) {
  if ((a == HealthLevel::kStale) != (b == HealthLevel::kStale)) return false;
  return (a > level && b > level) || (a < level && b < level);
}

std::string describeChange(const char* parameter, const std::optional<double>& change) {
  if (!change) return {};
  const long percent = std::lround(100.0 * std::abs(*change));
  if (percent == 0) return std::string(parameter) + " at nominal";
  return std::string(parameter) + " " + std::to_string(percent) + " % " + (*change < 0.0 ? "below" : "above") +
         " nominal";
}

}  // namespace

void HealthOptions::validate() const {
  checkThresholds("damping", damping_warn, damping_error);
  checkThresholds("stiffness", stiffness_warn, stiffness_error);
}

HealthAssessment::HealthAssessment(const HealthOptions& options)
    : options_(options), confirm_time_(fromSeconds(options.confirm_time)) {
  options.validate();
}

void HealthAssessment::setOptions(const HealthOptions& options) {
  options.validate();
  options_ = options;
  confirm_time_ = fromSeconds(options.confirm_time);
}

const HealthReport& HealthAssessment::update(Stamp stamp, const StrutEstimate& estimate) {
  HealthReport now;
  if (estimate.valid) {
    now.damping_change = relativeChange(estimate.damping_to_mass, options_.nominal_damping_to_mass);
    now.stiffness_change = relativeChange(estimate.stiffness_to_mass, options_.nominal_stiffness_to_mass);
    now.damping_level = judge(now.damping_change, options_.damping_warn, options_.damping_error);
    now.stiffness_level = judge(now.stiffness_change, options_.stiffness_warn, options_.stiffness_error);
    now.level = std::max(now.damping_level, now.stiffness_level);
  }
  const HealthLevel reported = report_.level;
  if (now.level == reported && pending_ == reported && stamp >= pending_since_) {  // nothing new, as nearly always
    report_ = now;
    return report_;
  }
  if (stamp < pending_since_ || !confirmEachOther(reported, now.level, pending_)) {
    pending_ = now.level;
    pending_since_ = stamp;
  } else {
    pending_ = now.level > reported ? std::min(now.level, pending_) : std::max(now.level, pending_);
  }
  const bool confirmed = now.level == reported || stamp - pending_since_ >= confirm_time_;
  const HealthLevel level = confirmed ? pending_ : reported;
  if (estimate.valid || level == HealthLevel::kStale)
    report_ = now;  // else the last judgement stands, with its reasons
  report_.level = level;
  return report_;
}

std::string describe(const HealthReport& report) {
  const std::string damping = describeChange("damping", report.damping_change);
  const std::string stiffness = describeChange("stiffness", report.stiffness_change);
  if (report.level == HealthLevel::kStale) return "cannot tell: no valid estimate (starting, parked, or poor input)";
  if (damping.empty() && stiffness.empty()) return "estimates valid; no nominal values given to judge them by";
  return damping + (damping.empty() || stiffness.empty() ? "" : ", ") + stiffness;
}

}  // namespace suspension_health_monitor
