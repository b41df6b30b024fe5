#include "vehicle_nodelet.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <utility>

#include "conversions.h"
#include "parameters.h"
#include "strut_search.h"

namespace suspension_health_monitor {
namespace {

/// The numbers of the streams do not depend on positions, which frames tell only later.
VehicleStreams unplacedStreams(VehicleLayout layout) {
  for (VehicleLayout::Strut& strut : layout.struts)
    if (strut.frame) strut.position.emplace();
  return VehicleStreams(layout);
}

}  // namespace

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
    streams_ = unplacedStreams(options_.layout);
    const std::vector<std::string> imus = streams_->topicsOfImus();
    imus_.emplace(node, imus, !options_.common.shell.target_frame.empty() || options_.layout.hasFrames(),
                  [this](std::size_t imu, const sensor_msgs::Imu& message) { onImu(imu, message); });
    forces_.emplace(node, streams_->topicsOfForces(),
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
    const std::optional<std::size_t>& sprung = streams_->channels.struts[i].sprung;
    const std::size_t stream = sprung ? *sprung : *streams_->channels.body_imu;
    body_imus_.push_back(streams_->options[stream].sensor);
    struts_.push_back(std::make_unique<LiveStrut>(options_.layout.struts[i].name, i, options_.struts[i],
                                                  options_.model_of[i], servedStrut(i)));
  }
}

LiveStrut::Vehicle VehicleNodelet::servedStrut(std::size_t i) {
  LiveStrut::Vehicle vehicle;
  vehicle.monitor = [this] { return monitor(); };
  vehicle.newest_samples = [this, i] {
    return pipeline_ ? pipeline_->newestSamples(options_.common.shell.diagnose_window).struts[i].samples
                     : std::vector<CornerSample>{};
  };
  vehicle.why_none = [this] { return whyNoMonitor(); };
  vehicle.silent_topics = [this] { return input_->silentTopics(); };
  vehicle.frame = [this, i]() -> const std::string& { return frameOf(i); };
  vehicle.describe_input = [this, i](ImuArrivals::Status& status) {
    input_->describeStrut(i, pipeline_ ? &*pipeline_ : nullptr, missing_position_, status);
  };
  vehicle.queue = &thread_->queue();
  vehicle.search = [this, i](double window) {
    return searchOf(giveSamples(window), i, [this](const VehicleDiagnosis& found) { takeDiagnosis(found); });
  };
  vehicle.reset = [this] { return reset(); };
  return vehicle;
}

void VehicleNodelet::start(ros::NodeHandle node, ros::NodeHandle private_node) {
  // Who advertises first decides how long the queue is: an Updater's own holds one message, and all of them publish at
  // once, so that the status of a strut would be lost behind that of the next.
  diagnostics_ = node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 2 * (options_.struts.size() + 1));
  std::vector<std::string> topics;
  for (std::size_t i = 0; i < streams_->topicsOfImus().size(); ++i) topics.push_back(imus_->topic(i));
  for (std::size_t i = 0; i < streams_->topicsOfForces().size(); ++i) topics.push_back(forces_->name(i));
  input_.emplace(options_.common.shell, *streams_, topics);
  coupling_.emplace(private_node, options_.strutNames(), options_.forceNames());
  for (const auto& strut : struts_) strut->start(node, private_node);
  const std::string name = getName().substr(getName().find_first_not_of('/'));
  updater_.emplace(node, private_node, getName());
  updater_->setHardwareID(name);
  updater_->add("Coupling", [this](ImuArrivals::Status& status) {
    coupling_->describe(monitor(), whyNoMonitor(), places_, status);
  });
  updater_->add("Input", [this](ImuArrivals::Status& status) {
    input_->describe(pipeline_ ? &*pipeline_ : nullptr, missing_position_, status);
  });
  imus_->listen();
  forces_->listen();
  reset_ = private_node.advertiseService("reset", &VehicleNodelet::onReset, this);
  diagnose_.emplace(private_node, thread_->queue(), [this](double window) {
    return searchOf(giveSamples(window), [this](const VehicleDiagnosis& found) { takeDiagnosis(found); });
  });
  tick_ = node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { onTick(); });
}

void VehicleNodelet::makePipeline() {
  pipeline_.reset();
  if (streams_->channels.body_imu && options_.layout.hasFrames()) {
    missing_position_ = "waiting for body_imu, whose frame tells the struts' positions";
    return placeStruts();
  }
  places_ = placesOf(options_.layout);
  pipeline_.emplace(options_, *streams_, &imus_->transforms(), pipelineSinks());
}

void VehicleNodelet::placeStruts() {
  if (!body_message_) return;
  VehicleLayout layout = options_.layout;
  try {
    placeFrames(layout, *body_message_, options_.common.shell, imus_->transforms());
  } catch (const std::invalid_argument& error) {
    missing_position_ = error.what();
    return;
  }
  for (VehicleLayout::Strut& strut : layout.struts) strut.frame.reset();
  places_ = placesOf(layout);
  pipeline_.emplace(options_, VehicleStreams(layout), &imus_->transforms(), pipelineSinks());
}

VehiclePipeline::Sinks VehicleNodelet::pipelineSinks() {
  return {[this](VehicleMonitor& monitor) {
            for (const auto& strut : struts_) strut->begin(monitor);
          },
          [this](std::size_t strut, const MonitorReport& report) { struts_[strut]->publish(report); }};
}

void VehicleNodelet::onImu(std::size_t imu, const sensor_msgs::Imu& message) {
  if (!pipeline_ && streams_->sensors[imu].place == VehicleStreams::Place::kBody) body_message_ = message;
  onMessage(imu, message);
}

template <class Message>
void VehicleNodelet::onMessage(std::size_t sensor, const Message& message) {
  input_->noteMessage(sensor, message.header.stamp);
  if (!pipeline_) return;
  try {
    pipeline_->push(sensor, message);
  } catch (const std::invalid_argument& error) {  // the options do not fit what was measured
    stopListening(error.what());
  }
}

void VehicleNodelet::stopListening(const std::string& reason) {
  NODELET_ERROR("stopped listening until reset: %s", reason.c_str());
  input_->setRefusal(reason);
  imus_->stop();
  forces_->stop();
}

std::string VehicleNodelet::whyNoMonitor() const {
  if (!pipeline_) return missing_position_;
  return pipeline_->monitor() == nullptr ? kMeasuringPeriod
                                         : whyNotCoupled(*pipeline_->monitor(), options_.strutNames());
}

void VehicleNodelet::onTick() {
  if (!pipeline_) placeStruts();
  coupling_->publish(monitor(), whyNoMonitor(), places_, pipeline_ ? toRosTime(pipeline_->newest()) : ros::Time());
  updater_->force_update();
  for (const auto& strut : struts_) strut->publishDiagnostics();
}

std::string VehicleNodelet::reset() {
  makePipeline();
  for (const auto& strut : struts_) strut->publishModel();
  input_->restart();
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
  if (!pipeline_ || pipeline_->monitor() == nullptr) throw std::runtime_error(whyNoMonitor() + ": drive on");
  VehicleSearchTask task{pipeline_->newestSamples(span), options_.strutNames(), {}};
  task.drive.noise = pipeline_->grid()->noise();
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
