#include "arrivals.h"

#include <algorithm>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

constexpr double kShownLag = 0.0005;    // [s] half of the last digit that is shown
constexpr double kTopicsEvery = 0.5;    // [s]
constexpr std::size_t kMostOthers = 6;  // topics that a person reads through

std::map<std::string, std::string> publishedTopics() {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  std::map<std::string, std::string> types;
  for (const ros::master::TopicInfo& topic : topics) types[topic.name] = topic.datatype;
  return types;
}

const std::map<std::string, std::string>& PublishedTopics::now() {
  const ros::WallTime time = ros::WallTime::now();
  if ((time - asked_).toSec() < kTopicsEvery) return topics_;
  asked_ = time;
  return topics_ = publishedTopics();
}

void Arrivals::note(const ros::Time& stamp) {
  if (!last_) last_ = Last{};
  last_->by_clock = ros::Time::now();
  last_->by_wall = ros::WallTime::now();
  last_->lag.add(last_->by_clock.toSec() - stamp.toSec());
}

void Arrivals::describeLag(const std::string& name, const std::optional<double>& max_lag, Status& status) const {
  if (!last_) return;
  const double lag = last_->lag.mean();
  status.addf(name + " lag [s]", "%.3f", std::max(lag, 0.0));
  // Stamps ahead of the clock are normal in a simulation, by as much as its clock ticks more coarsely than its sensors
  // read. On a robot they mean that the clocks are not synchronised.
  if (lag <= -kShownLag) status.addf(name + " ahead of the clock [s]", "%.3f", -lag);
  if (max_lag && lag > *max_lag) status.mergeSummaryf(Status::WARN, "%s IMU is %.3g s late", name.c_str(), lag);
}

// A sensor counts as silent when it is so by the clock that stamps the data and by the wall clock. The first alone
// stands still while a simulation is paused; the second alone would call a replay silent that is slower than life.
void Arrivals::describeSilence(PublishedTopics& published, Status& status) const {
  if (!last_) return status.mergeSummary(Status::ERROR, "no message yet on " + topic_ + whatElseThereIs(published));
  const double by_wall = (ros::WallTime::now() - last_->by_wall).toSec();
  const double by_clock = ros::Time::now().toSec() - last_->by_clock.toSec();
  const bool clock_went_back = by_clock < 0.0;
  if (by_wall > timeout_ && (by_clock > timeout_ || clock_went_back))
    status.mergeSummaryf(Status::ERROR, "no message on %s for %.1f s", topic_.c_str(),
                         clock_went_back ? by_wall : by_clock);
}

// Somebody has mistyped a name, or forgotten to remap it.
std::string Arrivals::whatElseThereIs(PublishedTopics& published) const {
  if ((ros::WallTime::now() - begun_).toSec() < timeout_) return "";
  std::vector<std::string> others;
  for (const auto& [topic, type] : published.now())
    if (type == type_ && topic != topic_) others.push_back(topic);
  if (others.empty()) return "";
  if (others.size() > kMostOthers) {
    others.resize(kMostOthers);
    others.emplace_back("...");
  }
  return " (" + type_ + " is on " + join(others, ", ") + ")";
}

}  // namespace suspension_health_monitor
