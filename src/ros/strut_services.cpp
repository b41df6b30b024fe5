#include "strut_services.h"

#include <stdexcept>
#include <utility>

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

}  // namespace

StrutServices::StrutServices(ros::NodeHandle& node, const ShellOptions& options, LiveModel& model,
                             LiveBaseline& baseline, Strut strut)
    : options_(options), model_(model), baseline_(baseline), strut_(std::move(strut)) {
  services_ = {node.advertiseService("set_effects", &StrutServices::onSetEffects, this),
               node.advertiseService("save_model", &StrutServices::onSaveModel, this),
               node.advertiseService("save_baseline", &StrutServices::onSaveBaseline, this),
               node.advertiseService("reset", &StrutServices::onReset, this)};
}

StrutServices::~StrutServices() {  // nothing may call back into members that are already gone
  for (ros::ServiceServer& service : services_) service.shutdown();
}

bool StrutServices::onSetEffects(SetEffectsRequest& request, SetEffectsResponse& response) {
  try {
    std::vector<ActiveEffect> effects =
        model_.choose(request.names, shapesOf(request), [this] { return motionScaleNow(); });
    strut_.set_effects(effects, model_.strutFor(effects));
    model_.setEffects(std::move(effects));
    response.success = true;
    response.message = "the model is now " + model_.describe();
    strut_.model_changed();
  } catch (const std::invalid_argument& error) {
    response.message = error.what();
  }
  return true;
}

std::optional<MotionScale> StrutServices::motionScaleNow() const {
  const SuspensionMonitor* monitor = strut_.monitor();
  if (monitor == nullptr) return std::nullopt;
  const StrutEstimate& estimate = monitor->modelEstimate();
  return motionScale(strut_.newest_samples(), monitor->period(), estimate.damping_to_mass, estimate.stiffness_to_mass);
}

bool StrutServices::onSaveModel(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  const SuspensionMonitor* monitor = strut_.monitor();
  try {
    if (monitor == nullptr || !monitor->modelEstimate().valid()) throw std::runtime_error(kNothingToSave);
    const StrutEstimate& estimate = monitor->modelEstimate();
    model_.save({estimate.damping_to_mass, estimate.stiffness_to_mass, monitor->effects(), {}});
    response.success = true;
    response.message = options_.model_file + ": " + model_.describe();
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

bool StrutServices::onSaveBaseline(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  try {
    baseline_.save(strut_.monitor());
    strut_.set_baseline(*baseline_.known());
    response.success = true;
    response.message = "health is judged by the strut as it is now; written to " + options_.baseline_file;
  } catch (const std::runtime_error& error) {
    response.message = error.what();
  }
  return true;
}

bool StrutServices::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.success = true;
  response.message = strut_.reset();
  return true;
}

}  // namespace suspension_health_monitor
