#include "vehicle_nodelet.h"

#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <utility>

#include "parameters.h"
#include "strut_search.h"
#include "suspension_health_monitor/internal/prefixed.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {

VehicleNodelet::~VehicleNodelet() {
  // Nothing may call back into members that are already gone.
  diagnose_.reset();
  tick_.stop();
  imus_.reset();
  forces_.reset();
  reset_.shutdown();
  struts_.clear();
}

void VehicleNodelet::onInit() {
  ros::NodeHandle node = thread_->serve(getNodeHandle()), private_node = thread_->serve(getPrivateNodeHandle());
  startOrRefuse(private_node, [&] {
    options_ = VehicleOptions::fromValues(readParameters(private_node));
    placement_.emplace(options_.layout);
    const std::vector<std::string> imus = placement_->streams().topicsOfImus();
    imus_.emplace(node, imus, !options_.common.shell.target_frame.empty() || options_.layout.hasFrames(),
                  [this](std::size_t imu, const sensor_msgs::Imu& message) { onImu(imu, message); });
    forces_.emplace(node, placement_->streams().topicsOfForces(),
                    [this, first = imus.size()](std::size_t force, const geometry_msgs::WrenchStamped& message) {
                      onMessage(first + force, message);
                    });
    addStruts();
    makePipeline();
  });
  thread_->run([&] { start(node, private_node); });  // there, so that no callback comes before all is set up
}

void VehicleNodelet::addStruts() {
  for (std::size_t i = 0; i < options_.struts.size(); ++i) {
    const std::string& name = options_.layout.struts[i].name;
    prefixed("struts/" + name + ": ", [&] {
      struts_.push_back(std::make_unique<LiveStrut>(name, options_.struts[i], options_.model_of[i], hostOf(i)));
    });
  }
}

LiveStrut::Host VehicleNodelet::hostOf(std::size_t i) {
  LiveStrut::Host host;
  host.title = options_.layout.struts[i].name;
  host.monitor = [this, i] { return monitor() != nullptr ? monitor()->strut(i) : nullptr; };
  host.set_effects = [this, i](const auto& effects, const auto& strut) {
    if (monitor() != nullptr) monitor()->setEffects(i, effects, strut);
  };
  host.set_baseline = [this, i](const Baseline& baseline) {
    if (monitor() != nullptr) monitor()->setBaseline(i, baseline);
  };
  host.newest_samples = [this, i] {
    return pipeline_ ? pipeline_->newestSamples(options_.common.shell.diagnose_window).struts[i].samples
                     : std::vector<CornerSample>{};
  };
  host.why_none = [this] { return diagnostics_->whyNoMonitor(pipeline()); };
  host.silent_topics = [this] { return diagnostics_->input().silentTopics(); };
  host.frame = [this, imu = placement_->streams().bodyImuOf(i)]() -> const std::string& { return imus_->frame(imu); };
  host.describe_input = [this, i](ImuArrivals::Status& status) {
    diagnostics_->input().describeStrut(i, pipeline(), placement_->missing(), status);
  };
  host.queue = &thread_->queue();
  host.search = [this, i](double window) {
    return searchOf(giveSamples(window), i, [this](const VehicleDiagnosis& found) { takeDiagnosis(found); });
  };
  host.reset = [this] { return reset(); };
  return host;
}

void VehicleNodelet::start(ros::NodeHandle node, ros::NodeHandle private_node) {
  diagnostics_.emplace(node, private_node, getName(), options_, *placement_, topics());
  for (const auto& strut : struts_) strut->start(node, private_node);
  NODELET_INFO("%zu struts (%s) listen to %s", struts_.size(), join(options_.strutNames(), ", ").c_str(),
               join(topics(), ", ").c_str());
  imus_->listen();
  forces_->listen();
  reset_ = private_node.advertiseService("reset", &VehicleNodelet::onReset, this);
  diagnose_.emplace(private_node, thread_->queue(), [this](double window) {
    return searchOf(giveSamples(window), [this](const VehicleDiagnosis& found) { takeDiagnosis(found); });
  });
  tick_ = node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { onTick(); });
}

