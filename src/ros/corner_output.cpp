#include "corner_output.h"

#include <suspension_health_monitor/CornerComparison.h>

#include <algorithm>
#include <boost/make_shared.hpp>

#include "conversions.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr std::array kVerdictNames{"cannot tell", "alike", "load", "damper", "spring"};

CornerComparison toMsg(const CornerComparisonReport& report, Stamp stamp) {
  CornerComparison msg;
  msg.header.stamp = toRosTime(stamp);
  msg.level = static_cast<CornerComparison::_level_type>(report.level);
  msg.sentence = describe(report);
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    msg.corners[i] = kCornerNames[i];
    msg.verdicts[i] = static_cast<std::uint8_t>(report.verdicts[i]);
    msg.damping_deviation[i] = report.damping_deviation[i].value_or(kUnknown);
    msg.stiffness_deviation[i] = report.stiffness_deviation[i].value_or(kUnknown);
  }
  return msg;
}

}  // namespace

std::optional<CornerOutput> CornerOutput::of(ros::NodeHandle& node, const std::vector<std::string>& struts) {
  Places places{};
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    const auto corner = std::find(struts.begin(), struts.end(), kCornerNames[i]);
    if (corner == struts.end()) return std::nullopt;
    places[i] = static_cast<std::size_t>(corner - struts.begin());
  }
  return CornerOutput(node, places);
}

CornerOutput::CornerOutput(ros::NodeHandle& node, const Places& places)
    : places_(places), publisher_(node.advertise<CornerComparison>("corners/comparison", 1, true)) {}

// The estimates stay valid when the sensors fall silent, so a judgement without a new sample counts none of them.
CornerComparisonReport CornerOutput::judge(const MessagePipeline* pipeline) {
  std::array<CornerState, kNumCorners> corners;
  if (pipeline == nullptr || pipeline->newest() == newest_) return compareCorners(corners);
  newest_ = pipeline->newest();
  for (std::size_t i = 0; i < kNumCorners; ++i)
    if (const SuspensionMonitor* monitor = pipeline->strut(places_[i]))
      corners[i] = {monitor->report().estimate, monitor->baseline()};
  return compareCorners(corners);
}

void CornerOutput::publish(const MessagePipeline* pipeline) {
  const CornerComparisonReport now = judge(pipeline);
  if (now.level == last_.level && now.verdicts == last_.verdicts) confirmed_ = now;
  last_ = now;
  publisher_.publish(boost::make_shared<const CornerComparison>(toMsg(confirmed_, newest_)));
}

void CornerOutput::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.summary(static_cast<unsigned char>(confirmed_.level), suspension_health_monitor::describe(confirmed_));
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    const std::string name(kCornerNames[i]);
    const auto add = [&](const char* part, const std::optional<double>& deviation) {
      if (deviation) status.addf(name + part + " from the others [%]", "%+.1f", 100.0 * *deviation);
    };
    status.add(name, kVerdictNames[static_cast<std::size_t>(confirmed_.verdicts[i])]);
    add(" damping", confirmed_.damping_deviation[i]);
    add(" stiffness", confirmed_.stiffness_deviation[i]);
  }
}

}  // namespace suspension_health_monitor
