#include "monitor_thread.h"

#include <chrono>
#include <mutex>

namespace suspension_health_monitor {

constexpr std::chrono::microseconds kRest(500);
const ros::WallDuration kLongestWait(0.1);  // for a callback, before the thread looks whether it is to end

std::shared_ptr<MonitorThread> MonitorThread::ofThisProcess() {
  static std::mutex mutex;
  static std::weak_ptr<MonitorThread> shared;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<MonitorThread> thread = shared.lock();
  if (!thread) shared = thread = std::make_shared<MonitorThread>();
  return thread;
}

MonitorThread::~MonitorThread() {
  ends_ = true;
  queue_.disable();
  thread_.join();
}

void MonitorThread::loop() {
  while (!ends_) {
    queue_.callAvailable(kLongestWait);
    std::this_thread::sleep_for(kRest);
  }
}

}  // namespace suspension_health_monitor
