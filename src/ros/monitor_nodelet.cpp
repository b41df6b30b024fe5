#include "monitor_nodelet.h"

#include <cmath>
#include <pluginlib/class_list_macros.hpp>

#include "parameters.h"
#include "suspension_health_monitor/internal/plain_text.h"

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

MonitorNodelet::~MonitorNodelet() {
  // Nothing may call back into members that are already gone.
  diagnose_.reset();
  reconfigure_.reset();
  tick_.stop();
  imus_.reset();
  for (ros::ServiceServer& service : services_) service.shutdown();
}

void MonitorNodelet::onInit() {
  ros::NodeHandle node = thread_->serve(getNodeHandle()), private_node = thread_->serve(getPrivateNodeHandle());
  startOrRefuse(private_node, [&] {
    options_ = PipelineOptions::fromValues(readParameters(private_node));
    model_.emplace(options_.shell);
    baseline_.emplace(options_);
    imus_.emplace(node, options_, [this](Side side, const sensor_msgs::Imu& imu) { onImu(side, imu); });
    makePipeline();
  });
  for (const std::string& remark : model_->remarks()) NODELET_WARN("%s", remark.c_str());
  thread_->run([&] { start(node, private_node); });  // there, so that no callback comes before all is set up
}

void MonitorNodelet::start(ros::NodeHandle node, ros::NodeHandle private_node) {
  reports_.emplace(private_node, options_);
  publishModel();
  imus_->listen();
  diagnostics_.emplace(node, private_node, getName(), options_, imus_->strut(), *model_);
  advertiseServices(private_node);
  tick_ = node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { onTick(); });
}

void MonitorNodelet::makePipeline() {
  pipeline_.emplace(
      options_, [this](const MonitorReport& report) { publish(report); }, &imus_->transforms());
  pipeline_->strut().setEffects(model_->effects(), model_->strutFor(model_->effects()));
  if (baseline_->known()) pipeline_->strut().setBaseline(*baseline_->known());
}

void MonitorNodelet::advertiseServices(ros::NodeHandle& private_node) {
  services_ = {private_node.advertiseService("reset", &MonitorNodelet::onReset, this),
               private_node.advertiseService("set_effects", &MonitorNodelet::onSetEffects, this),
               private_node.advertiseService("save_model", &MonitorNodelet::onSaveModel, this),
               private_node.advertiseService("save_baseline", &MonitorNodelet::onSaveBaseline, this)};
  diagnose_.emplace(private_node, thread_->queue(),
                    DiagnoseService::Nodelet{[this](double window) { return giveSamples(window); },
                                             [this](const Diagnosis& diagnosis) { takeDiagnosis(diagnosis); }});
  reconfigure_.emplace(private_node);  // writes down the parameters as they were given, and defaults
  reconfigure_->setCallback([this](LiveSettings& settings, std::uint32_t) { onReconfigure(settings); });
}

void MonitorNodelet::onReconfigure(LiveSettings& settings) {
  try {
    const PipelineOptions changed = settings.appliedTo(options_);
    pipeline_->strut().reconfigure(changed.monitor);
    options_ = changed;
    reports_->setStride(options_.shell.publish_every);
  } catch (const std::invalid_argument& error) {
    NODELET_WARN("%s; all settings stay as they were", error.what());
  }
  settings = LiveSettings(options_);
}

void MonitorNodelet::publishModel() {
  const SuspensionMonitor* monitor = pipeline_->monitor();
  reports_->model().change(monitor != nullptr ? monitor->effects() : model_->effects(), monitor, imus_->bodyFrame());
}

void MonitorNodelet::stopListening(const std::string& reason) {
  NODELET_ERROR("stopped listening until reset: %s", reason.c_str());
  diagnostics_->input().setRefusal(reason);
  imus_->stop();
}

void MonitorNodelet::onImu(Side side, const sensor_msgs::Imu& imu) {
  if (side != Side::kRoad) diagnostics_->input().noteMessage(side, imu.header.stamp);
  try {
    pipeline_->push(side, imu);
  } catch (const std::invalid_argument& error) {  // the options do not fit the sample period that was measured
    stopListening(error.what());
  }
}