std::vector<std::string> VehicleNodelet::topics() const {
  std::vector<std::string> topics;
  const VehicleStreams& streams = placement_->streams();
  const std::size_t num_imus = streams.topicsOfImus().size();
  for (std::size_t i = 0; i < streams.sensors.size(); ++i)
    topics.push_back(i < num_imus ? imus_->topic(i) : forces_->name(i - num_imus));
  return topics;
}

void VehicleNodelet::makePipeline() {
  pipeline_.reset();
  if (const std::optional<VehicleStreams> placed = placement_->find(options_.common.shell, imus_->transforms()))
    pipeline_.emplace(options_, *placed, &imus_->transforms(), pipelineSinks());
}

VehiclePipeline::Sinks VehicleNodelet::pipelineSinks() {
  return {[this](VehicleMonitor& monitor) {
            for (std::size_t i = 0; i < struts_.size(); ++i)
              struts_[i]->begin([&](const auto& effects, const auto& strut) { monitor.setEffects(i, effects, strut); },
                                [&](const Baseline& baseline) { monitor.setBaseline(i, baseline); });
          },
          [this](std::size_t strut, const MonitorReport& report) { struts_[strut]->publish(report); }};
}

void VehicleNodelet::onImu(std::size_t imu, const sensor_msgs::Imu& message) {
  if (!pipeline_ && placement_->streams().sensors[imu].place == VehicleStreams::Place::kBody)
    placement_->noteBody(message);
  onMessage(imu, message);
}

template <class Message>
void VehicleNodelet::onMessage(std::size_t sensor, const Message& message) {
  diagnostics_->input().noteMessage(sensor, message.header.stamp);
  if (!pipeline_) return;
  try {
    pipeline_->push(sensor, message);
  } catch (const std::invalid_argument& error) {  // the options do not fit what was measured
    stopListening(error.what());
  }
}

void VehicleNodelet::stopListening(const std::string& reason) {
  NODELET_ERROR("stopped listening until reset: %s", reason.c_str());
  diagnostics_->input().setRefusal(reason);
  imus_->stop();
  forces_->stop();
}

void VehicleNodelet::onTick() {
  if (!pipeline_) makePipeline();
  if (monitor() != nullptr) monitor()->fitBodyIfDue();
  diagnostics_->publish(pipeline());
  for (const auto& strut : struts_) strut->publishDiagnostics();
}

std::string VehicleNodelet::reset() {
  makePipeline();
  for (const auto& strut : struts_) strut->publishModel();
  diagnostics_->input().restart();
  imus_->listen();
  forces_->listen();
  return "estimates, coupling, filters and counters of the whole vehicle start anew";
}

bool VehicleNodelet::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.success = true;
  response.message = reset();
  return true;
}

VehicleSearchTask VehicleNodelet::giveSamples(double window) const {
  const double span = searchSpan(window, options_.common.shell.diagnose_window);
  if (!pipeline_ || pipeline_->monitor() == nullptr)
    throw std::runtime_error(diagnostics_->whyNoMonitor(pipeline()) + ": drive on");
  VehicleSearchTask task{pipeline_->newestSamples(span), options_.strutNames(), {}};
  pipeline_->grid()->describe(task.drive);
  if (task.drive.struts.front().samples.empty()) throw std::runtime_error("there are no samples yet: drive on");
  task.options.sample_period = pipeline_->period();
  task.options.candidates = struts_.front()->model().library();
  return task;
}

void VehicleNodelet::takeDiagnosis(const VehicleDiagnosis& found) {
  for (std::size_t i = 0; i < struts_.size(); ++i)
    if (found.struts[i]) struts_[i]->setDiagnosis(found.struts[i]);
  onTick();
}

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::VehicleNodelet, nodelet::Nodelet)
