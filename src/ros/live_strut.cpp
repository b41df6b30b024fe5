#include "live_strut.h"

#include <ros/console.h>

#include <stdexcept>

#include "suspension_health_monitor/internal/record/motion_scale.h"

namespace suspension_health_monitor {
namespace {

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

LiveStrut::LiveStrut(StrutHost& host, std::size_t place, const VehicleOptions& options, const std::string& title)
    : host_(host),
      place_(place),
      name_(options.layout.struts[place].name),
      prefix_(name_.empty() ? "" : name_ + ": "),
      options_(options.struts[place]),
      model_(options_.shell, options.model_of[place]),
      baseline_(options_),
      diagnostics_(title, options_.shell.input_timeout, model_, [this] { return host_.silentTopics(); }) {}

LiveStrut::~LiveStrut() {  // nothing may call back into members that are already gone
  diagnose_.reset();
  for (ros::ServiceServer& service : services_) service.shutdown();
}

ros::NodeHandle LiveStrut::start(const ros::NodeHandle& node, const ros::NodeHandle& private_node) {
  for (const std::string& remark : model_.remarks()) ROS_WARN("%s%s", prefix_.c_str(), remark.c_str());
  ros::NodeHandle own = name_.empty() ? private_node : ros::NodeHandle(node, name_);
  reports_.emplace(own, options_);
  publishModel();
  updater_.emplace(node, private_node, own.getNamespace());
  updater_->setHardwareID(own.getNamespace().substr(1));
  updater_->add("Input", [this](auto& status) { host_.describeInput(place_, status); });
  diagnostics_.addTo(
      *updater_, [this] { return monitor(); }, [this] { return host_.whyNoMonitor(); });
  const auto serve = [&](const char* name, const auto& work) {
    return own.advertiseService<Trigger::Request, Trigger::Response>(
        name, [work](Trigger::Request&, Trigger::Response& response) { return answer(response, work); });
  };
  services_ = {own.advertiseService("set_effects", &LiveStrut::onSetEffects, this),
               serve("save_model", [this] { return saveModel(); }),
               serve("save_baseline", [this] { return saveBaseline(); }),
               serve("reset", [this] { return host_.reset(); })};
  diagnose_.emplace(own, host_.thread(), [this](double window) { return host_.searchFor(place_, window); });
  return own;
}

const SuspensionMonitor* LiveStrut::monitor() const {
  return host_.pipeline() != nullptr ? host_.pipeline()->strut(place_) : nullptr;
}

void LiveStrut::begin(MessagePipeline& pipeline) const {
  pipeline.setEffects(model_.effects(), model_.strutFor(model_.effects()), place_);
  if (baseline_.known()) pipeline.setBaseline(*baseline_.known(), place_);
}

void LiveStrut::publishModel() {
  reports_->changeModel(monitor() != nullptr ? monitor()->effects() : model_.effects(), monitor(),
                        host_.frameOf(place_));
}

void LiveStrut::publish(const MonitorReport& report) {
  if (diagnostics_.note(report)) publishDiagnostics();
  if (report.health.learned && !baseline_.known()) keepBaseline();
  reports_->publish(report, *monitor(), host_.frameOf(place_));
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
