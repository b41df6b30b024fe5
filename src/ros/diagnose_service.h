#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <suspension_health_monitor/Diagnose.h>

#include <atomic>
#include <functional>

#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {

/// What a live search works on.
struct SearchTask {
  Drive drive;
  DiagnoseOptions options;
};

/// ~diagnose: a search that takes seconds, beside a nodelet that must not wait for it.
///
/// The service has a queue and threads of its own. What it needs of the nodelet it asks for through the nodelet's own
/// queue, so that nothing there needs a lock: a copy of the samples before, the taking of the result after the search.
/// One search at a time; another call meanwhile is answered at once that one is running.
class DiagnoseService {
 public:
  /// The nodelet's side; each is called in the nodelet's own queue.
  struct Nodelet {
    /// @param window  [s], 0: everything.  @throws std::exception  whose words are the answer: there is nothing yet.
    std::function<SearchTask(double window)> give;
    std::function<void(const Diagnosis& diagnosis)> take;
  };

  /// @param nodelet_queue  where the nodelet's callbacks come from; outlives this object.
  DiagnoseService(const ros::NodeHandle& private_node, ros::CallbackQueueInterface& nodelet_queue, Nodelet nodelet);

  /// Ends a search that runs; its caller gets an error.
  ~DiagnoseService();
  DiagnoseService(const DiagnoseService&) = delete;
  DiagnoseService& operator=(const DiagnoseService&) = delete;

 private:
  bool onDiagnose(DiagnoseRequest& request, DiagnoseResponse& response);
  DiagnoseResponse answer(double window);
  template <class Result>
  Result inNodelet(std::function<Result()> work);
  void stopIfAsked() const;
  std::uint64_t owner() const { return reinterpret_cast<std::uint64_t>(this); }

  ros::CallbackQueueInterface& nodelet_queue_;
  Nodelet nodelet_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> running_{false};
  ros::CallbackQueue queue_;
  ros::ServiceServer server_;
  ros::AsyncSpinner spinner_;
};

}  // namespace suspension_health_monitor
