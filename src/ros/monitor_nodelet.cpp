#include "monitor_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "parameters.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {

MonitorNodelet::~MonitorNodelet() {
  // Nothing may call back into members that are already gone.
  diagnose_.reset();
  reconfigure_.reset();
  tick_.stop();
  imus_.reset();
  services_.reset();
}

void MonitorNodelet::onInit() {
  ros::NodeHandle node = thread_->serve(getNodeHandle()), private_node = thread_->serve(getPrivateNodeHandle());
  startOrRefuse(private_node, [&] {
    options_ = PipelineOptions::fromValues(readParameters(private_node));
    model_.emplace(options_.shell);
    baseline_.emplace(options_);
    std::vector<std::string> topics{"sprung/imu", "unsprung/imu"};  // by Side
    if (options_.monitor.tyre) topics.emplace_back("road/imu");
    imus_.emplace(node, topics, !options_.shell.target_frame.empty(),
                  [this](std::size_t imu, const sensor_msgs::Imu& message) { onImu(static_cast<Side>(imu), message); });
    makePipeline();
  });
  for (const std::string& remark : model_->remarks()) NODELET_WARN("%s", remark.c_str());
  thread_->run([&] { start(node, private_node); });  // there, so that no callback comes before all is set up
}

void MonitorNodelet::start(ros::NodeHandle node, ros::NodeHandle private_node) {
  reports_.emplace(private_node, options_);
  publishModel();
  imus_->listen();
  tellStart();
  diagnostics_.emplace(node, private_node, getName(), options_,
                       std::array{imus_->topic(indexOf(Side::kSprung)), imus_->topic(indexOf(Side::kUnsprung))},
                       *model_);
  advertiseServices(private_node);
  tick_ = node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { onTick(); });
}

void MonitorNodelet::tellStart() const {
  const MonitorOptions& options = options_.monitor;
  NODELET_INFO("listens to %s (body) and %s (wheel); sample period %s, horizon %g s, memory %g s; health against %s",
               imus_->topic(indexOf(Side::kSprung)).c_str(), imus_->topic(indexOf(Side::kUnsprung)).c_str(),
               options.sample_period ? formatted("%g s", *options.sample_period).c_str() : "measured",
               MonitorSettings(options).presentHorizon(), MonitorSettings(options).presentMemory(),
               baseline_->reference(options).c_str());
}

void MonitorNodelet::makePipeline() {
  pipeline_.emplace(
      options_, [this](const MonitorReport& report) { publish(report); }, &imus_->transforms());
  pipeline_->strut().setEffects(model_->effects(), model_->strutFor(model_->effects()));
  if (baseline_->known()) pipeline_->strut().setBaseline(*baseline_->known());
}

void MonitorNodelet::advertiseServices(ros::NodeHandle& private_node) {
  services_.emplace(private_node, options_.shell, *model_, *baseline_,
                    StrutServices::Strut{[this] { return pipeline_->monitor(); },
                                         [this](const auto& effects, const auto& strut) {
                                           pipeline_->strut().setEffects(effects, strut);
                                         },
                                         [this](const Baseline& baseline) { pipeline_->strut().setBaseline(baseline); },
                                         [this] { return pipeline_->newestSamples(options_.shell.diagnose_window); },
                                         [this] {
                                           publishModel();
                                           onTick();
                                         },
                                         [this] { return reset(); }});
  diagnose_.emplace(private_node, thread_->queue(), [this](double window) {
    return searchOf(giveSamples(window), [this](const Diagnosis& diagnosis) { takeDiagnosis(diagnosis); });
  });
  reconfigure_.emplace(private_node);  // writes down the parameters as they were given, and defaults
  reconfigure_->setConfigMin(LiveSettings(options_).lowerEnds());
  reconfigure_->setConfigMax(LiveSettings(options_).upperEnds());
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
  reports_->model().change(monitor != nullptr ? monitor->effects() : model_->effects(), monitor,
                           imus_->frame(indexOf(Side::kSprung)));
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
  if (diagnostics_->note(report)) onTick();
  if (report.health.learned && !baseline_->known()) keepBaseline();
  reports_->publish(report, *pipeline_->monitor(), pipeline_->strut().tyre(), imus_->frame(indexOf(Side::kSprung)));
}

void MonitorNodelet::onTick() { diagnostics_->publish(*pipeline_); }

std::string MonitorNodelet::reset() {
  makePipeline();
  publishModel();
  diagnostics_->input().restart();
  imus_->listen();
  return "estimates, filters and counters start anew";
}

void MonitorNodelet::keepBaseline() {
  try {
    NODELET_INFO("%s", baseline_->keepLearned(*pipeline_->monitor()).c_str());
  } catch (const std::runtime_error& error) {
    NODELET_ERROR("%s", error.what());
  }
}

SearchTask MonitorNodelet::giveSamples(double window) const {
  const double span = searchSpan(window, options_.shell.diagnose_window);
  const SuspensionMonitor* monitor = pipeline_->monitor();
  if (monitor == nullptr) throw std::runtime_error("the sample period is still being measured: drive on");
  SearchTask task;
  task.drive = {pipeline_->newestSamples(span), pipeline_->newestBodyMotion(span)};
  task.options.sample_period = monitor->period();
  task.options.horizon_samples = monitor->horizonSamples();
  task.options.candidates = model_->library();
  const StrutEstimate& estimate = monitor->modelEstimate();
  if (!model_->effects().empty() && estimate.valid())
    task.options.model = StrutModel{estimate.damping_to_mass, estimate.stiffness_to_mass, monitor->effects(), {}};
  return task;
}

void MonitorNodelet::takeDiagnosis(const Diagnosis& diagnosis) {
  model_->setDiagnosis(diagnosis);
  onTick();
}

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::MonitorNodelet, nodelet::Nodelet)
