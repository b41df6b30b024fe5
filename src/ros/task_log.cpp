#include "task_log.h"

#include <ros/console.h>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

ros::console::Level lineOf(unsigned char level) {
  if (level == DiagnosticStatus::ERROR) return ros::console::levels::Error;
  return level == DiagnosticStatus::WARN ? ros::console::levels::Warn : ros::console::levels::Info;
}

}  // namespace

void TaskLog::note(const Status& status) {
  const auto level = static_cast<unsigned char>(status.level);
  const ros::WallTime now = ros::WallTime::now();
  if (!now_ || now_->value != level) now_ = Level{level, now};
  if (told_ == level || now - now_->since < lasting_) return;
  const bool is_worth_telling = level >= least_ || (told_ && *told_ >= least_);
  told_ = level;
  if (is_worth_telling)
    ROS_LOG(lineOf(level), ROSCONSOLE_DEFAULT_NAME, "%s: %s: %s", task_.c_str(),
            nameOf(static_cast<HealthLevel>(level)), status.message.c_str());
}

}  // namespace suspension_health_monitor
