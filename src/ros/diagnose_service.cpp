#include "diagnose_service.h"

#include <suspension_health_monitor/Diagnose.h>
#include <suspension_health_monitor/DiagnoseVehicle.h>
#include <sys/resource.h>

#include <chrono>
#include <future>
#include <stdexcept>
#include <utility>

#include "live_search.h"
#include "monitor_thread.h"

namespace suspension_health_monitor {
namespace {

constexpr std::chrono::milliseconds kPoll{20};
constexpr std::uint32_t kThreads = 2;  // one for the search, one to refuse another call meanwhile
constexpr int kNiceness = 10;

/// Ends a search from within its progress report.
struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("the monitor is shutting down") {}
};

/// Sets a flag for as long as it lives.
class Running {
 public:
  explicit Running(std::atomic<bool>& flag) : flag_(flag), first_(!flag.exchange(true)) {}
  ~Running() {
    if (first_) flag_ = false;
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// false: somebody else holds the flag.
  bool first() const { return first_; }

 private:
  std::atomic<bool>& flag_;
  const bool first_;
};

void takeFiguresOff(DiagnoseResponse& response) { response = withoutFigures(); }
void takeFiguresOff(DiagnoseVehicleResponse&) {}  // it has none

}  // namespace

template <class Service>
DiagnoseService<Service>::DiagnoseService(const ros::NodeHandle& private_node,
                                          ros::CallbackQueueInterface& nodelet_queue, Prepare prepare)
    : nodelet_queue_(nodelet_queue), prepare_(std::move(prepare)), spinner_(kThreads, &queue_) {
  ros::NodeHandle node(private_node);
  node.setCallbackQueue(&queue_);
  server_ = node.advertiseService("diagnose", &DiagnoseService<Service>::onDiagnose, this);
  spinner_.start();
}

template <class Service>
DiagnoseService<Service>::~DiagnoseService() {
  stopping_ = true;
  server_.shutdown();  // waits for calls that run, and they see stopping_
  spinner_.stop();
  nodelet_queue_.removeByID(owner());
}

template <class Service>
bool DiagnoseService<Service>::onDiagnose(Request& request, Response& response) {
  const Running running(running_);
  takeFiguresOff(response);
  if (!running.first()) {
    response.message = "a search is running already: call again when it has ended";
    return true;
  }
  try {
    response = answer(request.window);
  } catch (const Stopped&) {
    return false;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

template <class Service>
typename Service::Response DiagnoseService<Service>::answer(double window) {
  // A low priority for this thread and those that it starts, so that on a busy machine the samples go first. If it
  // cannot be had, the search works all the same.
  setpriority(PRIO_PROCESS, 0, kNiceness);
  const Search search = inNodelet<Search>([prepare = prepare_, window] { return prepare(window); });
  Outcome outcome = search([this](double) { stopIfAsked(); });
  inNodelet<void>(std::move(outcome.take));
  return std::move(outcome.response);
}

// The work owns all that it touches, as nobody may wait for it any more when it is done.
template <class Service>
template <class Result>
Result DiagnoseService<Service>::inNodelet(std::function<Result()> work) {
  std::future<Result> result = addWork<Result>(nodelet_queue_, std::move(work), owner());
  while (result.wait_for(kPoll) != std::future_status::ready) stopIfAsked();
  return result.get();
}

template <class Service>
void DiagnoseService<Service>::stopIfAsked() const {
  if (stopping_ || !ros::ok() || ros::isShuttingDown()) throw Stopped();
}

template class DiagnoseService<Diagnose>;
template class DiagnoseService<DiagnoseVehicle>;

}  // namespace suspension_health_monitor
