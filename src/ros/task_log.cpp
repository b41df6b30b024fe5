#include "task_log.h"

#include <ros/console.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

ros::console::Level lineOf(unsigned char level) {
  if (level == Status::ERROR) return ros::console::levels::Error;
  return level == Status::WARN ? ros::console::levels::Warn : ros::console::levels::Info;
}

}  // namespace

void TaskLog::note(const Status& status) {
  const Said said = saidBy(status);
  const ros::WallTime now = ros::WallTime::now();
  if (!(now_ == said)) {
    now_ = said;
    since_ = now;
  }
  if (reported_ == said || now - since_ < lasting_) return;
  const bool is_worth_reporting = said.level >= least_ || (reported_ && reported_->level >= least_);
  reported_ = said;
  if (is_worth_reporting)
    ROS_LOG(lineOf(said.level), ROSCONSOLE_DEFAULT_NAME, "%s: %s: %s", task_.c_str(),
            nameOf(static_cast<HealthLevel>(said.level)), status.message.c_str());
}

TaskLog::Said TaskLog::saidBy(const Status& status) const {
  Said said{static_cast<unsigned char>(status.level), {}};
  if (lasting_.isZero() || said.level < least_) return said;
  std::copy_if(status.message.begin(), status.message.end(), std::back_inserter(said.reason),
               [](unsigned char c) { return std::isdigit(c) == 0 && c != '.'; });
  return said;
}

}  // namespace suspension_health_monitor
