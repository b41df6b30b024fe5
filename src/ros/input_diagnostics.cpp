#include "input_diagnostics.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr std::array<const char*, 2> kSideNames{"sprung", "unsprung"};
constexpr double kShownLag = 0.0005;    // [s] half of the last digit that is shown
constexpr double kRateTolerance = 0.1;  // share of the expected rate: drivers keep theirs to a few percent

}  // namespace

InputDiagnostics::InputDiagnostics(const ShellOptions& options, const std::array<ros::Subscriber, 2>& imu)
    : options_(options), topics_{imu[0].getTopic(), imu[1].getTopic()} {}

void InputDiagnostics::noteMessage(Side side, const ros::Time& stamp) {
  std::optional<Arrivals>& arrivals = arrivals_[static_cast<std::size_t>(side)];
  if (!arrivals) arrivals.emplace();
  arrivals->last = ros::Time::now();
  arrivals->last_by_wall = ros::WallTime::now();
  arrivals->lag.add(arrivals->last.toSec() - stamp.toSec());
}

void InputDiagnostics::restart() {
  rejected_before_ = {};
  gaps_before_ = 0;
  refusal_.clear();
}

void InputDiagnostics::describe(const ImuPipeline& pipeline, Status& status) {
  summarize(pipeline, status);
  if (pipeline.monitor() != nullptr) describeSeries(*pipeline.monitor(), status);
  if (pipeline.strut().grid() != nullptr) {
    const std::string slow = pipeline.strut().grid()->resamples() ? "" : pipeline.strut().grid()->whatIsTooSlow();
    if (!slow.empty()) status.mergeSummary(DiagnosticStatus::WARN, slow);
    status.add("alignment", pipeline.strut().grid()->describeAlignment());
    status.add("bridged", pipeline.strut().grid()->bridged());
  }
  for (const Side side : {Side::kSprung, Side::kUnsprung}) describeStream(side, pipeline, status);
  describeRejected(pipeline.rejected(), status);
  describeTransforms(pipeline, status);
  if (refusal_.empty())
    describeSilence(status);
  else
    status.mergeSummary(DiagnosticStatus::ERROR, "stopped listening until reset: " + refusal_);
  describeClock(status);
}

void InputDiagnostics::summarize(const ImuPipeline& pipeline, Status& status) const {
  const bool any_usable = pipeline.monitor() != nullptr && pipeline.monitor()->input().samples > 0;
  if (!any_usable && pipeline.rejected().total() > 0)
    status.summary(DiagnosticStatus::WARN, "no usable pair of readings yet");
  else if (pipeline.monitor() == nullptr)
    status.summary(DiagnosticStatus::OK, "measuring the sample period");
  else if (ros::Time::isSimTime() && clock_before_ == ros::Time::now() && isSilentByWall())
    status.summary(DiagnosticStatus::OK, "nothing arrives at present");
  else
    status.summary(DiagnosticStatus::OK, "both IMUs arrive as expected");
}

bool InputDiagnostics::isSilentByWall() const {
  return std::all_of(arrivals_.begin(), arrivals_.end(), [this](const std::optional<Arrivals>& arrivals) {
    return arrivals && (ros::WallTime::now() - arrivals->last_by_wall).toSec() > options_.input_timeout;
  });
}

void InputDiagnostics::describeSeries(const SuspensionMonitor& monitor, Status& status) {
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

void InputDiagnostics::describeStream(Side side, const ImuPipeline& pipeline, Status& status) const {
  const auto index = static_cast<std::size_t>(side);
  const std::string name = kSideNames[index];
  if (const std::optional<Arrivals>& arrivals = arrivals_[index]) {
    const double lag = arrivals->lag.mean();
    status.addf(name + " lag [s]", "%.3f", std::max(lag, 0.0));
    // Stamps ahead of the clock are normal in a simulation, by as much as its clock ticks more coarsely than its
    // sensors read. On a robot they mean that the clocks are not synchronised.
    if (lag <= -kShownLag) status.addf(name + " ahead of the clock [s]", "%.3f", -lag);
    if (options_.max_lag && lag > *options_.max_lag)
      status.mergeSummaryf(DiagnosticStatus::WARN, "%s IMU is %.3g s late", name.c_str(), lag);
  }
  if (pipeline.strut().grid() == nullptr) return;
  const StreamTiming& timing = pipeline.strut().grid()->gate(side).timing();
  const double rate = timing.period() > 0.0 ? 1.0 / timing.period() : 0.0;
  status.addf(name + " rate [Hz]", "%.4g", rate);
  status.addf(name + " jitter [s]", "%.3g", timing.jitter());
  status.add(name + " lost", timing.lost());
  status.add(name + " rejected", pipeline.strut().grid()->gate(side).rejected().total());
  const std::optional<double>& expected = side == Side::kSprung ? options_.sprung_rate : options_.unsprung_rate;
  if (expected && rate > 0.0 && std::abs(rate / *expected - 1.0) > kRateTolerance)
    status.mergeSummaryf(DiagnosticStatus::WARN, "%s IMU comes at %.4g Hz, expected %.4g", name.c_str(), rate,
                         *expected);
}

void InputDiagnostics::describeRejected(const RejectCounts& rejected, Status& status) {
  std::string newly;
  for (std::size_t i = 0; i < kRejectReasonNames.size(); ++i) {
    const auto reason = static_cast<RejectReason>(i);
    const std::string name(kRejectReasonNames[i]);
    if (rejected.count(reason) > rejected_before_.count(reason)) newly += (newly.empty() ? "" : ", ") + name;
    status.add("rejected " + name, rejected.count(reason));
  }
  if (!newly.empty()) status.mergeSummary(DiagnosticStatus::WARN, "readings rejected: " + newly);
  rejected_before_ = rejected;
}

void InputDiagnostics::describeTransforms(const ImuPipeline& pipeline, Status& status) const {
  for (const Side side : {Side::kSprung, Side::kUnsprung})
    if (const std::string& frame = pipeline.mount(side).missingTransform(); !frame.empty())
      status.mergeSummary(DiagnosticStatus::ERROR, "no static transform from " + frame + " to target_frame " +
                                                       options_.target_frame + " (/tf_static)");
}

// An IMU counts as silent when it is so by the clock that stamps the data and by the wall clock. The first alone stands
// still while a simulation is paused; the second alone would call a replay silent that is slower than life.
void InputDiagnostics::describeSilence(Status& status) const {
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    const std::optional<Arrivals>& arrivals = arrivals_[i];
    if (!arrivals) {
      status.mergeSummary(DiagnosticStatus::ERROR, "no message yet on " + topics_[i]);
      continue;
    }
    const double by_wall = (ros::WallTime::now() - arrivals->last_by_wall).toSec();
    const double by_clock = ros::Time::now().toSec() - arrivals->last.toSec();
    const bool clock_went_back = by_clock < 0.0;
    if (by_wall > options_.input_timeout && (by_clock > options_.input_timeout || clock_went_back))
      status.mergeSummaryf(DiagnosticStatus::ERROR, "no message on %s for %.1f s", topics_[i].c_str(),
                           clock_went_back ? by_wall : by_clock);
  }
}

void InputDiagnostics::describeClock(Status& status) {
  if (!ros::Time::isSimTime()) return;
  const ros::Time now = ros::Time::now();
  if (now.isZero())
    status.mergeSummary(DiagnosticStatus::ERROR, "use_sim_time is set, but nothing comes on /clock");
  else if (clock_before_ == now)
    status.summary(static_cast<unsigned char>(status.level), status.message + "; the clock stands still");
  clock_before_ = now;
}

}  // namespace suspension_health_monitor
