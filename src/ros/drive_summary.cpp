#include "drive_summary.h"

#include <ros/console.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

// The worst first; that nothing is known is no level of the strut.
constexpr std::array kLevels{HealthLevel::kError, HealthLevel::kWarn, HealthLevel::kOk, HealthLevel::kStale};

std::string describe(const char* name, const StrutEstimate& estimate) {
  if (!estimate.valid()) return formatted("%s not valid: %s", name, describe(estimate.doubt).c_str());
  return formatted("%s: damping/mass %.4g +- %.2g 1/s, stiffness/mass %.4g +- %.2g 1/s^2", name,
                   estimate.damping_to_mass, estimate.damping_to_mass_stddev, estimate.stiffness_to_mass,
                   estimate.stiffness_to_mass_stddev);
}

void log(const std::string& line) { ROS_INFO("%s", line.c_str()); }

// By the time that a node ends, ROS logs no more; and a manager may not end well, so nothing must stay in a buffer.
void print(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
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
  say(strut_ + ": " + describe("estimate", newest_.estimate));
}

}  // namespace suspension_health_monitor
