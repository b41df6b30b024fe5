#include <array>
#include <optional>

#include "bindings.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

/// What a baseline's friction is sent as.
using Numbers = std::array<double, 4>;

std::optional<Numbers> toNumbers(const std::optional<DryFriction>& friction) {
  if (!friction) return std::nullopt;
  return Numbers{friction->force, friction->stddev, friction->damping_gain, friction->damping_covariance};
}

std::optional<DryFriction> toFriction(const std::optional<Numbers>& numbers) {
  if (!numbers) return std::nullopt;
  return DryFriction{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

void bindEstimates(py::module& module) {
  py::class_<DryFriction>(module, "DryFriction", "Dry friction, beside which the linear strut was estimated.")
      .def_readonly("force", &DryFriction::force, "over the body's mass [m/s^2]")
      .def_readonly("stddev", &DryFriction::stddev, "[m/s^2]")
      .def_readonly("damping_gain", &DryFriction::damping_gain, "what 1 m/s^2 of it acts as of b1 on this road [s/m]")
      .def_readonly("damping_covariance", &DryFriction::damping_covariance, "of the errors of b1 and force [m/s^3]");
  py::class_<StrutEstimate>(module, "StrutEstimate", "What one estimator of the live monitor knows; NaN: nothing yet.")
      .def_readonly("damping_to_mass", &StrutEstimate::damping_to_mass, "b1 [1/s]")
      .def_readonly("stiffness_to_mass", &StrutEstimate::stiffness_to_mass, "b0 [1/s^2]")
      .def_readonly("damping_to_mass_stddev", &StrutEstimate::damping_to_mass_stddev, "[1/s]")
      .def_readonly("stiffness_to_mass_stddev", &StrutEstimate::stiffness_to_mass_stddev, "[1/s^2]")
      .def_readonly("correlation", &StrutEstimate::correlation, "of the errors of b1 and b0 [-]; of estimate")
      .def_readonly("offset", &StrutEstimate::offset,
                    "of the wheel carrier's reading against the body's [m/s^2]; of ls and la, else NaN")
      .def_readonly("delay", &StrutEstimate::delay,
                    "by which the wheel carrier's readings are stamped late [s]; of estimate, else NaN")
      .def_readonly("delay_stddev", &StrutEstimate::delay_stddev, "[s]")
      .def_readonly("friction", &StrutEstimate::friction, "of estimate without other effects, or None")
      .def_readonly("rows", &StrutEstimate::effective_rows, "of estimate blocks, else regression rows in the memory")
      .def_readonly("explained", &StrutEstimate::explained, "share of the body's motion that the strut explains")
      .def_readonly("age", &StrutEstimate::age, "of the data behind estimate, on average [s]; else NaN")
      .def_readonly("window", &StrutEstimate::window, "time that they span [s]; else NaN")
      .def_property_readonly(
          "coefficients",
          [](const StrutEstimate& self) {
            return py::array_t<double>(static_cast<Py_ssize_t>(self.num_effects), self.coefficients.data());
          },
          "of the effects in the model, in their order")
      .def_property_readonly("valid", &StrutEstimate::valid)
      .def_property_readonly(
          "reason", [](const StrutEstimate& self) { return self.valid() ? std::string() : describe(self.doubt); },
          "why it is not valid; empty if it is")
      .def_property_readonly("natural_frequency", &StrutEstimate::naturalFrequency, "undamped [Hz]")
      .def_property_readonly("damping_ratio", &StrutEstimate::dampingRatio, "[-]");
  py::class_<WheelEstimate>(module, "WheelEstimate", "What one estimator knows of wheel and tyre; NaN: nothing yet.")
      .def_readonly("damping_to_wheel_mass", &WheelEstimate::damping_to_wheel_mass, "[1/s]")
      .def_readonly("stiffness_to_wheel_mass", &WheelEstimate::stiffness_to_wheel_mass, "[1/s^2]")
      .def_readonly("tyre_to_wheel_mass", &WheelEstimate::tyre_to_wheel_mass, "[1/s^2]")
      .def_property_readonly("wheel_hop_frequency", &WheelEstimate::wheelHopFrequency, "[Hz]")
      .def_property_readonly("valid", &WheelEstimate::valid);
  py::class_<TyreReport>(module, "Tyre", "What is known of the tyre.")
      .def_readonly("ls", &TyreReport::ls)
      .def_readonly("la", &TyreReport::la);
}

void bindCondition(py::module& module) {
  py::class_<Baseline>(module, "Baseline", "The healthy strut, to judge changes by.")
      .def(py::init([](std::optional<double> damping, std::optional<double> stiffness) {
             Baseline baseline;
             baseline.damping_to_mass = damping;
             baseline.stiffness_to_mass = stiffness;
             return baseline;
           }),
           py::arg("damping_to_mass") = py::none(), py::arg("stiffness_to_mass") = py::none())
      .def_readonly("damping_to_mass", &Baseline::damping_to_mass, "b1 [1/s], or None")
      .def_readonly("stiffness_to_mass", &Baseline::stiffness_to_mass, "b0 [1/s^2], or None")
      .def_readonly("damping_to_mass_stddev", &Baseline::damping_to_mass_stddev, "[1/s]; 0 of a given value")
      .def_readonly("stiffness_to_mass_stddev", &Baseline::stiffness_to_mass_stddev, "[1/s^2]")
      .def_readonly("damping_scatter", &Baseline::damping_scatter, "of healthy windows beyond that [1/s]")
      .def_readonly("stiffness_scatter", &Baseline::stiffness_scatter, "[1/s^2]")
      .def_readonly("friction", &Baseline::friction, "when it was learned, or None: not known")
      .def_readonly("learned", &Baseline::learned, "from a drive")
      .def_property_readonly(
          "learned_from", [](const Baseline& self) { return toSeconds(self.from); }, "stamp of its begin [s]")
      .def_property_readonly(
          "learned_to", [](const Baseline& self) { return toSeconds(self.to); }, "stamp of its end [s]")
      .def(py::pickle(
          [](const Baseline& self) {
            return py::make_tuple(self.damping_to_mass, self.stiffness_to_mass, self.damping_to_mass_stddev,
                                  self.stiffness_to_mass_stddev, self.damping_scatter, self.stiffness_scatter,
                                  toNumbers(self.friction), self.learned, self.from.count(), self.to.count());
          },
          [](const py::tuple& state) {
            return Baseline{state[0].cast<std::optional<double>>(),
                            state[1].cast<std::optional<double>>(),
                            state[2].cast<double>(),
                            state[3].cast<double>(),
                            state[4].cast<double>(),
                            state[5].cast<double>(),
                            toFriction(state[6].cast<std::optional<Numbers>>()),
                            state[7].cast<bool>(),
                            Stamp(state[8].cast<Stamp::rep>()),
                            Stamp(state[9].cast<Stamp::rep>())};
          }));
  py::class_<HealthReport>(module, "HealthReport", "What is known of the strut's condition.")
      .def_property_readonly(
          "level", [](const HealthReport& self) { return nameOf(self.level); }, "OK, WARN, ERROR or STALE")
      .def_property_readonly(
          "message", [](const HealthReport& self) { return describe(self); }, "in one sentence")
      .def_readonly("damping_change", &HealthReport::damping_change, "relative to the healthy strut, or None")
      .def_readonly("stiffness_change", &HealthReport::stiffness_change)
      .def_readonly("payload_change", &HealthReport::payload_change, "of the body's mass")
      .def_readonly("early_warning", &HealthReport::early_warning)
      .def_readonly("learning", &HealthReport::learning, "progress 0 .. 1 of learning the baseline, or None");
  py::class_<ComparisonReport>(module, "ComparisonReport", "The model, driven by the wheel, against the measurement.")
      .def_readonly("measured", &ComparisonReport::measured, "z'' [m/s^2]")
      .def_readonly("predicted", &ComparisonReport::predicted, "[m/s^2], or None until the free run has settled")
      .def_readonly("rmse", &ComparisonReport::rmse, "over comparison_window [m/s^2]")
      .def_readonly("fit_percent", &ComparisonReport::fit_percent)
      .def_readonly("base_rmse", &ComparisonReport::base_rmse, "of the model without effects [m/s^2]")
      .def_readonly("base_fit_percent", &ComparisonReport::base_fit_percent);
  py::class_<MonitorReport>(module, "MonitorReport", "Everything that is known after one sample.")
      .def_property_readonly(
          "stamp", [](const MonitorReport& self) { return toSeconds(self.stamp); }, "[s]")
      .def_readonly("estimate", &MonitorReport::estimate, "of the newest blocks: what to trust, and health goes by")
      .def_readonly("ls", &MonitorReport::ls, "by least squares")
      .def_readonly("la", &MonitorReport::la, "by the least sum of absolute values")
      .def_readonly("comparison", &MonitorReport::comparison)
      .def_readonly("health", &MonitorReport::health);
  py::class_<InputStatus>(module, "InputStatus", "How the input has been so far.")
      .def_readonly("samples", &InputStatus::samples)
      .def_readonly("rows", &InputStatus::rows)
      .def_readonly("gaps", &InputStatus::gaps)
      .def_readonly("clock_jumps", &InputStatus::restarts)
      .def_readonly("mean_period", &InputStatus::mean_period, "[s]")
      .def_readonly("period_fits", &InputStatus::period_fits);
}

void bindCourse(py::module& module) {
  py::class_<Course> course(module, "Course",
                            "Estimates over time, evenly thinned out to a few thousand points. One entry per point.");
  const auto add = [&](const char* name, auto get, const char* text) {
    course.def_property_readonly(
        name, [get](const Course& self) { return arrayOf(self.points(), get); }, text);
  };
  add(
      "time", [](const CoursePoint& p) { return toSeconds(p.stamp); }, "[s]");
  add(
      "damping_to_mass", [](const CoursePoint& p) { return p.estimate.damping_to_mass; }, "of estimate [1/s]");
  add(
      "stiffness_to_mass", [](const CoursePoint& p) { return p.estimate.stiffness_to_mass; }, "of estimate [1/s^2]");
  add(
      "damping_to_mass_stddev", [](const CoursePoint& p) { return p.estimate.damping_to_mass_stddev; }, "[1/s]");
  add(
      "stiffness_to_mass_stddev", [](const CoursePoint& p) { return p.estimate.stiffness_to_mass_stddev; }, "[1/s^2]");
  add(
      "ls_damping_to_mass", [](const CoursePoint& p) { return p.ls.damping_to_mass; }, "of ls [1/s]");
  add(
      "ls_stiffness_to_mass", [](const CoursePoint& p) { return p.ls.stiffness_to_mass; }, "of ls [1/s^2]");
  add(
      "la_damping_to_mass", [](const CoursePoint& p) { return p.la.damping_to_mass; }, "of la [1/s]");
  add(
      "la_stiffness_to_mass", [](const CoursePoint& p) { return p.la.stiffness_to_mass; }, "of la [1/s^2]");
  add(
      "valid", [](const CoursePoint& p) { return p.estimate.valid(); }, "of estimate");
  add(
      "rmse", [](const CoursePoint& p) { return p.rmse; }, "of the free run [m/s^2]");
  add(
      "fit_percent", [](const CoursePoint& p) { return p.fit_percent; }, "of the free run");
  add(
      "level", [](const CoursePoint& p) { return static_cast<int>(p.level); }, "0 OK, 1 WARN, 2 ERROR, 3 STALE");
}

}  // namespace

void bindReports(py::module& module) {
  bindEstimates(module);
  bindCondition(module);
  bindCourse(module);
}

}  // namespace suspension_health_monitor
