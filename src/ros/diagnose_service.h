#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <functional>

namespace suspension_health_monitor {

/// Told every now and then how much of a search is done, 0 .. 1; what it throws ends the search.
using SearchProgress = std::function<void(double share)>;

/// ~diagnose: a search that takes seconds, beside a nodelet that must not wait for it.
///
/// The service has a queue and threads of its own. What it needs of the nodelet it asks for through the nodelet's own
/// queue, so that nothing there needs a lock: a copy of the samples before, the taking of the result after the search.
/// One search at a time; another call meanwhile is answered at once that one is running.
/// @tparam Service  Diagnose or DiagnoseVehicle: its request has the window, its response success and message.
template <class Service>
class DiagnoseService {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;

  struct Outcome {
    Response response;
    std::function<void()> take;  ///< what the nodelet does with the result, called in its own queue
  };
  /// The search, called beside the nodelet; it owns all that it touches.
  /// @throws std::exception  whose words are the answer, or what `progress` threw.
  using Search = std::function<Outcome(const SearchProgress& progress)>;

  /// Called in the nodelet's own queue, to give the search what it works on.
  /// @param window  [s], 0: everything.  @throws std::exception  whose words are the answer: there is nothing yet.
  using Prepare = std::function<Search(double window)>;

  /// @param nodelet_queue  where the nodelet's callbacks come from; outlives this object.
  DiagnoseService(const ros::NodeHandle& private_node, ros::CallbackQueueInterface& nodelet_queue, Prepare prepare);

  /// Ends a search that runs; its caller gets an error.
  ~DiagnoseService();
  DiagnoseService(const DiagnoseService&) = delete;
  DiagnoseService& operator=(const DiagnoseService&) = delete;

 private:
  bool onDiagnose(Request& request, Response& response);
  Response answer(double window);
  template <class Result>
  Result inNodelet(std::function<Result()> work);
  void stopIfAsked() const;
  std::uint64_t owner() const { return reinterpret_cast<std::uint64_t>(this); }

  ros::CallbackQueueInterface& nodelet_queue_;
  Prepare prepare_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> running_{false};
  ros::CallbackQueue queue_;
  ros::ServiceServer server_;
  ros::AsyncSpinner spinner_;
};

}  // namespace suspension_health_monitor
