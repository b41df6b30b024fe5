#pragma once

#include <ros/callback_queue_interface.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <future>
#include <memory>
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

}  // namespace suspension_health_monitor
