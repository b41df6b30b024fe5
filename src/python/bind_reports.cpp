#include <array>
#include <cstdint>
#include <optional>
#include <tuple>

#include "bindings.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

/// What a baseline is sent as, its friction and its temperature.
using Numbers = std::array<double, 4>;
using BaselineState =
    std::tuple<std::optional<double>, std::optional<double>, double, double, double, double, std::optional<Numbers>,
               std::optional<std::array<double, 3>>, bool, Stamp::rep, Stamp::rep>;

std::optional<Numbers> toNumbers(const std::optional<DryFriction>& friction) {
  if (!friction) return std::nullopt;
  return Numbers{friction->force, friction->stddev, friction->damping_gain, friction->damping_covariance};
}

std::optional<DryFriction> toFriction(const std::optional<Numbers>& numbers) {
  if (!numbers) return std::nullopt;
  return DryFriction{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

BaselineState stateOf(const Baseline& baseline) {
  std::optional<std::array<double, 3>> temperature;
  if (const auto& known = baseline.temperature)
    temperature = {known->celsius, known->per_kelvin, known->per_kelvin_stddev};
  return BaselineState(baseline.damping_to_mass, baseline.stiffness_to_mass, baseline.damping_to_mass_stddev,
                       baseline.stiffness_to_mass_stddev, baseline.damping_scatter, baseline.stiffness_scatter,
                       toNumbers(baseline.friction), temperature, baseline.learned, baseline.from.count(),
                       baseline.to.count());
}

Baseline toBaseline(const BaselineState& state) {
  const auto& [b1, b0, sd1, sd0, scatter1, scatter0, friction, temperature, learned, from, to] = state;
  std::optional<DamperTemperature> warm;
  if (temperature) warm = {(*temperature)[0], (*temperature)[1], (*temperature)[2]};
  return {b1, b0, sd1, sd0, scatter1, scatter0, toFriction(friction), warm, learned, Stamp(from), Stamp(to)};
}

/// Adds what the estimates of a drive and those of the live monitor have alike.
template <class Strut>
ResultClass<Strut>& addStrut(ResultClass<Strut>&& strut) {
  return strut.add("damping_to_mass", "b1 = damping/mass [1/s]", &Strut::damping_to_mass)
      .add("stiffness_to_mass", "b0 = stiffness/mass [1/s^2]", &Strut::stiffness_to_mass)
      .add("damping_to_mass_stddev", "[1/s]", &Strut::damping_to_mass_stddev)
      .add("stiffness_to_mass_stddev", "[1/s^2]", &Strut::stiffness_to_mass_stddev)
      .add("explained", "share of the body's motion that the strut explains", &Strut::explained)
      .add("valid", "", &Strut::valid)
      .add("natural_frequency", "undamped [Hz]", &Strut::naturalFrequency)
      .add("damping_ratio", "[-]", &Strut::dampingRatio);
}

void bindEstimates(py::module& module) {
  addStrut(
      ResultClass<IdentifiedStrut>(module, "IdentifiedStrut", "What one estimator knows of the strut; NaN: nothing."))
      .add("rows", "regression rows, or blocks, that the estimate rests on", &IdentifiedStrut::rows)
      .add("age", "of the newest data behind estimate [s]; else NaN", &IdentifiedStrut::age)
      .add("reason", "why it is not valid; empty if it is", &IdentifiedStrut::reason);
  ResultClass<DamperTemperature>(module, "DamperTemperature", "How damping goes with the damper's temperature.")
      .add("celsius", "at which the baseline's damping holds", &DamperTemperature::celsius)
      .add("per_kelvin", "change of ln damping [1/K]", &DamperTemperature::per_kelvin)
      .add("per_kelvin_stddev", "[1/K]", &DamperTemperature::per_kelvin_stddev);
  ResultClass<DryFriction>(module, "DryFriction", "Dry friction, beside which the linear strut was estimated.")
      .add("force", "over the body's mass [m/s^2]", &DryFriction::force)
      .add("stddev", "[m/s^2]", &DryFriction::stddev)
      .add("damping_gain", "what 1 m/s^2 of it acts as of b1 on this road [s/m]", &DryFriction::damping_gain)
      .add("damping_covariance", "of the errors of b1 and force [m/s^3]", &DryFriction::damping_covariance);
  addStrut(ResultClass<StrutEstimate>(module, "StrutEstimate",
                                      "What one estimator of the live monitor knows; NaN: nothing yet."))
      .add("correlation", "of the errors of b1 and b0 [-]; of estimate", &StrutEstimate::correlation)
      .add("offset", "of the wheel carrier's reading against the body's [m/s^2]; of ls and la, else NaN",
           &StrutEstimate::offset)
      .add("delay", "by which the wheel carrier's readings are stamped late [s]; of estimate, else NaN",
           &StrutEstimate::delay)
      .add("delay_stddev", "[s]", &StrutEstimate::delay_stddev)
      .add("gain", "of the body's sensor over that of the wheel's, less 1 [-]", &StrutEstimate::gain)
      .add("gain_stddev", "[-]", &StrutEstimate::gain_stddev)
      .add("friction", "of estimate without other effects, or None", &StrutEstimate::friction)
      .add("rows", "of estimate blocks, else regression rows in the memory", &StrutEstimate::effective_rows)
      .add("age", "of the data behind estimate, on average [s]; else NaN", &StrutEstimate::age)
      .add("window", "time that they span [s]; else NaN", &StrutEstimate::window)
      .addArray("coefficients", "of the effects in the model, in their order",
                [](const StrutEstimate& self) {
                  return std::vector<double>(self.coefficients.begin(), self.coefficients.begin() + self.num_effects);
                })
      .add("reason", "why it is not valid; empty if it is",
           [](const StrutEstimate& self) { return self.valid() ? std::string() : describe(self.doubt); });
  ResultClass<WheelEstimate>(module, "WheelEstimate", "What one estimator knows of wheel and tyre; NaN: nothing yet.")
      .add("damping_to_wheel_mass", "[1/s]", &WheelEstimate::damping_to_wheel_mass)
      .add("stiffness_to_wheel_mass", "[1/s^2]", &WheelEstimate::stiffness_to_wheel_mass)
      .add("tyre_to_wheel_mass", "[1/s^2]", &WheelEstimate::tyre_to_wheel_mass)
      .add("wheel_hop_frequency", "[Hz]", &WheelEstimate::wheelHopFrequency)
      .add("valid", "", &WheelEstimate::valid);
  ResultClass<TyreReport>(module, "Tyre", "What is known of the tyre.")
      .add("ls", "", &TyreReport::ls)
      .add("la", "", &TyreReport::la);
}

void bindCondition(py::module& module) {
  ResultClass<Baseline>(module, "Baseline", "The healthy strut, to judge changes by.")
      .add("damping_to_mass", "b1 [1/s], or None", &Baseline::damping_to_mass)
      .add("stiffness_to_mass", "b0 [1/s^2], or None", &Baseline::stiffness_to_mass)
      .add("damping_to_mass_stddev", "[1/s]; 0 of a given value", &Baseline::damping_to_mass_stddev)
      .add("stiffness_to_mass_stddev", "[1/s^2]", &Baseline::stiffness_to_mass_stddev)
      .add("damping_scatter", "of healthy windows beyond that [1/s]", &Baseline::damping_scatter)
      .add("stiffness_scatter", "[1/s^2]", &Baseline::stiffness_scatter)
      .add("friction", "when it was learned, or None: not known", &Baseline::friction)
      .add("temperature", "how damping goes with the damper's, or None: not known", &Baseline::temperature)
      .add("learned", "from a drive", &Baseline::learned)
      .add("learned_from", "stamp of its begin [s]", &Baseline::from)
      .add("learned_to", "stamp of its end [s]", &Baseline::to)
      .def(py::init([](const std::optional<double>& damping, const std::optional<double>& stiffness) {
             Baseline baseline;
             baseline.damping_to_mass = damping;
             baseline.stiffness_to_mass = stiffness;
             return baseline;
           }),
           py::arg("damping_to_mass") = py::none(), py::arg("stiffness_to_mass") = py::none())
      .def(py::pickle(&stateOf, &toBaseline));
  ResultClass<HealthReport>(module, "HealthReport", "What is known of the strut's condition.")
      .add("level", "OK, WARN, ERROR or STALE", &HealthReport::level)
      .add("message", "in one sentence", [](const HealthReport& self) { return describe(self); })
      .add("damping_change", "relative to the healthy strut, or None", &HealthReport::damping_change)
      .add("stiffness_change", "", &HealthReport::stiffness_change)
      .add("payload_change", "of the body's mass", &HealthReport::payload_change)
      .add("early_warning", "", &HealthReport::early_warning)
      .add("learning", "progress 0 .. 1 of learning the baseline, or None", &HealthReport::learning);
  ResultClass<ComparisonReport>(module, "ComparisonReport", "The model, driven by the wheel, against the measurement.")
      .add("measured", "z'' [m/s^2]", &ComparisonReport::measured)
      .add("predicted", "[m/s^2], or None until the free run has settled", &ComparisonReport::predicted)
      .add("rmse", "over comparison_window [m/s^2]", &ComparisonReport::rmse)
      .add("fit_percent", "", &ComparisonReport::fit_percent)
      .add("base_rmse", "of the model without effects [m/s^2]", &ComparisonReport::base_rmse)
      .add("base_fit_percent", "", &ComparisonReport::base_fit_percent);
  ResultClass<MonitorReport>(module, "MonitorReport", "Everything that is known after one sample.")
      .add("stamp", "[s]", &MonitorReport::stamp)
      .add("estimate", "of the newest blocks: what to trust, and health goes by", &MonitorReport::estimate)
      .add("ls", "by least squares", &MonitorReport::ls)
      .add("la", "by the least sum of absolute values", &MonitorReport::la)
      .add("comparison", "", &MonitorReport::comparison)
      .add("health", "", &MonitorReport::health);
  ResultClass<InputStatus>(module, "InputStatus", "How the input has been so far.")
      .add("samples", "", &InputStatus::samples)
      .add("rows", "", &InputStatus::rows)
      .add("gaps", "", &InputStatus::gaps)
      .add("clock_jumps", "", &InputStatus::restarts)
      .add("mean_period", "[s]", &InputStatus::mean_period)
      .add("period_fits", "", &InputStatus::period_fits)
      .add("unit_fits", "", &InputStatus::unit_fits);
}

void bindCourse(py::module& module) {
  ResultClass<Course> course(module, "Course",
                             "Estimates over time, evenly thinned out to a few thousand points. One entry per point.");
  const auto add = [&](const char* name, const char* text, const auto& what) {
    course.addColumn(name, text, &Course::points, what);
  };
  add("time", "[s]", &MonitorReport::stamp);
  add("damping_to_mass", "of estimate [1/s]", [](const auto& at) { return at.estimate.damping_to_mass; });
  add("stiffness_to_mass", "of estimate [1/s^2]", [](const auto& at) { return at.estimate.stiffness_to_mass; });
  add("damping_to_mass_stddev", "[1/s]", [](const auto& at) { return at.estimate.damping_to_mass_stddev; });
  add("stiffness_to_mass_stddev", "[1/s^2]", [](const auto& at) { return at.estimate.stiffness_to_mass_stddev; });
  add("ls_damping_to_mass", "of ls [1/s]", [](const auto& at) { return at.ls.damping_to_mass; });
  add("ls_stiffness_to_mass", "of ls [1/s^2]", [](const auto& at) { return at.ls.stiffness_to_mass; });
  add("la_damping_to_mass", "of la [1/s]", [](const auto& at) { return at.la.damping_to_mass; });
  add("la_stiffness_to_mass", "of la [1/s^2]", [](const auto& at) { return at.la.stiffness_to_mass; });
  add("valid", "of estimate", [](const auto& at) { return at.estimate.valid(); });
  add("rmse", "of the free run [m/s^2]", [](const auto& at) { return at.comparison.rmse; });
  add("fit_percent", "of the free run", [](const auto& at) { return at.comparison.fit_percent; });
  add("level", "0 OK, 1 WARN, 2 ERROR, 3 STALE", [](const auto& at) { return static_cast<int>(at.health.level); });
}

}  // namespace

void bindReports(py::module& module) {
  bindEstimates(module);
  bindCondition(module);
  bindCourse(module);
}

}  // namespace suspension_health_monitor
