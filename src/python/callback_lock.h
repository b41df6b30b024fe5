#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace suspension_health_monitor {

/// A monitor that calls back into Python and that one thread at a time may use. A thread that waits for it has released
/// the interpreter's lock, so that the thread inside can take that lock for its callback. The callback may ask, but not
/// push again.
template <class Monitor>
class Locked {
 public:
  template <class... Given>
  explicit Locked(Given&&... given) : monitor_(std::forward<Given>(given)...) {}

  /// @param question  a member of the monitor, or a function of it that returns at once.
  template <class Question>
  auto ask(const Question& question) const {
    const pybind11::gil_scoped_release released;
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    return std::invoke(question, monitor_);
  }

  /// Runs what calls back, without the interpreter's lock.
  /// @throws std::invalid_argument  from within a callback of it.
  template <class Work>
  void push(const Work& work) {
    const pybind11::gil_scoped_release released;
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (is_pushing_) throw std::invalid_argument("push() from within on_report, must be from outside");
    const std::unique_ptr<bool, void (*)(bool*)> busy(&is_pushing_, [](bool* flag) { *flag = false; });
    is_pushing_ = true;
    work(monitor_);
  }

 private:
  mutable std::recursive_mutex mutex_;
  bool is_pushing_ = false;
  Monitor monitor_;
};

}  // namespace suspension_health_monitor
