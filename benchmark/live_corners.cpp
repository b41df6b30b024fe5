// Four monitors in one nodelet manager, IMUs at 1 kHz: processor time of the manager, and the time from the message
// that completes a sample to the estimate of that sample at a subscriber. Needs a ROS master; scripts/benchmark_live
// runs it.
//   live_corners inside SECONDS TOPICS    the IMUs' driver publishes within the manager: messages are handed on
//   live_corners network SECONDS TOPICS   the driver is a process of its own: messages go over TCP
//   live_corners bare SECONDS TOPICS      the same with empty callbacks instead of monitors: what ROS alone takes
// TOPICS: 8, each corner has a body IMU of its own; 5, they share one.
// Prints processor share [%], latency [ms] at the 50th, 99th and 99.9th percentile (not bare), number of estimates.
#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <suspension_health_monitor/ParameterEstimate.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "ros/monitor_thread.h"

namespace suspension_health_monitor {
namespace {

constexpr std::array<const char*, 4> kCorners{"front_left", "front_right", "rear_left", "rear_right"};
constexpr int kRate = 1000;            // [Hz]
constexpr double kSettling = 3.0;      // [s] before anything is measured: connections, filters that fill
constexpr std::int64_t kStart = 1000;  // [s] stamp of the first sample

std::string sprungTopic(std::size_t corner, bool shared) {
  return shared ? "/body" : std::string("/") + kCorners[corner] + "/sprung";
}

std::string unsprungTopic(std::size_t corner) { return std::string("/") + kCorners[corner] + "/unsprung"; }

double seconds(const timespec& time) {
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double clockNow(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return seconds(now);
}

/// Publishes the IMUs of all corners at 1 kHz, and notes when the estimates of their samples come.
class Driver {
 public:
  Driver(int samples, bool shared, bool wants_estimates) : sent_(static_cast<std::size_t>(samples)) {
    node_.setCallbackQueue(&queue_);
    for (std::size_t i = 0; i < kCorners.size(); ++i) {
      if (i == 0 || !shared) bodies_.push_back(node_.advertise<sensor_msgs::Imu>(sprungTopic(i, shared), 1000));
      wheels_.push_back(node_.advertise<sensor_msgs::Imu>(unsprungTopic(i), 1000));
      if (!wants_estimates) continue;
      latencies_[i].reserve(sent_.size());
      const std::string corner = kCorners[i];
      estimates_.push_back(node_.subscribe<ParameterEstimate>(
          "/" + corner + "/la", 1000, [this, i](const ParameterEstimateConstPtr& la) { take(i, *la); }, nullptr,
          ros::TransportHints().tcpNoDelay()));
    }
    for (int i = 0; i < 1000 && !isConnected(); ++i) ros::WallDuration(0.01).sleep();
    if (!isConnected()) throw std::runtime_error("the monitors are not there");
  }

  void drive() {
    ros::AsyncSpinner spinner(1, &queue_);
    spinner.start();
    timespec next{};
    clock_gettime(CLOCK_MONOTONIC, &next);
    for (std::size_t k = 0; k < sent_.size(); ++k) {
      next.tv_nsec += 1000000000 / kRate;
      if (next.tv_nsec >= 1000000000) {
        ++next.tv_sec;
        next.tv_nsec -= 1000000000;
      }
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr);
      publish(k);
    }
    ros::WallDuration(0.2).sleep();
    processor_time_ = clockNow(CLOCK_THREAD_CPUTIME_ID);
  }

  /// All latencies [s] in order of size.
  std::vector<double> latencies() const {
    std::vector<double> all;
    for (const std::vector<double>& corner : latencies_) all.insert(all.end(), corner.begin(), corner.end());
    std::sort(all.begin(), all.end());
    return all;
  }

  double processorTime() const { return processor_time_; }  ///< of the publishing thread [s]

 private:
  bool isConnected() const {
    const auto is_heard = [](const auto& imu) { return imu.getNumSubscribers() > 0; };
    return std::all_of(bodies_.begin(), bodies_.end(), is_heard) &&
           std::all_of(wheels_.begin(), wheels_.end(), is_heard) &&
           std::all_of(estimates_.begin(), estimates_.end(), [](const auto& la) { return la.getNumPublishers() > 0; });
  }

  void publish(std::size_t k) {
    const double t = static_cast<double>(k) / kRate;
    const auto send = [&](const ros::Publisher& publisher, std::size_t number, double acceleration) {
      const auto imu = boost::make_shared<sensor_msgs::Imu>();
      imu->header.stamp = ros::Time(kStart) + ros::Duration(t);
      imu->linear_acceleration.z = 9.81 + acceleration + 0.01 * static_cast<double>((k * 7919 + number) % 101);
      publisher.publish(sensor_msgs::ImuConstPtr(imu));
    };
    for (std::size_t i = 0; i < bodies_.size(); ++i) send(bodies_[i], i, std::sin(7.0 * t));
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      sent_[k][i] = clockNow(CLOCK_MONOTONIC);
      send(wheels_[i], 4 + i, 3.0 * std::sin(9.0 * t + 0.3));
    }
  }

