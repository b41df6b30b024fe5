#include "input_history.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kShownLag = 0.0005;    // [s] half of the last digit that is shown
constexpr double kTopicsEvery = 0.5;    // [s]
constexpr std::size_t kMostOthers = 6;  // topics that a person reads through
constexpr double kRateTolerance = 0.1;  // share of the expected rate: drivers keep theirs to a few percent

}  // namespace

const ros::master::V_TopicInfo& PublishedTopics::now() {
  const ros::WallTime time = ros::WallTime::now();
  if ((time - asked_).toSec() < kTopicsEvery) return topics_;
  asked_ = time;
  topics_.clear();
  ros::master::getTopics(topics_);
  return topics_;
}

void ImuArrivals::note(const ros::Time& stamp) {
  if (!last_) last_.emplace();
  last_->by_clock = ros::Time::now();
  last_->by_wall = ros::WallTime::now();
  last_->lag.add(last_->by_clock.toSec() - stamp.toSec());
}

void ImuArrivals::describeLag(const std::string& name, const std::optional<double>& max_lag, Status& status) const {
  if (!last_) return;
  const double lag = last_->lag.mean();
  status.addf(name + " lag [s]", "%.3f", std::max(lag, 0.0));
  // Stamps ahead of the clock are normal in a simulation, by as much as its clock ticks more coarsely than its sensors
  // read. On a robot they mean that the clocks are not synchronised.
  if (lag <= -kShownLag) status.addf(name + " ahead of the clock [s]", "%.3f", -lag);
  if (max_lag && lag > *max_lag)
    status.mergeSummaryf(DiagnosticStatus::WARN, "%s IMU is %.3g s late", name.c_str(), lag);
}

bool ImuArrivals::isSilentByWall() const { return last_ && (ros::WallTime::now() - last_->by_wall).toSec() > timeout_; }

// An IMU counts as silent when it is so by the clock that stamps the data and by the wall clock. The first alone stands
// still while a simulation is paused; the second alone would call a replay silent that is slower than life.
void ImuArrivals::describeSilence(PublishedTopics& published, Status& status) const {
  if (!last_) {
    status.mergeSummary(DiagnosticStatus::ERROR, "no message yet on " + topic_ + whatElseThereIs(published));
    return;
  }
  const double by_wall = (ros::WallTime::now() - last_->by_wall).toSec();
  const double by_clock = ros::Time::now().toSec() - last_->by_clock.toSec();
  const bool clock_went_back = by_clock < 0.0;
  if (by_wall > timeout_ && (by_clock > timeout_ || clock_went_back))
    status.mergeSummaryf(DiagnosticStatus::ERROR, "no message on %s for %.1f s", topic_.c_str(),
                         clock_went_back ? by_wall : by_clock);
}

// Somebody has mistyped a name, or forgotten to remap it.
std::string ImuArrivals::whatElseThereIs(PublishedTopics& published) const {
  if ((ros::WallTime::now() - begun_).toSec() < timeout_) return "";
  std::vector<std::string> others;
  for (const ros::master::TopicInfo& topic : published.now())
    if (topic.datatype == type_ && topic.name != topic_) others.push_back(topic.name);
  if (others.empty()) return "";
  std::sort(others.begin(), others.end());
  if (others.size() > kMostOthers) {
    others.resize(kMostOthers);
    others.emplace_back("...");
  }
  return " (" + type_ + " is on " + join(others, ", ") + ")";
}

void describeTiming(const StreamClock& clock, const std::string& name, const std::optional<double>& expected_rate,
                    ImuArrivals::Status& status) {
  const double rate = clock.period() > 0.0 ? 1.0 / clock.period() : 0.0;
  status.addf(name + " rate [Hz]", "%.4g", rate);
  status.addf(name + " jitter [s]", "%.3g", clock.jitter());
  status.add(name + " lost", clock.lost());
  if (expected_rate && rate > 0.0 && std::abs(rate / *expected_rate - 1.0) > kRateTolerance)
    status.mergeSummaryf(DiagnosticStatus::WARN, "%s IMU comes at %.4g Hz, expected %.4g", name.c_str(), rate,
                         *expected_rate);
}

void SeriesHistory::describe(const SuspensionMonitor& monitor, ImuArrivals::Status& status) {
  const InputStatus& input = monitor.input();
  if (input.gaps + input.restarts > gaps_before_) status.mergeSummary(DiagnosticStatus::WARN, "gap in the input");
  gaps_before_ = input.gaps + input.restarts;
  if (!input.period_fits) status.mergeSummary(DiagnosticStatus::WARN, "stamps do not fit sample_period");
  if (const std::string shaking = describeShaking(input); !shaking.empty())
    status.mergeSummary(DiagnosticStatus::WARN, shaking);
  status.addf("rate [Hz]", "%.4g", input.mean_period > 0.0 ? 1.0 / input.mean_period : 0.0);
  status.addf("sample_period [s]", "%.9g", monitor.period());
  status.addf("horizon_samples", "%d", monitor.horizonSamples());
  status.add("samples", input.samples);
  status.add("regression rows", input.rows);
  status.add("gaps", input.gaps);
  status.add("clock jumps", input.restarts);
}

std::string RejectHistory::describe(const RejectCounts& rejected, const std::string& of, ImuArrivals::Status& status) {
  std::string newly;
  for (std::size_t i = 0; i < kRejectReasonNames.size(); ++i) {
    const auto reason = static_cast<RejectReason>(i);
    const std::string name(kRejectReasonNames[i]);
    if (rejected.count(reason) > before_.count(reason)) newly += (newly.empty() ? "" : ", ") + name;
    status.add((of.empty() ? "" : of + ' ') + "rejected " + name, rejected.count(reason));
  }
  before_ = rejected;
  return newly;
}

void ClockHistory::describe(ImuArrivals::Status& status) {
  if (!ros::Time::isSimTime()) return;
  const ros::Time now = ros::Time::now();
  if (now.isZero())
    status.mergeSummary(DiagnosticStatus::ERROR, "use_sim_time is set, but nothing comes on /clock");
  else if (before_ == now)
    status.summary(static_cast<unsigned char>(status.level), status.message + "; the clock stands still");
  before_ = now;
}

}  // namespace suspension_health_monitor
