#include "monitor_nodelet.h"

#include <cmath>
#include <pluginlib/class_list_macros.hpp>

#include "conversions.h"
#include "parameters.h"

namespace suspension_health_monitor {
namespace {

constexpr std::uint32_t kQueueSize = 100000;  // messages of either IMU that may wait: 100 s at 1 kHz, some 50 MB

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
  static_transforms_.shutdown();
  for (ros::Subscriber& subscriber : imu_) subscriber.shutdown();
  road_.shutdown();
  for (ros::ServiceServer& service : services_) service.shutdown();
}

void MonitorNodelet::onInit() {
  node_ = thread_->serve(getNodeHandle());
  private_node_ = thread_->serve(getPrivateNodeHandle());
  startOrRefuse(private_node_, [&] {
    options_ = PipelineOptions::fromValues(readParameters(private_node_));
    model_.emplace(options_.shell);
    baseline_.emplace(options_);
    makePipeline();
  });
  for (const std::string& remark : model_->remarks()) NODELET_WARN("%s", remark.c_str());
  thread_->run([this] { start(); });  // there, so that no callback comes before all is set up
}

void MonitorNodelet::start() {
  ls_ = private_node_.advertise<ParameterEstimate>("ls", kQueueSize);
  la_ = private_node_.advertise<ParameterEstimate>("la", kQueueSize);
  comparison_ = private_node_.advertise<ModelComparison>("comparison", kQueueSize);
  health_ = private_node_.advertise<SuspensionHealth>("health", kQueueSize);
  if (!options_.shell.target_frame.empty())
    static_transforms_ = node_.subscribe("/tf_static", kQueueSize, &MonitorNodelet::onTransforms, this);
  if (options_.monitor.tyre) tyre_.emplace(private_node_, kQueueSize);
  model_topic_.emplace(private_node_);
  publishModel();
  subscribe();
  diagnostics_.emplace(node_, private_node_, getName(), options_, imu_, *model_);
  advertiseServices();
  tick_ = node_.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { onTick(); });
}

void MonitorNodelet::makePipeline() {
  pipeline_.emplace(
      options_, [this](const MonitorReport& report) { publish(report); }, &transforms_);
  pipeline_->strut().setEffects(model_->effects());
  if (baseline_->known()) pipeline_->strut().setBaseline(*baseline_->known());
}

void MonitorNodelet::advertiseServices() {
  services_ = {private_node_.advertiseService("reset", &MonitorNodelet::onReset, this),
               private_node_.advertiseService("set_effects", &MonitorNodelet::onSetEffects, this),
               private_node_.advertiseService("save_model", &MonitorNodelet::onSaveModel, this),
               private_node_.advertiseService("save_baseline", &MonitorNodelet::onSaveBaseline, this)};
  diagnose_.emplace(private_node_, thread_->queue(),
                    DiagnoseService::Nodelet{[this](double window) { return giveSamples(window); },
                                             [this](const Diagnosis& diagnosis) { takeDiagnosis(diagnosis); }});
  reconfigure_.emplace(private_node_);  // writes down the parameters as they were given, and defaults
  reconfigure_->setCallback([this](LiveSettings& settings, std::uint32_t) { onReconfigure(settings); });
}

void MonitorNodelet::onReconfigure(LiveSettings& settings) {
  try {
    const PipelineOptions changed = settings.appliedTo(options_);
    pipeline_->strut().reconfigure(changed.monitor);
    options_ = changed;
  } catch (const std::invalid_argument& error) {
    NODELET_WARN("%s; all settings stay as they were", error.what());
  }
  settings = LiveSettings(options_);
}

void MonitorNodelet::publishModel() {
  const SuspensionMonitor* monitor = pipeline_->monitor();
  model_topic_->change(monitor != nullptr ? monitor->effects() : model_->effects(), monitor, frames_.front());
}

