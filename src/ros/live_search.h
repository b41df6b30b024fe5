#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <suspension_health_monitor/Diagnose.h>
#include <suspension_health_monitor/DiagnoseVehicle.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "monitor_thread.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// Called every now and then with the share of a search that is done, 0 .. 1; what it throws ends the search.
using SearchProgress = std::function<void(double share)>;

/// ~diagnose: a search that takes seconds, beside a nodelet that must not wait for it.
///
/// The service has a queue and threads of its own. What it needs of the nodelet it has done by the thread that serves
/// the nodelet, so that nothing there needs a lock: a copy of the samples before, the taking of the result after the
/// search. One search at a time; another call meanwhile is answered at once that one is running.
/// @tparam Service  Diagnose or DiagnoseVehicle: its request has the window, its response success and message.
template <class Service>
class DiagnoseService {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;

  struct Outcome {
    Response response;
    std::function<void()> take;  ///< what the nodelet does with the result, called in its thread
  };
  /// The search, called beside the nodelet; it owns all that it touches.
  /// @throws std::exception  whose words are the answer, or what `progress` threw.
  using Search = std::function<Outcome(const SearchProgress& progress)>;

  /// Called in the nodelet's thread, to give the search what it works on.
  /// @param window  [s], 0: everything.  @throws std::exception  whose words are the answer: there is nothing yet.
  using Prepare = std::function<Search(double window)>;

  /// @param nodelet_thread  that serves the nodelet; outlives this object.
  DiagnoseService(const ros::NodeHandle& private_node, MonitorThread& nodelet_thread, Prepare prepare);

  /// Ends a search that runs; its caller gets an error.
  ~DiagnoseService();
  DiagnoseService(const DiagnoseService&) = delete;
  DiagnoseService& operator=(const DiagnoseService&) = delete;

 private:
  bool onDiagnose(Request& request, Response& response);
  Response answer(double window);
  void stopIfAsked() const;

  MonitorThread& nodelet_thread_;
  Prepare prepare_;
  std::atomic<bool> stopping_{false};
  std::mutex searching_;
  ros::CallbackQueue queue_;
  ros::ServiceServer server_;
  ros::AsyncSpinner spinner_;
};

/// What a live search works on.
struct SearchTask {
  VehicleDrive drive;
  std::vector<std::string> struts;  ///< names; that of a strut alone is empty
  DiagnoseOptions options;
};

/// What is done with the result in the nodelet's thread.
using TakeDiagnosis = std::function<void(const VehicleDiagnosis&)>;

/// Gives the calling thread, and those that it starts, a low priority, so that on a busy machine the samples go first.
/// If it cannot be had, all works the same.
void beNice();

/// @param window  [s] as asked for, 0: everything.  @param kept  [s] diagnose_window.
/// @return how far back to look [s].
/// @throws std::invalid_argument  naming the window and what is allowed.
double searchSpan(double window, double kept);

/// diagnoseVehicle() as the work of a vehicle's ~diagnose.
DiagnoseService<DiagnoseVehicle>::Search searchOf(SearchTask task, TakeDiagnosis take);

/// The same as the work of a strut's own ~diagnose: all struts are searched, and the answer is about this one.
DiagnoseService<Diagnose>::Search searchOf(SearchTask task, std::size_t strut, TakeDiagnosis take);

}  // namespace suspension_health_monitor
