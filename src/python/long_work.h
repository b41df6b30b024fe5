#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <functional>

namespace suspension_health_monitor {

namespace py = pybind11;

/// Long work that Python asked for: it runs without the interpreter's lock, tells a callback how much is done, and ends
/// with what the callback raises, or with KeyboardInterrupt. A few times a second, whatever the pace of the work.
class LongWork {
 public:
  /// @param progress  called with the share that is done, 0 .. 1, or None.
  explicit LongWork(py::object progress) : progress_(std::move(progress)) {}

  /// Runs the work; once it is done the callback is called with 1.
  template <class Work>
  auto run(const Work& work) {
    auto result = [&] {
      const py::gil_scoped_release released;
      return work();
    }();
    if (reported_ < 1.0) report(1.0);
    return result;
  }

  /// To be called from within run(), on its thread, as often as one likes.
  /// @throws py::error_already_set  to end the work.
  void update(double share) {
    if (!isDue(telling_due_) && share < 1.0) return;
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    report(share);
  }

  /// The same for work in many small steps: one of them costs nothing.
  void step(double share) {
    if (++steps_ % kSteps == 0) update(share);
  }

  /// The same without a callback.
  void step() {
    if (++steps_ % kSteps != 0 || !isDue(asking_due_)) return;
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

  std::function<void(double)> callback() {
    return [this](double share) { update(share); };
  }

 private:
  using Time = std::chrono::steady_clock::time_point;

  static bool isDue(Time& due) {
    const auto now = std::chrono::steady_clock::now();
    if (now < due) return false;
    due = now + kInterval;
    return true;
  }

  void report(double share) {
    reported_ = share;
    if (!progress_.is_none()) progress_(share);
  }

  static constexpr std::chrono::milliseconds kInterval{50};  // what a person waits for without noticing
  static constexpr unsigned kSteps = 256;                    // readings, of a microsecond each

  py::object progress_;
  unsigned steps_ = 0;
  double reported_ = 0.0;
  Time telling_due_{}, asking_due_{};
};

/// Adds a function work(given..., progress) of named arguments and of a callback.
/// @tparam Given  what it is given before the callback, by `names`.
template <class... Given, class Work, class... Names>
void defWork(py::module& module, const char* name, const Work& work, const Names&... names) {
  module.def(
      name,
      [work](const Given&... given, const py::object& progress) {
        LongWork long_work(progress);
        return long_work.run([&] { return work(given..., long_work); });
      },
      py::arg(names)..., py::arg("progress"));
}

}  // namespace suspension_health_monitor