  void take(std::size_t corner, const ParameterEstimate& la) {
    const double now = clockNow(CLOCK_MONOTONIC);
    const double t = static_cast<double>(la.header.stamp.sec - kStart) + 1e-9 * la.header.stamp.nsec;
    const auto k = static_cast<std::size_t>(std::lround(t * kRate));
    if (t < kSettling || k >= sent_.size()) return;
    latencies_[corner].push_back(now - sent_[k][corner].load());
  }

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::vector<ros::Publisher> bodies_, wheels_;
  std::vector<ros::Subscriber> estimates_;
  std::vector<std::array<std::atomic<double>, 4>> sent_;
  std::array<std::vector<double>, 4> latencies_;
  double processor_time_ = 0.0;
};

void print(const std::vector<double>& latencies) {
  if (latencies.empty()) throw std::runtime_error("no estimate came");
  const auto percentile = [&](double p) {
    return 1e3 * latencies[static_cast<std::size_t>(p * static_cast<double>(latencies.size() - 1))];
  };
  std::printf(" %.3f %.3f %.3f %zu", percentile(0.5), percentile(0.99), percentile(0.999), latencies.size());
}

void load(nodelet::Loader& loader, bool shared) {
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const std::string name = std::string("/") + kCorners[i];
    ros::param::set(name + "/sample_period", 1.0 / kRate);
    const nodelet::M_string remappings{{"/sprung/imu", sprungTopic(i, shared)}, {"/unsprung/imu", unsprungTopic(i)}};
    if (!loader.load(name, "suspension_health_monitor/MonitorNodelet", remappings, {}))
      throw std::runtime_error("cannot load the monitor " + name);
  }
}

/// What ROS itself takes to bring the messages to four nodes.
std::vector<ros::Subscriber> listen(ros::CallbackQueue& queue, bool shared) {
  std::vector<ros::Subscriber> subscribers;
  for (std::size_t i = 0; i < kCorners.size(); ++i)
    for (const std::string& topic : {sprungTopic(i, shared), unsprungTopic(i)}) {
      ros::NodeHandle node;
      node.setCallbackQueue(&queue);
      subscribers.push_back(node.subscribe<sensor_msgs::Imu>(
          topic, 1000, [](const sensor_msgs::ImuConstPtr&) {}, nullptr, ros::TransportHints().tcpNoDelay()));
    }
  return subscribers;
}

double processorTime() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto inSeconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return inSeconds(usage.ru_utime) + inSeconds(usage.ru_stime);
}

void driveInside(int samples, bool shared) {
  Driver driver(samples, shared, true);
  const double before = processorTime();
  std::thread thread([&] { driver.drive(); });
  thread.join();
  std::printf("%.2f", 100.0 * (processorTime() - before - driver.processorTime()) * kRate / samples);
  print(driver.latencies());
}

void driveOutside(char** argv, int samples, const char* mode) {
  const double before = processorTime();
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    execl(argv[0], argv[0], mode, argv[2], argv[3], nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) throw std::runtime_error("the driver failed");
  std::printf(" %.2f", 100.0 * (processorTime() - before) * kRate / samples);
}

void run(const std::string& mode, char** argv, int samples, bool shared) {
  if (mode == "drive" || mode == "drive_bare") {
    Driver driver(samples, shared, mode == "drive");
    driver.drive();
    if (mode == "drive") print(driver.latencies());
    return;
  }
  ros::AsyncSpinner spinner(1);
  spinner.start();
  if (mode == "bare") {
    const auto thread = MonitorThread::ofThisProcess();
    const std::vector<ros::Subscriber> subscribers = listen(thread->queue(), shared);
    driveOutside(argv, samples, "drive_bare");
    return;
  }
  nodelet::Loader loader(false);
  load(loader, shared);
  if (mode == "inside")
    driveInside(samples, shared);
  else
    driveOutside(argv, samples, "drive");
  loader.clear();
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  const std::string mode = argc == 4 ? argv[1] : "";
  const int samples = argc == 4 ? kRate * std::atoi(argv[2]) : 0;
  const std::string topics = argc == 4 ? argv[3] : "";
  if (samples <= kSettling * kRate || (topics != "8" && topics != "5")) {
    std::fprintf(stderr, "usage: live_corners inside|network|bare SECONDS 8|5      SECONDS above %g\n", kSettling);
    return 2;
  }
  ros::init(argc, argv, "live_corners_" + mode);
  try {
    run(mode, argv, samples, topics == "5");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "live_corners: %s\n", error.what());
    return 1;
  }
  std::printf("\n");
  return 0;
}
