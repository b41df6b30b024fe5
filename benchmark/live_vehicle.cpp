// The simulated sedan with its IMUs at 1 kHz on VehicleNodelet, all four struts: processor time of the nodelet manager,
// and the time from the message that completes an instant to the estimates that it brings at a subscriber. Needs a ROS
// master; scripts/benchmark_live runs it.
//   live_vehicle inside SECONDS IMUS    the IMUs' driver publishes within the manager: messages are handed on
//   live_vehicle network SECONDS IMUS   the driver is a process of its own: messages go over TCP
//   live_vehicle bare SECONDS IMUS      the same with empty callbacks instead of the nodelet: what ROS alone takes
// IMUS: 8, one at every strut's top and wheel; 5, one six-axis IMU on the body instead of those at the tops.
// Prints processor share [%], latency [ms] at the 50th, 99th and 99.9th percentile (not bare), number of estimates.
#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <suspension_health_monitor/ParameterEstimate.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "ros/monitor_thread.h"
#include "ros/simulated_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr int kRate = 1000;            // [Hz]
constexpr int kSettling = 20;          // [s] before anything is measured: until the ratios are known, with a margin
constexpr std::int64_t kStart = 1000;  // [s] stamp of the first sample
constexpr std::size_t kNumStruts = 4;

VehicleSimulationOptions simulation(int seconds, bool one_body_imu) {
  return VehicleSimulationOptions::fromValues("sedan", {{"rate", std::to_string(kRate)},
                                                        {"duration", std::to_string(kSettling + seconds)},
                                                        {"sprung_imus", one_body_imu ? "none" : "all"}});
}

/// The IMUs that the nodelet listens to.
std::vector<std::string> imuTopics(const VehicleSimulationOptions& options) {
  std::vector<std::string> topics;
  for (std::size_t i = 0; i < kNumStruts; ++i) {
    if (options.has_sprung_imu[i]) topics.push_back(sprungTopic(options.vehicle.struts[i]));
    topics.push_back(unsprungTopic(options.vehicle.struts[i]));
  }
  if (!options.has_sprung_imu[0]) topics.push_back(kBodyImuTopic);
  return topics;
}

