#include <stdexcept>

#include "bindings.h"
#include "callback_lock.h"
#include "options.h"
#include "readings.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

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

/// VehicleMonitor of arrays, for threads of Python.
class LockedVehicle {
 public:
  LockedVehicle(const std::vector<std::pair<std::string, std::optional<Position>>>& struts,
                const MonitorOptions& options)
      : streams_(layoutOf(struts)),
        grid_(
            *options.sample_period, streams_, MonitorSettings(options).grid(*options.sample_period),
            [this](const VehicleSample& sample) { monitor_.addGridSample(sample); },
            [this](const VehicleReading& reading) { monitor_.addReading(grid_.tops(), reading); }),
        monitor_(std::vector<MonitorSettings>(struts.size(), MonitorSettings(options)),
                 [](std::size_t, const MonitorReport&) {}) {}

  /// @param body  (n, 6) of the body's IMU, or (n, struts).  @param wheel  (n, struts).
  void push(const py::array_t<std::int64_t>& stamps, const py::array_t<double>& body,
            const py::array_t<double>& wheel) {
    const auto top = body.unchecked<2>(), carrier = wheel.unchecked<2>();
    LongWork interruption{py::none()};
    lock_.push([&] {
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
          grid_.push(i, stamp, values_);
        }
        interruption.step();
      }
    });
  }

  template <class Question>
  auto ask(const Question& question) const {
    return lock_.ask([&] { return question(monitor_); });
  }

 private:
  VehicleStreams streams_;
  CallbackLock lock_;
  std::vector<double> values_;
  VehicleGrid grid_;
  VehicleMonitor monitor_;
};

std::vector<MonitorReport> reportsOf(const VehicleMonitor& monitor) {
  std::vector<MonitorReport> reports(monitor.numStruts());
  for (std::size_t i = 0; i < reports.size(); ++i)
    if (monitor.strut(i) != nullptr) reports[i] = monitor.strut(i)->report();
  return reports;
}

}  // namespace

void bindVehicleMonitor(py::module& module) {
  py::class_<LockedVehicle>(module, "VehicleMonitor")
      .def(py::init([](const std::vector<std::pair<std::string, std::optional<Position>>>& struts,
                       const Keywords& keywords) {
             const MonitorOptions options = ArrayOptions::from(keywords.values).monitor;
             if (!options.sample_period)
               throw std::invalid_argument("sample_period is missing, must be given: all sensors share it");
             return std::make_unique<LockedVehicle>(struts, options);
           }),
           py::arg("struts"), py::arg("keywords"))
      .def("push", &LockedVehicle::push, py::arg("stamps"), py::arg("body"), py::arg("wheel"))
      .def_property_readonly("is_coupled",
                             [](const LockedVehicle& self) {
                               return self.ask([](const VehicleMonitor& monitor) { return monitor.isCoupled(); });
                             })
      .def_property_readonly("reports", [](const LockedVehicle& self) { return self.ask(reportsOf); });
}

}  // namespace suspension_health_monitor
