#include <memory>
#include <mutex>
#include <stdexcept>

#include "bindings.h"
#include "options.h"
#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"
#include "suspension_health_monitor/strut_monitor.h"

namespace suspension_health_monitor {
namespace {

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
    const py::gil_scoped_release released;
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    return std::invoke(question, monitor_);
  }

  /// Runs what calls back, without the interpreter's lock.
  /// @throws std::invalid_argument  from within a callback of it.
  template <class Work>
  void push(const Work& work) {
    const py::gil_scoped_release released;
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

using LockedMonitor = Locked<StrutMonitor>;

/// @param on_report  outlives what is returned.
/// @return what calls it after every n-th sample.
StrutMonitor::Sink sinkFor(py::handle on_report, int every) {
  if (on_report.is_none()) return {};
  return [on_report, every, samples = std::uint64_t{0}](const MonitorReport& report) mutable {
    if (samples++ % static_cast<std::uint64_t>(every) != 0) return;
    const py::gil_scoped_acquire held;
    on_report(report);
  };
}

void push(LockedMonitor& self, const Recording& readings) {
  LongWork interruption{py::none()};
  self.push([&](StrutMonitor& monitor) {
    readings.forEach([&](Side side, Stamp stamp, double value) {
      monitor.push(side, stamp, value);
      interruption.step();
    });
  });
}

template <class Monitor, class Answer>
auto asking(Answer (Monitor::*question)() const) {
  return [question](const Locked<Monitor>& self) { return self.ask(question); };
}

using Position = std::array<double, 3>;

/// A vehicle whose struts have sensors numbered as VehicleStreams numbers them.
VehicleLayout layoutOf(const std::vector<std::pair<std::string, std::optional<Position>>>& struts) {
  VehicleLayout layout;
  layout.body_imu = "body";
  for (const auto& [name, position] : struts) {
    VehicleLayout::Strut& strut = layout.struts.emplace_back();
    strut.name = name;
    strut.unsprung_imu = name + "/wheel";
    strut.position = position;
    if (!position) strut.sprung_imu = name + "/body";
  }
  return layout;
}

/// VehicleMonitor of arrays.
class ArrayVehicle {
 public:
  ArrayVehicle(const std::vector<std::pair<std::string, std::optional<Position>>>& struts,
               const MonitorOptions& options)
      : streams_(layoutOf(struts)),
        pipeline_(std::vector<MonitorSettings>(struts.size(), MonitorSettings(options)), streams_, {}) {}

  /// @param body  (n, 6) of the body's IMU, or (n, struts).  @param wheel  (n, struts).
  void push(const py::array_t<std::int64_t>& stamps, const py::array_t<double>& body, const py::array_t<double>& wheel,
            LongWork& interruption) {
    const auto top = body.unchecked<2>(), carrier = wheel.unchecked<2>();
    for (Py_ssize_t k = 0; k < stamps.size(); ++k) {
      const Stamp stamp(stamps.data()[k]);
      Py_ssize_t of_body = 0, of_wheel = 0;
      for (std::size_t i = 0; i < streams_.sensors.size(); ++i) {
        const VehicleStreams::Place place = streams_.sensors[i].place;
        values_.clear();
        if (place == VehicleStreams::Place::kBody)
          while (of_body < 6) values_.push_back(top(k, of_body++));
        else
          values_.push_back(place == VehicleStreams::Place::kSprung ? top(k, of_body++) : carrier(k, of_wheel++));
        pipeline_.push(i, stamp, values_.data());
      }
      interruption.step();
    }
  }

  bool isCoupled() const { return pipeline_.monitor()->isCoupled(); }

  std::vector<MonitorReport> reports() const {
    std::vector<MonitorReport> reports(streams_.channels.struts.size());
    for (std::size_t i = 0; i < reports.size(); ++i)
      if (const SuspensionMonitor* strut = pipeline_.strut(i)) reports[i] = strut->report();
    return reports;
  }

 private:
  VehicleStreams streams_;
  std::vector<double> values_;
  VehiclePipeline pipeline_;
};

using LockedVehicle = Locked<ArrayVehicle>;

}  // namespace

void bindMonitors(py::module& module) {
  py::class_<LockedMonitor>(module, "StrutMonitor")
      .def(py::init([](const OptionMap& keywords, bool tyre, const py::object& on_report, int every) {
             if (every < 1) throw std::invalid_argument("every = " + std::to_string(every) + ", must be 1 or more");
             MonitorOptions options = arrayOptions(keywords).monitor;
             options.tyre = tyre;
             return std::make_unique<LockedMonitor>(options, sinkFor(on_report, every));
           }),
           py::arg("keywords"), py::arg("tyre"), py::arg("on_report"), py::arg("every"), py::keep_alive<1, 4>())
      .def("push", &push, py::arg("readings"))
      .def("set_model",
           [](LockedMonitor& self, const std::optional<StrutModel>& model) {
             self.push([&](StrutMonitor& monitor) {
               if (model)
                 monitor.setEffects(model->effects, model->linearPart());
               else
                 monitor.setEffects({});
             });
           })
      .def("set_baseline",
           [](LockedMonitor& self, const Baseline& baseline) {
             self.push([&](StrutMonitor& monitor) { monitor.setBaseline(baseline); });
           })
      .def_property_readonly("report", asking(&StrutMonitor::report))
      .def_property_readonly("baseline", asking(&StrutMonitor::baseline))
      .def_property_readonly("tyre", asking(&StrutMonitor::tyre))
      .def_property_readonly("input", asking(&StrutMonitor::input))
      .def_property_readonly("rejected", asking(&StrutMonitor::rejected))
      .def_property_readonly("sample_period", asking(&StrutMonitor::samplePeriod));
  py::class_<LockedVehicle>(module, "VehicleMonitor")
      .def(py::init([](const std::vector<std::pair<std::string, std::optional<Position>>>& struts,
                       const OptionMap& keywords) {
             const MonitorOptions options = arrayOptions(keywords).monitor;
             if (!options.sample_period)
               throw std::invalid_argument("sample_period is missing, must be given: all sensors share it");
             return std::make_unique<LockedVehicle>(struts, options);
           }),
           py::arg("struts"), py::arg("keywords"))
      .def(
          "push",
          [](LockedVehicle& self, const py::array_t<std::int64_t>& stamps, const py::array_t<double>& body,
             const py::array_t<double>& wheel) {
            LongWork interruption{py::none()};
            self.push([&](ArrayVehicle& vehicle) { vehicle.push(stamps, body, wheel, interruption); });
          },
          py::arg("stamps"), py::arg("body"), py::arg("wheel"))
      .def_property_readonly("is_coupled", asking(&ArrayVehicle::isCoupled))
      .def_property_readonly("reports", asking(&ArrayVehicle::reports));
}

}  // namespace suspension_health_monitor
