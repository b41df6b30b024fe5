#include "monitor_nodelet.h"

#include <tf2_msgs/TFMessage.h>

#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>

#include "parameters.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {

constexpr std::uint32_t kMostWaitingMessages = 100000;  // 100 s at 1 kHz, of IMUs some 50 MB
constexpr double kBodyPeriod = 0.02;                    // [s], of portions: some 100 make a test of the vehicle file

void MonitorNodelet::onInit() {
  ros::NodeHandle node = thread_->serve(getNodeHandle()), private_node = thread_->serve(getPrivateNodeHandle());
  startOrRefuse(private_node, [&] {
    options_ = optionsFrom(readParameters(private_node));
    streams_ = streamsAnywhere(options_.layout);
    frames_.resize(streams_->sensors.size());
    for (std::size_t i = 0; i < options_.struts.size(); ++i)
      prefixed(options_.prefix(i),
               [&] { struts_.push_back(std::make_unique<LiveStrut>(*this, i, options_, getName())); });
    makePipeline();
  });
  thread_->run([&] { start(node, private_node); });  // there, so that no callback comes before all is set up
}

void MonitorNodelet::start(ros::NodeHandle node, ros::NodeHandle private_node) {
  input_.emplace(*this, getName(), options_, *streams_, topicNames());
  if (!isAlone()) diagnostics_.emplace(*this, node, private_node, getName(), options_);
  const auto own = mapped(struts_, [&](const auto& strut) { return strut->start(node, private_node); });
  curves_.emplace(*this, own, options_.common.shell.diagnose_window);
  listen();
  isAlone() ? startAlone(private_node) : startVehicle(private_node);
  tick_ = node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { onTick(); });
}

void MonitorNodelet::startAlone(ros::NodeHandle& private_node) {
  const MonitorOptions& options = options_.struts.front().monitor;
  NODELET_INFO("listens to %s (body) and %s (wheel); sample period %s, horizon %g s, memory %g s; health against %s",
               topicNames()[indexOf(Side::kSprung)].c_str(), topicNames()[indexOf(Side::kUnsprung)].c_str(),
               options.sample_period ? formatted("%g s", *options.sample_period).c_str() : "measured",
               MonitorSettings(options).presentHorizon(), MonitorSettings(options).presentMemory(),
               struts_.front()->baseline().reference(options).c_str());
  reconfigure_.emplace(private_node);  // writes down the parameters as they were given, and defaults
  reconfigure_->setConfigMin(LiveSettings(options_.common).lowerEnds());
  reconfigure_->setConfigMax(LiveSettings(options_.common).upperEnds());
  reconfigure_->setCallback([this](LiveSettings& settings, std::uint32_t) { onReconfigure(settings); });
}

void MonitorNodelet::startVehicle(ros::NodeHandle& private_node) {
  NODELET_INFO("%zu struts (%s) listen to %s", struts_.size(), join(options_.strutNames(), ", ").c_str(),
               join(topicNames(), ", ").c_str());
  body_ = private_node.createWallTimer(ros::WallDuration(kBodyPeriod), [this](const ros::WallTimerEvent&) {
    if (pipeline_ && pipeline_->monitor() != nullptr) pipeline_->monitor()->fitBodyIfDue();
  });
  using Trigger = std_srvs::Trigger;
  reset_ = private_node.advertiseService<Trigger::Request, Trigger::Response>("reset", [this](auto&, auto& response) {
    response.success = true;
    response.message = reset();
    return true;
  });
  diagnose_.emplace(private_node, *this);
}

std::optional<VehicleStreams> MonitorNodelet::placedStreams() {
  if (!streams_->channels.body_imu || !options_.layout.hasFrames()) return streams_;
  if (!body_message_) return std::nullopt;
  VehicleLayout placed = options_.layout;
  try {
    placeFrames(placed, *body_message_, options_.common.shell, transforms_);
    return VehicleStreams(placed);
  } catch (const std::invalid_argument& error) {
    why_no_places_ = error.what();
    return std::nullopt;
  }
}

void MonitorNodelet::makePipeline() {
  pipeline_.reset();
  const std::optional<VehicleStreams> placed = placedStreams();
  if (!placed) return;
  pipeline_.emplace(
      options_, *placed, &transforms_,
      [this](std::size_t strut, const MonitorReport& report) { struts_[strut]->publish(report); }, true);
  for (const auto& strut : struts_) strut->begin(*pipeline_);
}

std::string MonitorNodelet::whyNoMonitor() {
  if (!pipeline_) return why_no_places_;
  if (pipeline_->monitor() == nullptr) return kMeasuringPeriod;
  return "the drives so far " + whyNotCoupled(pipeline_->monitor()->mistake(), options_.strutNames());
}

