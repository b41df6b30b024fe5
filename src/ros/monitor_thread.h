#pragma once

#include <ros/callback_queue.h>
#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <future>
#include <memory>
#include <thread>
#include <type_traits>

namespace suspension_health_monitor {

/// One queue and one thread for the callbacks of all monitors of a process, so that none of them needs a lock.
///
/// The thread rests for half a millisecond after it has emptied the queue, and then takes what has come meanwhile. A
/// manager's own worker threads are woken for every single message, which at a rate of 1 kHz costs several times what
/// the monitor does with it.
class MonitorThread {
 public:
  /// @return that of this process; it ends with the last one who holds it.
  static std::shared_ptr<MonitorThread> ofThisProcess();

  MonitorThread() : thread_([this] { loop(); }) {}
  ~MonitorThread();

  /// @return whether no callback waits or runs: what was published in this process before has been taken in by all whom
  ///         this thread serves, and so has what they published in turn.
  bool isIdle() { return queue_.isEmpty(); }

  /// @return this node handle, with its callbacks coming from this thread.
  ros::NodeHandle serve(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    return node;
  }

  /// Has work done between two callbacks, and waits for its end. Not to be called by a callback.
  /// @return what the work returns or throws.
  template <class Work>
  auto run(const Work& work) {
    class Callback : public ros::CallbackInterface {
     public:
      explicit Callback(const Work& its) : task(its) {}
      CallResult call() override {
        task();
        return Success;
      }
      std::packaged_task<std::invoke_result_t<const Work&>()> task;
    };
    const auto callback = boost::make_shared<Callback>(work);
    auto result = callback->task.get_future();
    queue_.addCallback(callback);
    return result.get();
  }

 private:
  void loop();

  ros::CallbackQueue queue_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace suspension_health_monitor
