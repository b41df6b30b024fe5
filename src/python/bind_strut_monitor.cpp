#include "bindings.h"
#include "callback_lock.h"
#include "options.h"
#include "readings.h"
#include "suspension_health_monitor/internal/every_n.h"
#include "suspension_health_monitor/strut_monitor.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

/// StrutMonitor for threads of Python, with a callback after every n-th sample.
class LockedMonitor {
 public:
  LockedMonitor(const MonitorOptions& options, py::object on_report, int every)
      : on_report_(std::move(on_report)),
        due_(every),
        monitor_(
            options,
            on_report_.is_none() ? StrutMonitor::Sink() : [this](const MonitorReport& report) { tell(report); }) {}

  void push(const Recording& readings) {
    LongWork interruption{py::none()};
    lock_.push([&] {
      readings.forEach([&](Side side, Stamp stamp, double value) {
        monitor_.push(side, stamp, value);
        interruption.step();
      });
    });
  }

  template <class Question>
  auto ask(const Question& question) const {
    return lock_.ask([&] { return question(monitor_); });
  }

  template <class Change>
  void change(const Change& change) {
    lock_.push([&] { change(monitor_); });
  }

 private:
  void tell(const MonitorReport& report) {
    if (!due_()) return;
    const py::gil_scoped_acquire held;
    on_report_(report);
  }

  py::object on_report_;
  EveryN due_;
  CallbackLock lock_;
  StrutMonitor monitor_;
};

template <class Answer>
auto asking(Answer (StrutMonitor::*question)() const) {
  return [question](const LockedMonitor& self) {
    return self.ask([&](const StrutMonitor& monitor) { return (monitor.*question)(); });
  };
}

}  // namespace

void bindStrutMonitor(py::module& module) {
  py::class_<LockedMonitor>(module, "StrutMonitor")
      .def(py::init([](const Keywords& keywords, bool tyre, const py::object& on_report, int every) {
             if (every < 1) throw std::invalid_argument("every = " + std::to_string(every) + ", must be 1 or more");
             MonitorOptions options = ArrayOptions::from(keywords.values).monitor;
             options.tyre = options.tyre || tyre;
             return std::make_unique<LockedMonitor>(options, on_report, every);
           }),
           py::arg("keywords"), py::arg("tyre"), py::arg("on_report"), py::arg("every"))
      .def("push", &LockedMonitor::push, py::arg("readings"))
      .def("set_model",
           [](LockedMonitor& self, const std::optional<StrutModel>& model) {
             self.change([&](StrutMonitor& monitor) {
               monitor.setEffects(model ? model->effects : std::vector<ActiveEffect>{});
             });
           })
      .def("set_baseline",
           [](LockedMonitor& self, const Baseline& baseline) {
             self.change([&](StrutMonitor& monitor) { monitor.setBaseline(baseline); });
           })
      .def_property_readonly("report", asking(&StrutMonitor::report))
      .def_property_readonly("baseline", asking(&StrutMonitor::baseline))
      .def_property_readonly("tyre", asking(&StrutMonitor::tyre))
      .def_property_readonly("input", asking(&StrutMonitor::input))
      .def_property_readonly("rejected", asking(&StrutMonitor::rejected))
      .def_property_readonly("sample_period", asking(&StrutMonitor::samplePeriod));
}

}  // namespace suspension_health_monitor
