#include "corners_nodelet.h"

#include <suspension_health_monitor/CornerComparison.h>

#include <algorithm>
#include <cmath>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "conversions.h"
#include "parameters.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

const ros::WallDuration kTick(0.1);
const ros::WallDuration kPublishing(1.0);
constexpr std::array<const char*, 5> kVerdictNames{"cannot tell", "alike", "load", "damper", "spring"};

std::optional<double> known(double value) { return std::isfinite(value) ? std::optional<double>(value) : std::nullopt; }

bool sameVerdict(const CornerComparisonReport& a, const CornerComparisonReport& b) {
  return a.level == b.level && a.verdicts == b.verdicts;
}

}  // namespace

CornersNodelet::~CornersNodelet() {
  // Nothing may call back into members that are already gone.
  tick_.stop();
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
}

void CornersNodelet::onInit() {
  node_ = thread_->serve(getNodeHandle());
  private_node_ = thread_->serve(getPrivateNodeHandle());
  startOrRefuse(private_node_, [&] { options_ = CornersOptions::fromValues(readParameters(private_node_)); });
  thread_->run([this] {  // there, so that no callback comes before all is set up
    comparison_ = private_node_.advertise<CornerComparison>("comparison", 10, true);
    updater_.emplace(node_, private_node_, getName());
    updater_->setHardwareID(getName().substr(getName().find_first_not_of('/')));
    updater_->add("Corners", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { describe(status); });
    subscribe();
    tick_ = node_.createWallTimer(kTick, [this](const ros::WallTimerEvent&) { onTick(); });
  });
}

void CornersNodelet::subscribe() {
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    const std::string name(kCornerNames[i]);
    subscribers_.push_back(
        node_.subscribe<ParameterEstimate>(name + "/estimate", 1, [this, i](const ParameterEstimateConstPtr& estimate) {
          corners_[i].estimate = estimate;
          corners_[i].last = ros::WallTime::now();
        }));
    subscribers_.push_back(node_.subscribe<SuspensionHealth>(
        name + "/health", 1, [this, i](const SuspensionHealthConstPtr& health) { corners_[i].health = health; }));
  }
}

void CornersNodelet::onTick() {
  const ros::WallTime time = ros::WallTime::now();
  const bool changed = confirm(compareCorners(states(), {options_.threshold}), time);
  if (!changed && time - published_ < kPublishing) return;
  published_ = time;
  publishComparison();
  updater_->force_update();
}

// @return true if the verdict that is reported has changed.
bool CornersNodelet::confirm(const CornerComparisonReport& now, ros::WallTime time) {
  if (sameVerdict(now, report_)) {
    report_ = pending_.verdict = now;  // the figures of today
    return false;
  }
  if (!sameVerdict(now, pending_.verdict)) pending_.since = time;
  pending_.verdict = now;
  if ((time - pending_.since).toSec() < options_.confirm_time) return false;
  report_ = now;
  return true;
}

std::array<CornerState, kNumCorners> CornersNodelet::states() const {
  std::array<CornerState, kNumCorners> states;
  const ros::WallTime now = ros::WallTime::now();
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    const Corner& corner = corners_[i];
    if (!corner.estimate || (now - corner.last).toSec() > options_.timeout) continue;
    CornerState& state = states[i];
    state.valid = corner.estimate->valid;
    state.damping_to_mass = corner.estimate->damping_to_mass;
    state.stiffness_to_mass = corner.estimate->stiffness_to_mass;
    state.damping_to_mass_stddev = corner.estimate->damping_to_mass_stddev;
    state.stiffness_to_mass_stddev = corner.estimate->stiffness_to_mass_stddev;
    if (!corner.health) continue;
    state.nominal_damping_to_mass = known(corner.health->nominal_damping_to_mass);
    state.nominal_stiffness_to_mass = known(corner.health->nominal_stiffness_to_mass);
  }
  return states;
}

void CornersNodelet::publishComparison() {
  const auto msg = boost::make_shared<CornerComparison>();
  for (const Corner& corner : corners_)
    if (corner.estimate) msg->header.stamp = std::max(msg->header.stamp, corner.estimate->header.stamp);
  msg->level = static_cast<CornerComparison::_level_type>(report_.level);
  msg->sentence = suspension_health_monitor::describe(report_);
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    msg->corners[i] = std::string(kCornerNames[i]);
    msg->verdicts[i] = static_cast<std::uint8_t>(report_.verdicts[i]);
    msg->damping_deviation[i] = report_.damping_deviation[i].value_or(kUnknown);
    msg->stiffness_deviation[i] = report_.stiffness_deviation[i].value_or(kUnknown);
  }
  comparison_.publish(boost::shared_ptr<const CornerComparison>(msg));
}

void CornersNodelet::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.summary(static_cast<unsigned char>(report_.level), suspension_health_monitor::describe(report_));
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    const std::string name(kCornerNames[i]);
    status.add(name, kVerdictNames[static_cast<std::size_t>(report_.verdicts[i])]);
    if (report_.damping_deviation[i])
      status.addf(name + " damping from the others [%]", "%+.1f", 100.0 * *report_.damping_deviation[i]);
    if (report_.stiffness_deviation[i])
      status.addf(name + " stiffness from the others [%]", "%+.1f", 100.0 * *report_.stiffness_deviation[i]);
  }
}

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::CornersNodelet, nodelet::Nodelet)
