#include "live_curves.h"

#include <suspension_health_monitor/StrutCurve.h>

#include <algorithm>
#include <boost/make_shared.hpp>

#include "conversions.h"
#include "live_model.h"
#include "live_search.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLook = 1.0;                       // [s] between two looks whether a fit is due
constexpr Stamp kAgain = std::chrono::seconds(10);  // of drive, after a fit without a curve
constexpr double kMostSamples = 20000.0;            // of a fit: its time and memory do not grow with the rate

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

LiveCurves::LiveCurves(MonitorHost& host, const std::vector<ros::NodeHandle>& struts, double diagnose_window)
    : host_(host), thread_(host.thread()), diagnose_window_(diagnose_window), spinner_(1, &queue_) {
  for (ros::NodeHandle node : struts)
    topics_.push_back(
        {node.advertise<StrutCurve>("damper_curve", 1, true), node.advertise<StrutCurve>("spring_curve", 1, true)});
  ros::NodeHandle node(struts.front());
  node.setCallbackQueue(&queue_);
  timer_ = node.createWallTimer(ros::WallDuration(kLook), [this](const ros::WallTimerEvent&) { updateIfDue(); });
  spinner_.start();
}

void LiveCurves::updateIfDue() {
  if (std::none_of(topics_.begin(), topics_.end(), [](const Topics& strut) { return strut.isHeard(); })) return;
  beNice();
  try {
    const std::optional<Task> task = thread_.run([this] { return taskIfDue(); });
    if (task) update(*task);
  } catch (const std::exception& error) {  // as ~diagnose would answer
    ROS_WARN("curves of damper and spring: %s", error.what());
  }
}

/// Called in the nodelet's thread.
/// @return nothing: no fit is due, or no strut is known.
std::optional<LiveCurves::Task> LiveCurves::taskIfDue() const {
  const MessagePipeline* pipeline = host_.pipeline();
  if (pipeline == nullptr || pipeline->strut() == nullptr) return std::nullopt;
  Task task;
  bool is_known = false;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    task.models.push_back(modelOf(pipeline->strut(i)));
    is_known = is_known || task.models.back();
    task.frames.push_back(host_.frameOf(i));
  }
  const Stamp newest = pipeline->strut()->report().stamp;
  if (!is_known || (newest >= last_ && newest - last_ < kEvery)) return std::nullopt;
  task.search = host_.samplesFor(std::min(diagnose_window_, kMostSamples * *pipeline->period()));
  return task;
}

void LiveCurves::update(const Task& task) {
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