void MonitorNodelet::publish(const MonitorReport& report) {
  if (diagnostics_->noteLevel(report.health.level)) onTick();
  if (report.health.learned && !baseline_->known()) keepBaseline();
  reports_->publish(report, pipeline_->strut(), imus_->bodyFrame());
}

void MonitorNodelet::onTick() { diagnostics_->publish(*pipeline_); }

bool MonitorNodelet::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  makePipeline();
  publishModel();
  diagnostics_->input().restart();
  imus_->listen();
  response.success = true;
  response.message = "estimates, filters and counters start anew";
  return true;
}

bool MonitorNodelet::onSetEffects(SetEffectsRequest& request, SetEffectsResponse& response) {
  try {
    std::vector<ActiveEffect> effects =
        model_->choose(request.names, shapesOf(request), [this] { return motionScaleNow(); });
    pipeline_->strut().setEffects(effects, model_->strutFor(effects));
    model_->setEffects(std::move(effects));
    publishModel();
    response.success = true;
    response.message = "the model is now " + model_->describe();
    onTick();
  } catch (const std::invalid_argument& error) {
    response.message = error.what();
  }
  return true;
}

std::optional<MotionScale> MonitorNodelet::motionScaleNow() const {
  const SuspensionMonitor* monitor = pipeline_->monitor();
  if (monitor == nullptr) return std::nullopt;
  const StrutEstimate& la = monitor->report().la;
  return motionScale(pipeline_->newestSamples(options_.shell.diagnose_window), monitor->period(), la.damping_to_mass,
                     la.stiffness_to_mass);
}

bool MonitorNodelet::onSaveModel(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  const SuspensionMonitor* monitor = pipeline_->monitor();
  try {
    if (monitor == nullptr || !monitor->report().la.valid())
      throw std::runtime_error("nothing to save: the monitor has no valid estimate");
    const StrutEstimate& la = monitor->report().la;
    model_->save({la.damping_to_mass, la.stiffness_to_mass, monitor->effects(), {}});
    response.success = true;
    response.message = options_.shell.model_file + ": " + model_->describe();
  } catch (const std::runtime_error& error) {
    response.message = error.what();
  }
  return true;
}

bool MonitorNodelet::onSaveBaseline(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  try {
    baseline_->save(pipeline_->monitor());
    pipeline_->strut().setBaseline(*baseline_->known());
    response.success = true;
    response.message = "health is judged by the strut as it is now; written to " + options_.shell.baseline_file;
  } catch (const std::runtime_error& error) {
    response.message = error.what();
  }
  return true;
}

void MonitorNodelet::keepBaseline() {
  try {
    NODELET_INFO("%s", baseline_->keepLearned(*pipeline_->monitor()).c_str());
  } catch (const std::runtime_error& error) {
    NODELET_ERROR("%s", error.what());
  }
}

SearchTask MonitorNodelet::giveSamples(double window) const {
  const double kept = options_.shell.diagnose_window;
  if (!(window >= 0.0 && window <= kept))
    throw std::invalid_argument("window = " + numberText(window) + " [s], must be in [0, " + numberText(kept) +
                                "] (diagnose/window)");
  const SuspensionMonitor* monitor = pipeline_->monitor();
  if (monitor == nullptr) throw std::runtime_error("the sample period is still being measured: drive on");
  const double span = window > 0.0 ? window : kept;
  SearchTask task;
  task.drive = {pipeline_->newestSamples(span), pipeline_->newestBodyMotion(span)};
  task.options.sample_period = monitor->period();
  task.options.horizon_samples = monitor->horizonSamples();
  task.options.candidates = model_->library();
  const StrutEstimate& la = monitor->report().la;
  if (!model_->effects().empty() && la.valid())
    task.options.model = StrutModel{la.damping_to_mass, la.stiffness_to_mass, monitor->effects(), {}};
  return task;
}

void MonitorNodelet::takeDiagnosis(const Diagnosis& diagnosis) {
  model_->setDiagnosis(diagnosis);
  onTick();
}

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::MonitorNodelet, nodelet::Nodelet)
