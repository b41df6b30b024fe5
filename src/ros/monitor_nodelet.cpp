#include "monitor_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "parameters.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {

MonitorNodelet::~MonitorNodelet() {
  // Nothing may call back into members that are already gone.
  reconfigure_.reset();
  tick_.stop();
  imus_.reset();
  strut_.reset();
}

void MonitorNodelet::onInit() {
  ros::NodeHandle node = thread_->serve(getNodeHandle()), private_node = thread_->serve(getPrivateNodeHandle());
  startOrRefuse(private_node, [&] {
    options_ = PipelineOptions::fromValues(readParameters(private_node));
    strut_.emplace("", options_, "", host());
    std::vector<std::string> topics{"sprung/imu", "unsprung/imu"};  // by Side
    if (options_.monitor.tyre) topics.emplace_back("road/imu");
    imus_.emplace(node, topics, !options_.shell.target_frame.empty(),
                  [this](std::size_t imu, const sensor_msgs::Imu& message) { onImu(static_cast<Side>(imu), message); });
    makePipeline();
  });
  thread_->run([&] { start(node, private_node); });  // there, so that no callback comes before all is set up
}

LiveStrut::Host MonitorNodelet::host() {
  LiveStrut::Host host;
  host.title = getName();
  host.monitor = [this] { return pipeline_->monitor(); };
  host.set_effects = [this](const auto& effects, const auto& strut) { pipeline_->strut().setEffects(effects, strut); };
  host.set_baseline = [this](const Baseline& baseline) { pipeline_->strut().setBaseline(baseline); };
  host.newest_samples = [this] { return pipeline_->newestSamples(options_.shell.diagnose_window); };
  host.tyre = [this] { return pipeline_->strut().tyre(); };
  if (options_.monitor.tyre)
    host.describe_tyre = [this](LiveStrut::Status& status) { describeTyre(*pipeline_, status); };
  host.why_none = [] { return kMeasuringPeriod; };
  host.silent_topics = [this] { return input_->silentTopics(); };
  host.frame = [this]() -> const std::string& { return imus_->frame(indexOf(Side::kSprung)); };
  host.describe_input = [this](LiveStrut::Status& status) {
    input_->describe(*pipeline_, status);
    input_log_->note(status);
  };
  host.queue = &thread_->queue();
  host.search = [this](double window) {
    return searchOf(giveSamples(window), [this](const Diagnosis& diagnosis) { takeDiagnosis(diagnosis); });
  };
  host.reset = [this] { return reset(); };
  return host;
}

void MonitorNodelet::start(ros::NodeHandle node, ros::NodeHandle private_node) {
  const ShellOptions& shell = options_.shell;
  input_.emplace(shell, std::array{imus_->topic(indexOf(Side::kSprung)), imus_->topic(indexOf(Side::kUnsprung))});
  input_log_.emplace(getName() + " input", LiveStrut::Status::ERROR, shell.input_timeout);
  strut_->start(node, private_node);
  imus_->listen();
  tellStart();
  reconfigure_.emplace(private_node);  // writes down the parameters as they were given, and defaults
  reconfigure_->setConfigMin(LiveSettings(options_).lowerEnds());
  reconfigure_->setConfigMax(LiveSettings(options_).upperEnds());
  reconfigure_->setCallback([this](LiveSettings& settings, std::uint32_t) { onReconfigure(settings); });
  tick_ = node.createWallTimer(ros::WallDuration(1.0),
                               [this](const ros::WallTimerEvent&) { strut_->publishDiagnostics(); });
}

void MonitorNodelet::tellStart() const {
  const MonitorOptions& options = options_.monitor;
  NODELET_INFO("listens to %s (body) and %s (wheel); sample period %s, horizon %g s, memory %g s; health against %s",
               imus_->topic(indexOf(Side::kSprung)).c_str(), imus_->topic(indexOf(Side::kUnsprung)).c_str(),
               options.sample_period ? formatted("%g s", *options.sample_period).c_str() : "measured",
               MonitorSettings(options).presentHorizon(), MonitorSettings(options).presentMemory(),
               strut_->baseline().reference(options).c_str());
}

void MonitorNodelet::makePipeline() {
  pipeline_.emplace(
      options_, [this](const MonitorReport& report) { strut_->publish(report); }, &imus_->transforms());
  StrutPipeline& strut = pipeline_->strut();
  strut_->begin([&](const auto& effects, const auto& linear) { strut.setEffects(effects, linear); },
                [&](const Baseline& baseline) { strut.setBaseline(baseline); });
}

void MonitorNodelet::onReconfigure(LiveSettings& settings) {
  try {
    const PipelineOptions changed = settings.appliedTo(options_);
    pipeline_->strut().reconfigure(changed.monitor);
    options_ = changed;
    strut_->setStride(options_.shell.publish_every);
  } catch (const std::invalid_argument& error) {
    NODELET_WARN("%s; all settings stay as they were", error.what());
  }
  settings = LiveSettings(options_);
}

void MonitorNodelet::stopListening(const std::string& reason) {
  NODELET_ERROR("stopped listening until reset: %s", reason.c_str());
  input_->setRefusal(reason);
  imus_->stop();
}

void MonitorNodelet::onImu(Side side, const sensor_msgs::Imu& imu) {
  if (side != Side::kRoad) input_->noteMessage(indexOf(side), imu.header.stamp);
  try {
    pipeline_->push(side, imu);
  } catch (const std::invalid_argument& error) {  // the options do not fit the sample period that was measured
    stopListening(error.what());
  }
}

std::string MonitorNodelet::reset() {
  makePipeline();
  strut_->publishModel();
  input_->restart();
  imus_->listen();
  return "estimates, filters and counters start anew";
}

SearchTask MonitorNodelet::giveSamples(double window) const {
  const double span = searchSpan(window, options_.shell.diagnose_window);
  const SuspensionMonitor* monitor = pipeline_->monitor();
  if (monitor == nullptr) throw std::runtime_error("the sample period is still being measured: drive on");
  SearchTask task;
  task.drive = {pipeline_->newestSamples(span), pipeline_->newestBodyMotion(span)};
  task.options.sample_period = monitor->period();
  task.options.horizon_samples = monitor->horizonSamples();
  task.options.candidates = strut_->model().library();
  const StrutEstimate& estimate = monitor->modelEstimate();
  if (!strut_->model().effects().empty() && estimate.valid())
    task.options.model = StrutModel{estimate.damping_to_mass, estimate.stiffness_to_mass, monitor->effects(), {}};
  return task;
}

void MonitorNodelet::takeDiagnosis(const Diagnosis& diagnosis) {
  strut_->setDiagnosis(diagnosis);
  strut_->publishDiagnostics();
}

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::MonitorNodelet, nodelet::Nodelet)