void MonitorNodelet::subscribe() {
  const auto listen = [&](Side side, const char* topic) {
    return node_.subscribe<sensor_msgs::Imu>(
        topic, kQueueSize, [this, side](const sensor_msgs::ImuConstPtr& imu) { onImu(side, imu); }, nullptr,
        ros::TransportHints().tcpNoDelay());
  };
  imu_ = {listen(Side::kSprung, "sprung/imu"), listen(Side::kUnsprung, "unsprung/imu")};
  if (options_.monitor.tyre) road_ = listen(Side::kRoad, "road/imu");
}

void MonitorNodelet::stopListening(const std::string& reason) {
  NODELET_ERROR("stopped listening until reset: %s", reason.c_str());
  diagnostics_->input().setRefusal(reason);
  for (ros::Subscriber& subscriber : imu_) subscriber.shutdown();
  road_.shutdown();
}

void MonitorNodelet::onTransforms(const tf2_msgs::TFMessageConstPtr& tree) {
  for (const geometry_msgs::TransformStamped& transform : tree->transforms)
    transforms_.setTransform(transform, "/tf_static", true);
}

void MonitorNodelet::onImu(Side side, const sensor_msgs::ImuConstPtr& imu) {
  frames_[static_cast<std::size_t>(side)] = imu->header.frame_id;
  if (side != Side::kRoad) diagnostics_->input().noteMessage(side, imu->header.stamp);
  try {
    pipeline_->push(side, *imu);
  } catch (const std::invalid_argument& error) {  // the options do not fit the sample period that was measured
    stopListening(error.what());
  }
}

void MonitorNodelet::publish(const MonitorReport& report) {
  if (diagnostics_->noteLevel(report.health.level)) onTick();
  model_topic_->note(*pipeline_->monitor(), frames_.front());
  if (report.health.learned && !baseline_->known()) keepBaseline();
  if (reports_++ % static_cast<std::uint64_t>(options_.shell.publish_every) != 0) return;
  std_msgs::Header header;
  header.stamp = toRosTime(report.stamp);
  header.frame_id = frames_.front();
  const std::optional<double>& mass = options_.monitor.sprung_mass;
  const auto send = [](ros::Publisher& publisher, const auto& make) {
    if (publisher.getNumSubscribers() == 0) return;
    auto msg = make();
    publisher.publish(boost::make_shared<const decltype(msg)>(std::move(msg)));
  };
  const std::vector<ActiveEffect>& effects = pipeline_->monitor()->effects();
  send(ls_, [&] { return toMsg(report.ls, "ls", header, effects, mass); });
  send(la_, [&] { return toMsg(report.la, "la", header, effects, mass); });
  if (report.comparison.has_sample) send(comparison_, [&] { return toMsg(report.comparison, header.frame_id); });
  if (tyre_) tyre_->publish(*pipeline_->strut().tyre(), report.la, header);
  send(health_, [&] { return toMsg(report, pipeline_->monitor()->baseline(), header); });
}

void MonitorNodelet::onTick() { diagnostics_->publish(*pipeline_); }

bool MonitorNodelet::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  makePipeline();
  publishModel();
  diagnostics_->input().restart();
  if (!imu_.front()) subscribe();
  response.success = true;
  response.message = "estimates, filters and counters start anew";
  return true;
}

bool MonitorNodelet::onSetEffects(SetEffectsRequest& request, SetEffectsResponse& response) {
  try {
    std::vector<ActiveEffect> effects =
        model_->choose(request.names, shapesOf(request), [this] { return motionScaleNow(); });
    pipeline_->strut().setEffects(effects);
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
    throw std::invalid_argument("window = " + (std::isnan(window) ? "nan" : std::to_string(window)) +
                                " [s], must be in [0, " + std::to_string(kept) + "] (diagnose/window)");
  const SuspensionMonitor* monitor = pipeline_->monitor();
  if (monitor == nullptr) throw std::runtime_error("the sample period is still being measured: drive on");
  const double span = window > 0.0 ? window : kept;
  SearchTask task;
  task.drive = {pipeline_->newestSamples(span), pipeline_->newestBodyMotion(span)};
  task.options.sample_period = monitor->period();
  task.options.horizon_samples = monitor->options().filter(monitor->period()).horizon_samples;
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
