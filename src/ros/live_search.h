#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <suspension_health_monitor/Diagnose.h>
#include <suspension_health_monitor/DiagnoseVehicle.h>

#include <atomic>
#include <cstddef>
#include <mutex>

#include "monitor_host.h"

namespace suspension_health_monitor {

/// ~diagnose: a search by diagnoseVehicle() that takes seconds, beside a nodelet that must not wait for it.
///
/// The service has a queue and threads of its own. What it needs of the nodelet it has done by the thread that serves
/// the nodelet, so that nothing there needs a lock: a copy of the samples before, the taking of the result after the
/// search. One search at a time; another call meanwhile is answered at once that one is running.
/// @tparam Service  Diagnose: all struts are searched, and the answer is about one; or DiagnoseVehicle.
template <class Service>
class DiagnoseService {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;

  /// @param host  outlives this object.  @param strut  that Diagnose answers about.
  DiagnoseService(const ros::NodeHandle& private_node, MonitorHost& host, std::size_t strut = 0);
  DiagnoseService(const DiagnoseService&) = delete;
  DiagnoseService& operator=(const DiagnoseService&) = delete;

  /// Ends a search that runs; its caller gets an error.
  ~DiagnoseService() { stopping_ = true; }

 private:
  bool onDiagnose(Request& request, Response& response);
  Response answer(double window);
  void stopIfAsked() const;

  MonitorHost& host_;
  MonitorThread& thread_;
  std::size_t strut_;
  std::atomic<bool> stopping_{false};
  std::mutex searching_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  ros::ServiceServer server_;  // last, and so gone first: its end waits for calls that run, and they see stopping_
};

/// Gives the calling thread, and those that it starts, a low priority, so that on a busy machine the samples go first.
/// If it cannot be had, all works the same.
void beNice();

}  // namespace suspension_health_monitor
