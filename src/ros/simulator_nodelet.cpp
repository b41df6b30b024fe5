#include "simulator_nodelet.h"

#include <rosgraph_msgs/Clock.h>

#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>

#include "conversions.h"
#include "parameters.h"

namespace suspension_health_monitor {
namespace {

constexpr std::uint32_t kQueueSize = 1000;
constexpr double kLeadSamples = 200.0;  // how far the drive may run ahead of the monitor that sets the pace
constexpr std::chrono::milliseconds kPoll{1};
constexpr double kLongestSleep = 0.05;  // [s], so that unloading the nodelet need not wait for a slow drive
constexpr std::chrono::milliseconds kLongestWaitForPace{500};

}  // namespace

SimulatorNodelet::~SimulatorNodelet() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
  pace_.shutdown();
}

void SimulatorNodelet::onInit() {
  ros::NodeHandle& node = getMTNodeHandle();
  ros::NodeHandle& private_node = getPrivateNodeHandle();
  SimulatorOptions options;
  startOrRefuse(private_node, [&] { options = SimulatorOptions::fromValues(readParameters(private_node)); });
  sprung_ = node.advertise<sensor_msgs::Imu>("sprung/imu", kQueueSize);
  unsprung_ = node.advertise<sensor_msgs::Imu>("unsprung/imu", kQueueSize);
  if (options.publishing.road_imu) road_ = node.advertise<sensor_msgs::Imu>("road/imu", kQueueSize);
  truth_ = private_node.advertise<SimulationTruth>("truth", kQueueSize);
  if (options.publishing.publish_clock) clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", kQueueSize);
  pace_ = node.subscribe<ParameterEstimate>("pace", kQueueSize, [this](const ParameterEstimateConstPtr& estimate) {
    paced_until_ = estimate->header.stamp.toSec();
  });
  thread_ = std::thread(&SimulatorNodelet::drive, this, options);
}

void SimulatorNodelet::drive(SimulatorOptions options) {
  waitForStart(options.publishing);
  try {
    publishDrive(options);
    if (!running_ || !ros::ok()) return;
    NODELET_INFO("drive of %g s finished", options.drive.duration);
  } catch (const std::invalid_argument& error) {  // a strut that cannot be simulated
    NODELET_ERROR("%s", error.what());
  }
  if (!options.publishing.shutdown_at_end) return;
  std::this_thread::sleep_for(kLongestWaitForPace);  // the last messages are still on their way
  ros::requestShutdown();
}

void SimulatorNodelet::publishDrive(const SimulatorOptions& options) {
  const bool from_now = !options.publishing.publish_clock && options.publishing.start_time == 0.0;
  const Stamp start = from_now ? toStamp(ros::Time::now()) : fromSeconds(options.publishing.start_time);
  const Clock::time_point wall_start = Clock::now();
  DriveMessageSource source(options, start);
  while (running_ && ros::ok()) {
    const std::optional<DriveMessages> messages = source.next();
    if (!messages) break;
    waitForTurn(options, toRosTime(start), messages->time, wall_start);
    publish(*messages, options.publishing.publish_clock);
  }
}

void SimulatorNodelet::waitForStart(const PublishingOptions& options) const {
  const auto wanted = [this] { return running_ && ros::ok(); };
  while (options.wait_for_subscribers && wanted() &&
         (sprung_.getNumSubscribers() == 0 || unsprung_.getNumSubscribers() == 0))
    std::this_thread::sleep_for(kPoll);
  const Clock::time_point start = Clock::now();
  while (wanted() && std::chrono::duration<double>(Clock::now() - start).count() < options.start_delay) {
    // rosbag record keeps only 100 messages per topic until it has seen a clock that is not 0
    if (options.publish_clock) publishClock(toRosTime(fromSeconds(options.start_time)));
    std::this_thread::sleep_for(kPoll);
  }
}

void SimulatorNodelet::waitForTurn(const SimulatorOptions& options, ros::Time start, ros::Time now,
                                   Clock::time_point wall_start) {
  const double factor = options.publishing.real_time_factor;
  if (factor > 0.0) {
    const double due = (now - start).toSec() / factor;  // wall seconds since the start
    const auto left = [&] { return due - std::chrono::duration<double>(Clock::now() - wall_start).count(); };
    while (running_ && ros::ok() && left() > 0.0)
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left(), kLongestSleep)));
    return;
  }
  if (pace_.getNumPublishers() == 0 || pace_is_lost_) return;
  const double lead = kLeadSamples / fasterRate(options.drive);
  const Clock::time_point give_up = Clock::now() + kLongestWaitForPace;
  while (running_ && ros::ok() && now.toSec() - std::max(paced_until_.load(), start.toSec()) > lead &&
         Clock::now() < give_up)
    std::this_thread::sleep_for(kPoll);
  if (Clock::now() < give_up) return;
  pace_is_lost_ = true;
  NODELET_WARN("%s sets no pace (is publish_every above %g?): going on without it", pace_.getTopic().c_str(),
               kLeadSamples);
}

void SimulatorNodelet::publishClock(ros::Time now) const {
  rosgraph_msgs::Clock clock;
  clock.clock = std::max(now, ros::TIME_MIN);  // 0 means that there is no clock yet
  clock_.publish(clock);
}

void SimulatorNodelet::publish(const DriveMessages& messages, bool publish_clock) {
  if (publish_clock) publishClock(messages.time);
  if (messages.sprung) sprung_.publish(boost::make_shared<const sensor_msgs::Imu>(*messages.sprung));
  if (messages.unsprung) unsprung_.publish(boost::make_shared<const sensor_msgs::Imu>(*messages.unsprung));
  if (messages.road) road_.publish(boost::make_shared<const sensor_msgs::Imu>(*messages.road));
  truth_.publish(boost::make_shared<const SimulationTruth>(messages.truth));
}

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::SimulatorNodelet, nodelet::Nodelet)
