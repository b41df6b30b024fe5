#pragma once

#include <ros/callback_queue.h>
#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <functional>
#include <future>
#include <memory>
#include <thread>
#include <utility>

namespace suspension_health_monitor {

/// Has work done by the thread of a callback queue.
/// @param owner  identifies the work, should it be taken out again before it is done:
/// CallbackQueueInterface::removeByID()
///        makes its future throw std::future_error.
/// @return what the work returns or throws.
template <class Result>
std::future<Result> addWork(ros::CallbackQueueInterface& queue, std::function<Result()> work, std::uint64_t owner) {
  class Work : public ros::CallbackInterface {
   public:
    explicit Work(std::function<Result()> work) : task(std::move(work)) {}
    CallResult call() override {
      task();
      return Success;
    }
    std::packaged_task<Result()> task;
  };
  const auto item = boost::make_shared<Work>(std::move(work));
  std::future<Result> result = item->task.get_future();
  queue.addCallback(item, owner);
  return result;
}

/// One queue and one thread for the callbacks of all monitors of a process, so that none of them needs a lock.
///
/// The thread rests for half a millisecond after it has emptied the queue, and then takes what has come meanwhile. A
/// manager's own worker threads are woken for every single message, which at a rate of 1 kHz costs several times what
/// the monitor does with it.
class MonitorThread {
 public:
  /// @return that of this process; it ends with the last one who holds it.
  static std::shared_ptr<MonitorThread> ofThisProcess();

  MonitorThread();
  ~MonitorThread();
  MonitorThread(const MonitorThread&) = delete;
  MonitorThread& operator=(const MonitorThread&) = delete;

  ros::CallbackQueue& queue() { return queue_; }

  /// @return whether no callback waits or runs: what was published in this process before has been taken in by all whom
  ///         this thread serves, and so has what they published in turn.
  bool isIdle() { return queue_.isEmpty(); }

  /// @return this node handle, with its callbacks coming from this thread.
  ros::NodeHandle serve(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    return node;
  }

  /// Has work done between two callbacks, and waits for its end. Not to be called by a callback.
  /// @throws whatever the work throws.
  void run(std::function<void()> work);

 private:
  void loop();

  ros::CallbackQueue queue_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace suspension_health_monitor
