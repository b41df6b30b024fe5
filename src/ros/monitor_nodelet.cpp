#include "monitor_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "parameters.h"

namespace suspension_health_monitor {

MonitorNodelet::~MonitorNodelet() {
  // Nothing may call back into members that are already gone.
  tick_.stop();
  for (ros::Subscriber& subscriber : imu_) subscriber.shutdown();
  reset_.shutdown();
}

void MonitorNodelet::onInit() {
  ros::NodeHandle& node = getNodeHandle();
  ros::NodeHandle& private_node = getPrivateNodeHandle();
  startOrRefuse(private_node, [&] {
    options_ = PipelineOptions::fromValues(readParameters(private_node));
    makePipeline();
  });
  const auto queue_size = static_cast<std::uint32_t>(options_.shell.queue_size);
  ls_ = private_node.advertise<ParameterEstimate>("ls", queue_size);
  la_ = private_node.advertise<ParameterEstimate>("la", queue_size);
  comparison_ = private_node.advertise<ModelComparison>("comparison", queue_size);
  health_ = private_node.advertise<SuspensionHealth>("health", queue_size);
  reset_ = private_node.advertiseService("reset", &MonitorNodelet::onReset, this);
  subscribe();
  diagnostics_.emplace(node, private_node, getName(), options_.shell, imu_);
  tick_ = node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { onTick(); });
}

void MonitorNodelet::makePipeline() {
  pipeline_.emplace(options_, [this](const MonitorReport& report) { publish(report); });
}

void MonitorNodelet::subscribe() {
  const auto queue_size = static_cast<std::uint32_t>(options_.shell.queue_size);
  const auto listen = [&](Side side, const char* topic) {
    return getNodeHandle().subscribe<sensor_msgs::Imu>(
        topic, queue_size, [this, side](const sensor_msgs::ImuConstPtr& imu) { onImu(side, imu); }, nullptr,
        ros::TransportHints().tcpNoDelay());
  };
  imu_ = {listen(Side::kSprung, "sprung/imu"), listen(Side::kUnsprung, "unsprung/imu")};
}

void MonitorNodelet::stopListening(const std::string& reason) {
  NODELET_ERROR("stopped listening until reset: %s", reason.c_str());
  diagnostics_->setRefusal(reason);
  for (ros::Subscriber& subscriber : imu_) subscriber.shutdown();
}

void MonitorNodelet::onImu(Side side, const sensor_msgs::ImuConstPtr& imu) {
  frames_[static_cast<std::size_t>(side)] = imu->header.frame_id;
  diagnostics_->noteMessage(side);
  try {
    pipeline_->push(side, *imu);
  } catch (const std::invalid_argument& error) {  // the options do not fit the sample period that was measured
    stopListening(error.what());
  }
}

void MonitorNodelet::publish(const MonitorReport& report) {
  if (diagnostics_->noteLevel(report.health.level)) onTick();
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
  if (report.comparison.has_sample)
    send(comparison_, [&] { return toMsg(report.comparison, header.frame_id); });
  send(health_, [&] { return toMsg(report, options_.monitor, header); });
}

void MonitorNodelet::onTick() { diagnostics_->publish(*pipeline_); }

bool MonitorNodelet::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  makePipeline();
  diagnostics_->restart();
  if (!imu_.front()) subscribe();
  response.success = true;
  response.message = "estimates, filters and counters start anew";
  return true;
}

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::MonitorNodelet, nodelet::Nodelet)