double clockNow(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Publishes the IMUs in real time, and notes when estimates come.
class Driver {
 public:
  Driver(const VehicleSimulationOptions& options, bool wants_estimates)
      : instants_(simulate(options)), sent_(instants_.size()) {
    node_.setCallbackQueue(&queue_);
    for (const std::string& topic : imuTopics(options)) imus_.push_back(node_.advertise<sensor_msgs::Imu>(topic, 1000));
    for (std::size_t i = 0; wants_estimates && i < kNumStruts; ++i) {
      arrivals_[i].reserve(sent_.size());
      estimates_.push_back(node_.subscribe<ParameterEstimate>(
          options.vehicle.struts[i].name + "/la", 1000,
          [this, i](const ParameterEstimateConstPtr& la) { take(i, *la); }, nullptr,
          ros::TransportHints().tcpNoDelay()));
    }
    for (int i = 0; i < 1000 && !isConnected(); ++i) ros::WallDuration(0.01).sleep();
    if (!isConnected()) throw std::runtime_error("the nodelet is not there");
  }

  /// @return processor time of this process but this thread [s] for every second of it that is measured.
  double drive() {
    ros::AsyncSpinner spinner(1, &queue_);
    spinner.start();
    const auto others = [] { return clockNow(CLOCK_PROCESS_CPUTIME_ID) - clockNow(CLOCK_THREAD_CPUTIME_ID); };
    double before = 0.0;
    timespec next{};
    clock_gettime(CLOCK_MONOTONIC, &next);
    for (std::size_t k = 0; k < instants_.size(); ++k) {
      if (k == kSettling * kRate) before = others();
      next.tv_nsec += 1000000000 / kRate;
      if (next.tv_nsec >= 1000000000) {
        ++next.tv_sec;
        next.tv_nsec -= 1000000000;
      }
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr);
      for (std::size_t i = 0; i < imus_.size(); ++i) {
        sent_[k] = clockNow(CLOCK_MONOTONIC);
        imus_[i].publish(instants_[k][i]);
      }
    }
    const double seconds = static_cast<double>(instants_.size()) / kRate - kSettling;
    const double share = (others() - before) / seconds;
    ros::WallDuration(0.2).sleep();
    spinner.stop();
    return share;
  }

  /// Times [s] from the last message of the instant that brings an estimate to that estimate, in order of size. A
  /// vehicle's estimates are of instants some way back, always the same: that of those that come soonest.
  std::vector<double> latencies() const {
    std::vector<double> all;
    for (const std::vector<Arrival>& strut : arrivals_) {
      if (strut.empty()) throw std::runtime_error("no estimate came");
      std::size_t back = sent_.size();
      for (const Arrival& arrival : strut) back = std::min(back, newestAt(arrival.time) - arrival.index);
      for (const Arrival& arrival : strut) all.push_back(arrival.time - sent_[arrival.index + back]);
    }
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  struct Arrival {
    std::size_t index;  // of the instant that is estimated
    double time;
  };

  using Instant = std::vector<sensor_msgs::ImuConstPtr>;  // by imus_

  static std::vector<Instant> simulate(const VehicleSimulationOptions& options) {
    const std::vector<std::string> topics = imuTopics(options);
    const DriveSource source = driveOf(options).begin(std::chrono::seconds(kStart));
    std::vector<Instant> instants;
    while (const std::optional<SimulatedInstant> instant = source()) {
      Instant imus(topics.size());
      for (const auto& [topic, message] : instant->messages) {
        const auto found = std::find(topics.begin(), topics.end(), topic);
        if (found == topics.end()) continue;
        imus[static_cast<std::size_t>(found - topics.begin())] =
            boost::make_shared<sensor_msgs::Imu>(std::get<sensor_msgs::Imu>(message));
      }
      instants.push_back(std::move(imus));
    }
    return instants;
  }

  bool isConnected() const {
    return std::all_of(imus_.begin(), imus_.end(), [](const auto& imu) { return imu.getNumSubscribers() > 0; }) &&
           std::all_of(estimates_.begin(), estimates_.end(), [](const auto& la) { return la.getNumPublishers() > 0; });
  }

  std::size_t newestAt(double time) const {
    const auto after = std::upper_bound(sent_.begin(), sent_.end(), time);
    return static_cast<std::size_t>(after - sent_.begin()) - 1;
  }

  void take(std::size_t strut, const ParameterEstimate& la) {
    const double time = clockNow(CLOCK_MONOTONIC);
    const double t = static_cast<double>(la.header.stamp.sec - kStart) + 1e-9 * la.header.stamp.nsec;
    if (t > kSettling) arrivals_[strut].push_back({static_cast<std::size_t>(std::lround(t * kRate)), time});
  }

  std::vector<Instant> instants_;
  std::vector<double> sent_;  // by instant; read when the drive is over
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::vector<ros::Publisher> imus_;
  std::vector<ros::Subscriber> estimates_;
  std::array<std::vector<Arrival>, kNumStruts> arrivals_;
};

void print(const std::vector<double>& latencies) {
  const auto percentile = [&](double p) {
    return 1e3 * latencies[static_cast<std::size_t>(p * static_cast<double>(latencies.size() - 1))];
  };
  std::printf(" %.3f %.3f %.3f %zu", percentile(0.5), percentile(0.99), percentile(0.999), latencies.size());
}

void load(nodelet::Loader& loader, const VehicleSimulationOptions& options) {
  const std::string name = "/vehicle", vehicle = name + "/vehicle/";
  ros::param::del(name);  // of a run before
  ros::param::set(name + "/sample_period", 1.0 / kRate);
  const VehicleImu& imu = options.vehicle.body_imu;
  if (!options.has_sprung_imu[0]) ros::param::set(vehicle + "body_imu", kBodyImuTopic);
  for (std::size_t i = 0; i < kNumStruts; ++i) {
    const VehicleStrut& strut = options.vehicle.struts[i];
    const std::string settings = vehicle + "struts/" + strut.name + '/';
    if (options.has_sprung_imu[i])
      ros::param::set(settings + "sprung_imu", sprungTopic(strut));
    else
      ros::param::set(settings + "position", std::vector<double>{strut.x - imu.x, strut.y - imu.y, strut.z - imu.z});
    ros::param::set(settings + "unsprung_imu", unsprungTopic(strut));
  }
  if (!loader.load(name, "suspension_health_monitor/VehicleNodelet", {}, {}))
    throw std::runtime_error("cannot load the nodelet");
}

/// What ROS itself takes to bring the messages to a node.
std::vector<ros::Subscriber> listen(ros::NodeHandle node, const VehicleSimulationOptions& options) {
  std::vector<ros::Subscriber> subscribers;
  for (const std::string& topic : imuTopics(options))
    subscribers.push_back(node.subscribe<sensor_msgs::Imu>(
        topic, 1000, [](const sensor_msgs::ImuConstPtr&) {}, nullptr, ros::TransportHints().tcpNoDelay()));
  return subscribers;
}

void driveInside(const VehicleSimulationOptions& options) {
  Driver driver(options, true);
  std::printf("%.2f", 100.0 * driver.drive());
  print(driver.latencies());
}

// The share is that of the driver's last seconds.
void driveOutside(char** argv, int seconds, const char* mode) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    execl(argv[0], argv[0], mode, argv[2], argv[3], nullptr);
    _exit(127);
  }
  std::vector<double> processor_times;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    processor_times.push_back(clockNow(CLOCK_PROCESS_CPUTIME_ID));
    ros::WallDuration(1.0).sleep();
  }
  if (status != 0 || processor_times.size() < 4) throw std::runtime_error("the driver failed");
  const std::size_t last = processor_times.size() - 2, first = last - std::min<std::size_t>(last, seconds - 1);
  std::printf(" %.2f ", 100.0 * (processor_times[last] - processor_times[first]) / static_cast<double>(last - first));
}