void MonitorNodelet::listen() {
  const bool by_transforms = !options_.common.shell.target_frame.empty() || options_.layout.hasFrames();
  const auto take_transforms = [this](const tf2_msgs::TFMessage& tree) {
    for (const geometry_msgs::TransformStamped& transform : tree.transforms)
      transforms_.setTransform(transform, "/tf_static", true);
  };
  if (by_transforms && !static_transforms_)
    static_transforms_ = subscribe<tf2_msgs::TFMessage>("/tf_static", take_transforms);
  if (!subscribers_.empty()) return;
  const std::vector<VehicleStreams::Sensor>& sensors = streams_->sensors;
  for (std::size_t i = 0; i < sensors.size(); ++i)
    subscribers_.push_back(
        sensors[i].place == VehicleStreams::Place::kForce
            ? subscribe<geometry_msgs::WrenchStamped>(sensors[i].topic,
                                                      [this, i](const auto& wrench) { onMessage(i, wrench); })
            : subscribe<sensor_msgs::Imu>(sensors[i].topic, [this, i](const auto& imu) { onImu(i, imu); }));
  const std::vector<std::string> thermometers = options_.temperatureTopics();
  for (std::size_t i = 0; i < thermometers.size(); ++i)
    if (!thermometers[i].empty())
      subscribers_.push_back(subscribe<sensor_msgs::Temperature>(thermometers[i], [this, i](const auto& temperature) {
        if (pipeline_) pipeline_->push(i, temperature);
      }));
}

template <class Message, class Receive>
ros::Subscriber MonitorNodelet::subscribe(const std::string& topic, const Receive& receive) {
  const auto take = [receive](const boost::shared_ptr<const Message>& message) { receive(*message); };
  return thread_->serve(getNodeHandle())
      .subscribe<Message>(topic, kMostWaitingMessages, take, nullptr, ros::TransportHints().tcpNoDelay());
}

std::vector<std::string> MonitorNodelet::topicNames() const {
  return mapped(streams_->sensors,
                [this](const VehicleStreams::Sensor& sensor) { return getNodeHandle().resolveName(sensor.topic); });
}

void MonitorNodelet::onImu(std::size_t imu, const sensor_msgs::Imu& message) {
  frames_[imu] = message.header.frame_id;
  if (!pipeline_ && streams_->sensors[imu].place == VehicleStreams::Place::kBody) body_message_ = message;
  onMessage(imu, message);
}

template <class Message>
void MonitorNodelet::onMessage(std::size_t sensor, const Message& message) {
  input_->noteMessage(sensor, message.header.stamp);
  if (!pipeline_) return;
  try {
    pipeline_->push(sensor, message);
  } catch (const std::invalid_argument& error) {  // the options do not fit what was measured
    NODELET_ERROR("stopped listening until reset: %s", error.what());
    input_->setRefusal(error.what());
    subscribers_.clear();
  }
}

void MonitorNodelet::onReconfigure(LiveSettings& settings) {
  try {
    const PipelineOptions changed = settings.appliedTo(options_.common);
    pipeline_->reconfigure(changed.monitor);
    options_.common = options_.struts.front() = changed;
    struts_.front()->setStride(changed.shell.publish_every);
  } catch (const std::invalid_argument& error) {
    NODELET_WARN("%s; all settings stay as they were", error.what());
  }
  settings = LiveSettings(options_.common);
}

void MonitorNodelet::onTick() {
  if (!isAlone()) {
    if (!pipeline_) makePipeline();
    diagnostics_->publish();
  }
  for (const auto& strut : struts_) strut->publishDiagnostics();
}

std::string MonitorNodelet::reset() {
  makePipeline();
  for (const auto& strut : struts_) strut->publishModel();
  input_->restart();
  listen();
  return isAlone() ? "estimates, filters and counters start anew"
                   : "estimates, coupling, filters and counters of the whole vehicle start anew";
}

SearchTask MonitorNodelet::samplesFor(double window) {
  const double kept = options_.common.shell.diagnose_window;
  if (!(window >= 0.0 && window <= kept))
    refuse("window", window, "s", "in [0, " + numberText(kept) + "] (diagnose/window)");
  if (!pipeline_ || pipeline_->monitor() == nullptr) throw std::runtime_error(whyNoMonitor() + ": drive on");
  SearchTask task{pipeline_->newestSamples(window > 0.0 ? window : kept), options_.strutNames(), {}};
  pipeline_->grid()->describe(task.drive);
  if (task.drive.struts.front().samples.empty()) throw std::runtime_error("there are no samples yet: drive on");
  task.options.sample_period = pipeline_->period();
  const LiveModel& model = struts_.front()->model();
  task.options.candidates = model.library();
  if (!isAlone()) return task;
  task.options.horizon_samples = pipeline_->strut()->horizonSamples();
  if (!model.effects().empty()) task.options.model = modelOf(pipeline_->strut());
  return task;
}

void MonitorNodelet::takeDiagnosis(const VehicleDiagnosis& found) {
  for (std::size_t i = 0; i < struts_.size(); ++i)
    if (found.struts[i]) struts_[i]->model().setDiagnosis(found.struts[i]);
  onTick();
}

/// Keeps launch files that load it running until the next version; VehicleNodelet does its work.
class CornersNodelet : public nodelet::Nodelet {
  void onInit() override {
    NODELET_WARN("CornersNodelet does nothing any more: VehicleNodelet compares the corners; do not load it");
  }
};

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::MonitorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::VehicleNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::CornersNodelet, nodelet::Nodelet)
