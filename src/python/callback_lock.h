#pragma once

#include <pybind11/pybind11.h>

#include <mutex>
#include <stdexcept>

namespace suspension_health_monitor {

/// Lets one thread at a time at something that calls back into Python: who waits for it has let the interpreter's lock
/// go, so that the callback of the one inside can have it. The callback may ask, but not push again.
class CallbackLock {
 public:
  /// Runs what asks, and is over at once.
  template <class Question>
  auto ask(const Question& question) const {
    const pybind11::gil_scoped_release released;
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    return question();
  }

  /// Runs what calls back, without the interpreter's lock.
  /// @throws std::invalid_argument  from within a callback of it.
  template <class Work>
  void push(const Work& work) {
    const pybind11::gil_scoped_release released;
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (is_pushing_) throw std::invalid_argument("push() from within on_report, must be from outside");
    const Busy busy(is_pushing_);
    work();
  }

 private:
  struct Busy {
    explicit Busy(bool& its_flag) : flag(its_flag) { flag = true; }
    ~Busy() { flag = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    bool& flag;
  };

  mutable std::recursive_mutex mutex_;
  bool is_pushing_ = false;
};

}  // namespace suspension_health_monitor