void run(const std::string& mode, char** argv, int seconds, bool one_body_imu) {
  const VehicleSimulationOptions options = simulation(seconds, one_body_imu);
  if (mode == "drive" || mode == "drive_bare") {
    Driver driver(options, mode == "drive");
    driver.drive();
    if (mode == "drive") print(driver.latencies());
    return;
  }
  ros::AsyncSpinner spinner(1);
  spinner.start();
  if (mode == "bare") {
    const auto thread = MonitorThread::ofThisProcess();
    const std::vector<ros::Subscriber> subscribers = listen(thread->serve(ros::NodeHandle()), options);
    driveOutside(argv, seconds, "drive_bare");
    return;
  }
  nodelet::Loader loader(false);
  load(loader, options);
  if (mode == "inside")
    driveInside(options);
  else
    driveOutside(argv, seconds, "drive");
  loader.clear();
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  const std::string mode = argc == 4 ? argv[1] : "";
  const int seconds = argc == 4 ? std::atoi(argv[2]) : 0;
  const std::string imus = argc == 4 ? argv[3] : "";
  if (seconds < 2 || (imus != "8" && imus != "5")) {
    std::fprintf(stderr, "usage: live_vehicle inside|network|bare SECONDS 8|5      SECONDS from 2\n");
    return 2;
  }
  ros::init(argc, argv, "live_vehicle_" + mode);
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Warn);  // standard output is the result
  try {
    run(mode, argv, seconds, imus == "5");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "live_vehicle: %s\n", error.what());
    return 1;
  }
  std::printf("\n");
  return 0;
}
