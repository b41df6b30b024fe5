#include "simulator_nodelet.h"

#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <type_traits>

#include "arrivals.h"
#include "conversions.h"
#include "parameters.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

constexpr std::uint32_t kQueueSize = 1000;
constexpr int kLeadSamples = 200;  // how far the drive may run ahead of the monitors; fewer than their queues hold
constexpr std::chrono::milliseconds kPoll{1};
constexpr std::chrono::milliseconds kPollMaster{50};
constexpr double kLongestSleep = 0.05;         // [s], so that unloading the nodelet need not wait for a slow drive
constexpr std::chrono::seconds kPatience{10};  // until the log says what the drive waits for
constexpr std::chrono::milliseconds kSendingTime{500};

SimulatorNodelet::~SimulatorNodelet() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
}

void SimulatorNodelet::onInit() {
  ros::NodeHandle& node = getMTNodeHandle();
  ros::NodeHandle& private_node = getPrivateNodeHandle();
  SimulatedDrive simulated;
  startOrRefuse(private_node, [&] {
    simulated = makeSimulatedDrive(readParameters(private_node));
    if (!simulated.playing.record.empty())
      recorder_.emplace(node, simulated.playing.record, simulated.playing.record_topics);
  });
  if (node.resolveName("pace") != node.resolveName("pace", false))  // remapped to somebody's estimates
    pace_ = node.subscribe<ParameterEstimate>("pace", kQueueSize, [this](const ParameterEstimateConstPtr& estimate) {
      paced_until_ = estimate->header.stamp.toSec();
    });
  for (const auto& [topic, message] : simulated.topics) publishers_.emplace(topic, advertise(topic, message));
  if (simulated.playing.publish_clock) clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", kQueueSize);
  thread_ = std::thread([this, simulated] { drive(simulated); });
}

ros::Publisher SimulatorNodelet::advertise(const std::string& topic, const SimulatedMessage& message) {
  const bool own = topic.front() == '~';
  ros::NodeHandle& node = own ? getPrivateNodeHandle() : getMTNodeHandle();
  const auto asItsType = [&](const auto& typed) {
    return node.advertise<std::decay_t<decltype(typed)>>(topic.substr(own ? 1 : 0), kQueueSize);
  };
  return std::visit(asItsType, message);
}

void SimulatorNodelet::drive(const SimulatedDrive& drive) {
  try {
    waitForStart(drive.awaited);
    publishDrive(drive);
    if (goesOn()) NODELET_INFO("drive of %g s finished", drive.duration);
  } catch (const std::invalid_argument& error) {  // a strut that cannot be simulated, a topic that cannot be recorded
    NODELET_ERROR("%s", error.what());
  }
  closeRecording();
  if (!goesOn() || !drive.playing.shutdown_at_end) return;
  std::this_thread::sleep_for(kSendingTime);  // the last messages are on their way to other processes
  ros::requestShutdown();
}

void SimulatorNodelet::publishDrive(const SimulatedDrive& drive) {
  const bool from_now = !drive.playing.publish_clock && drive.playing.start_time == 0.0;
  const Stamp start = from_now ? toStamp(ros::Time::now()) : fromSeconds(drive.playing.start_time);
  const Clock::time_point wall_start = Clock::now();
  paced_until_ = toSeconds(start);
  const DriveSource source = drive.begin(start);
  for (int published = 1; goesOn(); ++published) {
    const std::optional<SimulatedInstant> instant = source();
    if (!instant) break;
    waitForTurn(drive, toRosTime(start), instant->time, wall_start);
    publish(*instant);
    if (published % kLeadSamples == 0) waitForMonitors();
  }
}

void SimulatorNodelet::closeRecording() {
  if (!recorder_) return;
  waitForMonitors();
  try {
    const std::size_t count = recorder_->commit();
    NODELET_INFO("%zu messages recorded", count);
  } catch (const std::runtime_error& error) {
    NODELET_ERROR("%s", error.what());
  }
  recorder_.reset();
}

void SimulatorNodelet::waitForStart(const std::vector<std::string>& awaited) {
  const auto is_heard = [this](const std::string& topic) { return publishers_.at(topic).getNumSubscribers() > 0; };
  while (goesOn() && !std::all_of(awaited.begin(), awaited.end(), is_heard)) std::this_thread::sleep_for(kPoll);
  const auto paces = [this] { return pace_.getNumPublishers() > 0 || publishedTopics().count(pace_.getTopic()) == 0; };
  while (goesOn() && !paces()) std::this_thread::sleep_for(kPollMaster);
  if (recorder_) waitForRecording();
}

// A monitor advertises its estimates before it subscribes to the IMUs, both in one go of the thread that serves it:
// once that is idle, both are done.
void SimulatorNodelet::waitForRecording() {
  const auto own = mapped(publishers_, [](const auto& its) { return its.second.getTopic(); });
  Clock::time_point asked = Clock::now();
  while (goesOn()) {
    const std::vector<std::string> missing = recorder_->connect(own);
    if (missing.empty()) break;
    if (Clock::now() - asked > kPatience) {
      NODELET_WARN("the drive waits for what is to be recorded: nobody publishes %s", join(missing, ", ").c_str());
      asked = Clock::now();
    }
    std::this_thread::sleep_for(kPollMaster);
  }
  waitForMonitors();
}

// Until the monitors of this process have taken in what was published, and the recorder what they made of it.
void SimulatorNodelet::waitForMonitors() const {
  while (goesOn() && !monitors_->isIdle()) std::this_thread::sleep_for(kPoll);
}

void SimulatorNodelet::waitForTurn(const SimulatedDrive& drive, ros::Time start, ros::Time now,
                                   Clock::time_point wall_start) {
  const double factor = drive.playing.real_time_factor;
  if (factor > 0.0) {
    const double due = (now - start).toSec() / factor;  // wall seconds since the start
    const auto left = [&] { return due - std::chrono::duration<double>(Clock::now() - wall_start).count(); };
    while (goesOn() && left() > 0.0)
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left(), kLongestSleep)));
  }
  if (pace_.getNumPublishers() > 0) waitForPace(now, kLeadSamples / drive.rate);
}

void SimulatorNodelet::waitForPace(ros::Time now, double lead) {
  const Clock::time_point asked = Clock::now();
  while (goesOn() && now.toSec() - paced_until_ > lead) {
    std::this_thread::sleep_for(kPoll);
    if (Clock::now() - asked < kPatience) continue;
    NODELET_WARN("%s sets no pace (is publish_every above %d?): the drive goes on for %g s", pace_.getTopic().c_str(),
                 kLeadSamples, lead);
    paced_until_ = now.toSec();
  }
}

void SimulatorNodelet::publish(const SimulatedInstant& instant) {
  if (clock_) {
    rosgraph_msgs::Clock clock;
    clock.clock = std::max(instant.time, ros::TIME_MIN);  // 0 means that there is no clock yet
    clock_->publish(clock);
  }
  for (const auto& [topic, any] : instant.messages) {
    const auto publish = [&, &publisher = publishers_.at(topic)](const auto& message) {
      publisher.publish(boost::make_shared<const std::decay_t<decltype(message)>>(message));
      if (recorder_) recorder_->record(publisher.getTopic(), instant.time, message);
    };
    std::visit(publish, any);
  }
}

}  // namespace suspension_health_monitor

PLUGINLIB_EXPORT_CLASS(suspension_health_monitor::SimulatorNodelet, nodelet::Nodelet)
