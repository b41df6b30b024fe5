#include "live_strut.h"

#include <ros/console.h>
#include <suspension_health_monitor/ModelInUse.h>

#include <boost/make_shared.hpp>
#include <stdexcept>
#include <utility>

#include "conversions.h"
#include "input_task.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/record/motion.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr std::uint32_t kMostWaitingReports = 100000;  // messages

template <class Make>
void send(ros::Publisher& publisher, const Make& make) {
  if (publisher.getNumSubscribers() == 0) return;
  auto msg = make();
  publisher.publish(boost::make_shared<const decltype(msg)>(std::move(msg)));
}

LiveModel::Shapes shapesOf(const SetEffectsRequest& request) {
  if (request.shape_names.size() != request.shape_values.size())
    throw std::invalid_argument(std::to_string(request.shape_values.size()) + " shape_values, must be as many as " +
                                "shape_names: " + std::to_string(request.shape_names.size()));
  LiveModel::Shapes shapes;
  for (std::size_t i = 0; i < request.shape_names.size(); ++i) shapes[request.shape_names[i]] = request.shape_values[i];
  return shapes;
}

/// Answers a service: with what work() tells, or with the words of what it throws.
template <class Response, class Work>
bool answer(Response& response, const Work& work) {
  try {
    response.message = work();
    response.success = true;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

}  // namespace

LiveStrut::LiveStrut(MonitorHost& host, std::size_t place, const VehicleOptions& options, const std::string& node_name)
    : host_(host),
      place_(place),
      name_(options.layout.struts[place].name),
      prefix_(name_.empty() ? "" : name_ + ": "),
      options_(options.struts[place]),
      model_(options_.shell, options.model_of[place]),
      baseline_(options_),
      health_log_(name_.empty() ? node_name : name_),
      drive_(name_.empty() ? node_name : name_, options_.shell.input_timeout) {
  setStride(options_.shell.publish_every);
}

ros::NodeHandle LiveStrut::start(const ros::NodeHandle& node, const ros::NodeHandle& private_node) {
  for (const std::string& remark : model_.remarks()) ROS_WARN("%s%s", prefix_.c_str(), remark.c_str());
  ros::NodeHandle own = name_.empty() ? private_node : ros::NodeHandle(node, name_);
  estimate_ = own.advertise<ParameterEstimate>("estimate", kMostWaitingReports);
  ls_ = own.advertise<ParameterEstimate>("ls", kMostWaitingReports);
  la_ = own.advertise<ParameterEstimate>("la", kMostWaitingReports);
  comparison_ = own.advertise<ModelComparison>("comparison", kMostWaitingReports);
  health_ = own.advertise<SuspensionHealth>("health", kMostWaitingReports);
  model_topic_ = own.advertise<ModelInUse>("model", 1, true);
  publishModel();
  updater_.emplace(node, private_node, own.getNamespace());
  updater_->setHardwareID(own.getNamespace().substr(1));
  addTasks();
  const auto serve = [&](const char* name, const auto& work) {
    return own.advertiseService<Trigger::Request, Trigger::Response>(
        name, [work](Trigger::Request&, Trigger::Response& response) { return answer(response, work); });
  };
  services_ = {own.advertiseService("set_effects", &LiveStrut::onSetEffects, this),
               serve("save_model", [this] { return saveModel(); }),
               serve("save_baseline", [this] { return saveBaseline(); }),
               serve("reset", [this] { return host_.reset(); })};
  diagnose_.emplace(own, host_, place_);
  return own;
}

void LiveStrut::addTasks() {
  const auto addOfMonitor = [this](const char* task, const auto& describe) {
    updater_->add(task, [this, describe](Status& status) {
      if (monitor() != nullptr) return describe(status);
      status.summary(Status::STALE, join({host_.whyNoMonitor(), describeSilent(host_.input().silentTopics())}, "; "));
    });
  };
  updater_->add("Input", [this](Status& status) { host_.input().describeStrut(place_, status); });
  addOfMonitor("Health", [this](Status& status) {
    describeHealth(*monitor(), status);
    describeSilence(status);
    health_log_.note(status);
    drive_.watchClock();
  });
  addOfMonitor("Model", [this](Status& status) { describeModel(model_, *monitor(), status); });
}

// A level describes the newest readings; once they are old, nobody knows it any more. Age is measured by the clock that
// stamps the data, so that a simulation that is paused makes nothing old.
void LiveStrut::describeSilence(Status& status) {
  const ros::Time now = ros::Time::now();
  const std::uint64_t samples = monitor()->input().samples;
  if (!accepted_ || samples != accepted_->samples || now < accepted_->at) accepted_ = {samples, now};
  const double silent = (now - accepted_->at).toSec();
  if (silent <= options_.shell.input_timeout) return;
  status.summary(Status::STALE, describeNoReading(silent, host_.input().silentTopics(), status.message));
}

void LiveStrut::begin(MessagePipeline& pipeline) const {
  pipeline.setEffects(model_.effects(), model_.strutFor(model_.effects()), place_);
  if (baseline_.known()) pipeline.setBaseline(*baseline_.known(), place_);
}

void LiveStrut::publishModel() {
  const SuspensionMonitor* const its = monitor();
  const std::optional<StrutModel> now = modelOf(its);
  model_has_estimate_ = now.has_value();
  auto message = boost::make_shared<ModelInUse>();
  message->header.frame_id = host_.frameOf(place_);
  if (its != nullptr) message->header.stamp = toRosTime(its->report().stamp);
  message->damping_to_mass = now ? now->damping_to_mass : kUnknown;
  message->stiffness_to_mass = now ? now->stiffness_to_mass : kUnknown;
  if (now) message->yaml = toYaml(*now);
  for (const ActiveEffect& active : its != nullptr ? its->effects() : model_.effects()) {
    message->effect_names.push_back(active.effect.name);
    message->effect_coefficients.push_back(active.coefficient);
    for (std::size_t i = 0; i < active.shapes.size(); ++i) {
      message->shape_names.push_back(active.effect.name + '/' + active.effect.shapes[i].name);
      message->shapes.push_back(active.shapes[i]);
    }
  }
  model_topic_.publish(message);
}

void LiveStrut::publish(const MonitorReport& report) {
  drive_.add(report);
  if (std::exchange(level_, report.health.level) != report.health.level) publishDiagnostics();
  if (report.health.learned && !baseline_.known()) keepBaseline();
  if (!model_has_estimate_ && monitor()->modelEstimate().valid()) publishModel();
  if (reports_++ % stride_ != 0) return;
  std_msgs::Header header;
  header.stamp = toRosTime(report.stamp);
  header.frame_id = host_.frameOf(place_);
  const auto send_estimate = [&](ros::Publisher& publisher, const StrutEstimate& estimate, const char* estimator) {
    const auto& mass = options_.monitor.sprung_mass;
    send(publisher, [&] { return toMsg(estimate, estimator, header, monitor()->effects(), mass); });
  };
  send_estimate(estimate_, report.estimate, "estimate");
  send_estimate(ls_, report.ls, "ls");
  send_estimate(la_, report.la, "la");
  if (report.comparison.has_sample) send(comparison_, [&] { return toMsg(report.comparison, header.frame_id); });
  send(health_, [&] { return toMsg(report, monitor()->baseline(), header); });
}

void LiveStrut::keepBaseline() {
  try {
    ROS_INFO("%s%s", prefix_.c_str(), baseline_.keepLearned(*monitor()).c_str());
  } catch (const std::runtime_error& error) {
    ROS_ERROR("%s%s", prefix_.c_str(), error.what());
  }
}

bool LiveStrut::onSetEffects(SetEffectsRequest& request, SetEffectsResponse& response) {
  return answer(response, [&] {
    std::vector<ActiveEffect> effects =
        model_.choose(request.names, shapesOf(request), [this] { return motionScaleNow(); });
    if (host_.pipeline() != nullptr) host_.pipeline()->setEffects(effects, model_.strutFor(effects), place_);
    model_.setEffects(std::move(effects));
    publishModel();
    publishDiagnostics();
    return "the model is now " + model_.describe();
  });
}

std::optional<MotionScale> LiveStrut::motionScaleNow() const {
  if (monitor() == nullptr) return std::nullopt;
  const StrutEstimate& estimate = monitor()->modelEstimate();
  const VehicleDrive newest = host_.pipeline()->newestSamples(options_.shell.diagnose_window);
  return motionScale(newest.struts[place_].samples, monitor()->period(), estimate.damping_to_mass,
                     estimate.stiffness_to_mass);
}

std::string LiveStrut::saveModel() const {
  const std::optional<StrutModel> now = modelOf(monitor());
  if (!now) throw std::runtime_error(kNothingToSave);
  model_.save(*now);
  return options_.shell.model_file + ": " + model_.describe();
}

std::string LiveStrut::saveBaseline() {
  baseline_.save(monitor());
  host_.pipeline()->setBaseline(*baseline_.known(), place_);
  return "health is judged by the strut as it is now; written to " + options_.shell.baseline_file;
}

}  // namespace suspension_health_monitor
