#include "report_topics.h"

#include <suspension_health_monitor/ModelInUse.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <utility>

#include "conversions.h"
#include "live_model.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

template <class Make>
void send(ros::Publisher& publisher, const Make& make) {
  if (publisher.getNumSubscribers() == 0) return;
  auto msg = make();
  publisher.publish(boost::make_shared<const decltype(msg)>(std::move(msg)));
}

}  // namespace

ReportTopics::ReportTopics(ros::NodeHandle& private_node, const PipelineOptions& options)
    : sprung_mass_(options.monitor.sprung_mass),
      estimate_(private_node.advertise<ParameterEstimate>("estimate", kQueueSize)),
      ls_(private_node.advertise<ParameterEstimate>("ls", kQueueSize)),
      la_(private_node.advertise<ParameterEstimate>("la", kQueueSize)),
      comparison_(private_node.advertise<ModelComparison>("comparison", kQueueSize)),
      health_(private_node.advertise<SuspensionHealth>("health", kQueueSize)),
      model_(private_node.advertise<ModelInUse>("model", 1, true)) {
  setStride(options.shell.publish_every);
}

void ReportTopics::publish(const MonitorReport& report, const SuspensionMonitor& monitor, const std::string& frame) {
  if (!model_has_estimate_ && monitor.modelEstimate().valid()) changeModel(monitor.effects(), &monitor, frame);
  if (reports_++ % stride_ != 0) return;
  std_msgs::Header header;
  header.stamp = toRosTime(report.stamp);
  header.frame_id = frame;
  const std::vector<ActiveEffect>& effects = monitor.effects();
  send(estimate_, [&] { return toMsg(report.estimate, "estimate", header, effects, sprung_mass_); });
  send(ls_, [&] { return toMsg(report.ls, "ls", header, effects, sprung_mass_); });
  send(la_, [&] { return toMsg(report.la, "la", header, effects, sprung_mass_); });
  if (report.comparison.has_sample) send(comparison_, [&] { return toMsg(report.comparison, frame); });
  send(health_, [&] { return toMsg(report, monitor.baseline(), header); });
}

void ReportTopics::changeModel(const std::vector<ActiveEffect>& effects, const SuspensionMonitor* monitor,
                               const std::string& frame) {
  const std::optional<StrutModel> now = modelOf(monitor);
  model_has_estimate_ = now.has_value();
  auto message = boost::make_shared<ModelInUse>();
  message->header.frame_id = frame;
  if (monitor != nullptr) message->header.stamp = toRosTime(monitor->report().stamp);
  message->damping_to_mass = message->stiffness_to_mass = std::nan("");
  for (const ActiveEffect& active : effects) {
    message->effect_names.push_back(active.effect.name);
    message->effect_coefficients.push_back(active.coefficient);
    for (std::size_t i = 0; i < active.shapes.size(); ++i) {
      message->shape_names.push_back(active.effect.name + '/' + active.effect.shapes[i].name);
      message->shapes.push_back(active.shapes[i]);
    }
  }
  if (now) {
    message->damping_to_mass = now->damping_to_mass;
    message->stiffness_to_mass = now->stiffness_to_mass;
    message->yaml = toYaml(*now);
  }
  model_.publish(message);
}

}  // namespace suspension_health_monitor
