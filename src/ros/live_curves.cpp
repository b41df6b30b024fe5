#include "live_curves.h"

#include <suspension_health_monitor/StrutCurve.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "conversions.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLook = 1.0;                       // [s] between two looks whether a fit is due
constexpr Stamp kAgain = std::chrono::seconds(10);  // of drive, after a fit without a curve

/// @param header  with the stamp of the newest sample.
/// @return whether there is something to tell.
bool publish(ros::Publisher& publisher, const char* variable, const ForceCurve& curve, const std_msgs::Header& header) {
  if (curve.at.empty()) return false;
  const auto message = boost::make_shared<StrutCurve>();
  message->header = header;
  message->variable = variable;
  message->at = curve.at;
  message->force = curve.force;
  message->stddev = curve.stddev;
  publisher.publish(message);
  return true;
}

}  // namespace

LiveCurves::LiveCurves(const std::vector<ros::NodeHandle>& struts, MonitorThread& nodelet_thread, Prepare prepare)
    : nodelet_thread_(nodelet_thread), prepare_(std::move(prepare)), spinner_(1, &queue_) {
  for (ros::NodeHandle node : struts)
    topics_.push_back(
        {node.advertise<StrutCurve>("damper_curve", 1, true), node.advertise<StrutCurve>("spring_curve", 1, true)});
  ros::NodeHandle node(struts.front());
  node.setCallbackQueue(&queue_);
  timer_ = node.createWallTimer(ros::WallDuration(kLook), [this](const ros::WallTimerEvent&) { updateIfDue(); });
  spinner_.start();
}

LiveCurves::~LiveCurves() {
  timer_.stop();  // waits for a fit that runs
  spinner_.stop();
}

void LiveCurves::updateIfDue() {
  if (std::none_of(topics_.begin(), topics_.end(), [](const Topics& strut) { return strut.isHeard(); })) return;
  beNice();
  try {
    const std::optional<CurveTask> task = nodelet_thread_.run([this] { return prepare_(last_); });
    if (task) update(*task);
  } catch (const std::exception& error) {  // as ~diagnose would answer
    ROS_WARN("curves of damper and spring: %s", error.what());
  }
}

void LiveCurves::update(const CurveTask& task) {
  const auto& [drive, names, options] = task.search;
  const Stamp newest = drive.struts.front().samples.back().stamp;
  last_ = newest - kEvery + kAgain;
  const SeparatedVehicle own = separateVehicle({drive}, names, options.sample_period, task.models);
  std_msgs::Header header;
  header.stamp = toRosTime(newest);
  for (std::size_t i = 0; i < own.struts.size(); ++i) {
    if (!topics_[i].isHeard() || !task.models[i]) continue;
    const StrutCurves curves =
        strutCurves(own.struts[i], *task.models[i], options.sample_period, own.coupling.modelErrorOf(i));
    header.frame_id = task.frames[i];
    const bool has_damper = publish(topics_[i].damper, "velocity", curves.damper.absolute(), header);
    const bool has_spring = publish(topics_[i].spring, "travel", curves.spring.absolute(), header);
    if (has_damper || has_spring) last_ = newest;
  }
}

}  // namespace suspension_health_monitor
