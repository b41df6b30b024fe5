#include "strut_diagnostics.h"

#include <ros/console.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

// The worst first; that nothing is known is no level of the strut.
constexpr std::array kLevels{HealthLevel::kError, HealthLevel::kWarn, HealthLevel::kOk, HealthLevel::kStale};

std::string describe(const StrutEstimate& estimate) {
  if (!estimate.valid()) return "estimate not valid: " + describe(estimate.doubt);
  return formatted("estimate: damping/mass %.4g +- %.2g 1/s, stiffness/mass %.4g +- %.2g 1/s^2",
                   estimate.damping_to_mass, estimate.damping_to_mass_stddev, estimate.stiffness_to_mass,
                   estimate.stiffness_to_mass_stddev);
}

void log(const std::string& line) { ROS_INFO("%s", line.c_str()); }

// By the time that a node ends, ROS logs no more; and a manager may not end well, so nothing must stay in a buffer.
void print(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

void addEstimate(Status& status, const std::string& name, const StrutEstimate& estimate) {
  status.addf(name + " damping_to_mass [1/s]", "%.4g", estimate.damping_to_mass);
  status.addf(name + " stiffness_to_mass [1/s^2]", "%.5g", estimate.stiffness_to_mass);
  status.addf(name + " explained [%]", "%.1f", 100.0 * estimate.explained);
  status.add(name + " valid", estimate.valid());
}

void addJudgement(Status& status, const std::string& name, const std::optional<double>& nominal,
                  const std::optional<double>& change) {
  if (nominal) status.addf("nominal " + name, "%.5g", *nominal);
  if (change) status.addf(name + " change [%]", "%+.1f", 100.0 * *change);
}

void describeDiagnosis(const LiveModel& model, Status& status) {
  const std::optional<Diagnosis>& diagnosis = model.diagnosis();
  if (!diagnosis) return;
  if (const std::vector<std::string> missing = model.missing(); !missing.empty())
    status.mergeSummary(Status::WARN, std::string("the last diagnosis ") +
                                          (diagnosis->verdict == Verdict::kSuspect ? "suspects" : "found") +
                                          ", not in the model: " + join(missing, ", "));
  if (diagnosis->verdict == Verdict::kUnexplained)
    status.mergeSummary(Status::WARN, "the last diagnosis: something is missing that no effect explains");
  status.add("diagnosed", nameOf(diagnosis->verdict));
  status.add("diagnosed effects", join(diagnosis->selected, ", "));
  status.addf("diagnosed structured share [%]", "%.1f", 100.0 * diagnosis->structured_share);
  status.addf("diagnosed noise floor [m/s^2]", "%.4g", diagnosis->noise_floor);
  status.addf("diagnosed from stamp [s]", "%.3f", toSeconds(diagnosis->from));
  status.addf("diagnosed to stamp [s]", "%.3f", toSeconds(diagnosis->to));
}

}  // namespace

DriveSummary::DriveSummary(const std::string& strut, double timeout)
    : strut_(strut), timeout_(timeout), times_(fromSeconds(timeout)) {}

DriveSummary::~DriveSummary() { tell("", &print); }

void DriveSummary::add(const MonitorReport& report) {
  if (newest_.stamp > Stamp::zero()) times_.pass(std::max(Stamp::zero(), report.stamp - newest_.stamp), [] {});
  times_.report(report.health.level);
  newest_ = report;
  is_news_ = true;
}

void DriveSummary::watchClock() {
  const ros::Time now = ros::Time::now();
  const ros::WallTime wall = ros::WallTime::now();
  if (!ros::Time::isSimTime() || now != clock_) {
    clock_ = now;
    stands_since_ = wall;
  }
  if ((wall - stands_since_).toSec() > timeout_) tell(" until the clock stopped", &log);
}

void DriveSummary::tell(const char* until, void (*say)(const std::string& line)) {
  if (!is_news_) return;
  is_news_ = false;
  const auto lasted = [this](HealthLevel level) { return toSeconds(times_.of(level)); };
  std::vector<std::string> levels;
  for (const HealthLevel level : kLevels)
    if (lasted(level) > 0.0) levels.push_back(formatted("%s %.1f s", nameOf(level), lasted(level)));
  if (levels.empty()) return;
  const auto* const worst =
      std::find_if(kLevels.begin(), kLevels.end(), [&](HealthLevel level) { return lasted(level) > 0.0; });
  say(formatted("%s: driven for %.1f s%s, worst level %s (%s)", strut_.c_str(), toSeconds(times_.elapsed()), until,
                nameOf(*worst), join(levels).c_str()));
  say(strut_ + ": at the end " + nameOf(newest_.health.level) + ", " + describe(newest_.health));
  say(strut_ + ": " + describe(newest_.estimate));
}

void describeHealth(const SuspensionMonitor& monitor, Status& status) {
  const MonitorReport& report = monitor.report();
  status.summary(static_cast<unsigned char>(report.health.level), describe(report.health));
  addEstimate(status, "estimate", report.estimate);
  status.addf("estimate age [s]", "%.1f", report.estimate.age);
  addEstimate(status, "la", report.la);
  addEstimate(status, "ls", report.ls);
  const Baseline& baseline = monitor.baseline();
  addJudgement(status, "damping_to_mass", baseline.damping_to_mass, report.health.damping_change);
  addJudgement(status, "stiffness_to_mass", baseline.stiffness_to_mass, report.health.stiffness_change);
  if (const std::optional<DryFriction>& friction = report.estimate.friction) {
    status.addf("dry friction [m/s^2]", "%.4f", friction->force);
    status.addf("dry friction stddev [m/s^2]", "%.4f", friction->stddev);
  }
  if (const auto& celsius = report.estimate.temperature) status.addf("temperature [deg C]", "%.1f", *celsius);
  if (report.health.payload_change) status.addf("body mass change [%]", "%+.1f", 100.0 * *report.health.payload_change);
  if (report.health.learning) status.addf("baseline learned [%]", "%.0f", 100.0 * *report.health.learning);
  status.add("early warning", report.health.early_warning);
  status.add("outliers or saturation", report.health.outliers);
  status.add("sensor fault", describe(report.health.sensor));
}

void describeModel(const LiveModel& model, const SuspensionMonitor& monitor, Status& status) {
  status.summary(Status::OK, model.describe());
  const ComparisonReport& comparison = monitor.report().comparison;
  status.addf("rmse [m/s^2]", "%.4g", comparison.rmse);
  status.addf("fit [%]", "%.2f", comparison.fit_percent);
  status.addf("base rmse [m/s^2]", "%.4g", comparison.base_rmse);
  status.addf("base fit [%]", "%.2f", comparison.base_fit_percent);
  for (const ActiveEffect& active : monitor.effects())
    status.addf(active.effect.name + " [" + active.effect.unit + "]", "%.5g", active.coefficient);
  describeDiagnosis(model, status);
}

}  // namespace suspension_health_monitor
