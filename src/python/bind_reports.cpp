#include <array>
#include <optional>
#include <tuple>

#include "bindings.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {
namespace {

/// What pickle keeps of a baseline; its friction and its temperature are arrays of numbers.
using BaselineState = std::tuple<std::optional<double>, std::optional<double>, double, double, double, double,
                                 std::optional<std::array<double, 4>>, std::optional<std::array<double, 3>>, bool,
                                 Stamp::rep, Stamp::rep>;

BaselineState stateOf(const Baseline& baseline) {
  std::optional<std::array<double, 4>> friction;
  if (const auto& known = baseline.friction)
    friction = {known->force, known->stddev, known->damping_gain, known->damping_covariance};
  std::optional<std::array<double, 3>> temperature;
  if (const auto& known = baseline.temperature)
    temperature = {known->celsius, known->per_kelvin, known->per_kelvin_stddev};
  return BaselineState(baseline.damping_to_mass, baseline.stiffness_to_mass, baseline.damping_to_mass_stddev,
                       baseline.stiffness_to_mass_stddev, baseline.damping_scatter, baseline.stiffness_scatter,
                       friction, temperature, baseline.learned, baseline.from.count(), baseline.to.count());
}

Baseline toBaseline(const BaselineState& state) {
  const auto& [b1, b0, sd1, sd0, scatter1, scatter0, friction, temperature, learned, from, to] = state;
  std::optional<DryFriction> dry;
  if (friction) dry = {(*friction)[0], (*friction)[1], (*friction)[2], (*friction)[3]};
  std::optional<DamperTemperature> warm;
  if (temperature) warm = {(*temperature)[0], (*temperature)[1], (*temperature)[2]};
  return {b1, b0, sd1, sd0, scatter1, scatter0, dry, warm, learned, Stamp(from), Stamp(to)};
}

void bindEstimates(py::module& module) {
  ResultClass<DamperTemperature>(module, "DamperTemperature", "How damping goes with the damper's temperature.");
  ResultClass<DryFriction>(module, "DryFriction", "Dry friction, beside which the linear strut was estimated.")
      .add("damping_covariance", &DryFriction::damping_covariance);
  ResultClass<StrutEstimate>(module, "StrutEstimate", "What one estimator knows of the strut; NaN: nothing yet.")
      .add("known_to", &StrutEstimate::knownTo)
      .add("natural_frequency", &StrutEstimate::naturalFrequency)
      .add("damping_ratio", &StrutEstimate::dampingRatio)
      .add("valid", &StrutEstimate::valid)
      .add("rows", &StrutEstimate::effective_rows)
      .addArray("coefficients",
                [](const StrutEstimate& self) {
                  return std::vector<double>(self.coefficients.begin(), self.coefficients.begin() + self.num_effects);
                })
      .add("reason", [](const StrutEstimate& self) { return self.valid() ? std::string() : describe(self.doubt); });
  ResultClass<WheelEstimate>(module, "WheelEstimate", "What one estimator knows of wheel and tyre; NaN: nothing yet.")
      .add("wheel_hop_frequency", &WheelEstimate::wheelHopFrequency)
      .add("valid", &WheelEstimate::valid);
  ResultClass<TyreReport>(module, "Tyre", "What is known of the tyre.");
}

void bindCondition(py::module& module) {
  ResultClass<Baseline>(module, "Baseline", "The healthy strut, to judge changes by.")
      .add("learned_from", &Baseline::from)
      .add("learned_to", &Baseline::to)
      .def(py::init([](const std::optional<double>& damping, const std::optional<double>& stiffness) {
             Baseline baseline;
             baseline.damping_to_mass = damping;
             baseline.stiffness_to_mass = stiffness;
             return baseline;
           }),
           py::arg("damping_to_mass") = py::none(), py::arg("stiffness_to_mass") = py::none())
      .def(py::pickle(&stateOf, &toBaseline));
  ResultClass<HealthReport>(module, "HealthReport", "What is known of the strut's condition.")
      .add("message", [](const HealthReport& self) { return describe(self); });
  ResultClass<ComparisonReport>(module, "ComparisonReport", "The model, driven by the wheel, against the measurement.");
  ResultClass<MonitorReport>(module, "MonitorReport", "Everything that is known after one sample.");
  ResultClass<InputStatus>(module, "InputStatus", "How the input has been so far.")
      .add("clock_jumps", &InputStatus::restarts);
}

void bindCourse(py::module& module) {
  ResultClass<Course> course(module, "Course",
                             "Estimates over time, evenly thinned out to a few thousand points. One entry per point.");
  const auto add = [&](const char* name, const auto& what) { course.addColumn(name, &Course::points, what); };
  add("time", &MonitorReport::stamp);
  add("damping_to_mass", [](const auto& at) { return at.estimate.damping_to_mass; });
  add("stiffness_to_mass", [](const auto& at) { return at.estimate.stiffness_to_mass; });
  add("damping_to_mass_stddev", [](const auto& at) { return at.estimate.damping_to_mass_stddev; });
  add("stiffness_to_mass_stddev", [](const auto& at) { return at.estimate.stiffness_to_mass_stddev; });
  add("ls_damping_to_mass", [](const auto& at) { return at.ls.damping_to_mass; });
  add("ls_stiffness_to_mass", [](const auto& at) { return at.ls.stiffness_to_mass; });
  add("la_damping_to_mass", [](const auto& at) { return at.la.damping_to_mass; });
  add("la_stiffness_to_mass", [](const auto& at) { return at.la.stiffness_to_mass; });
  add("valid", [](const auto& at) { return at.estimate.valid(); });
  add("rmse", [](const auto& at) { return at.comparison.rmse; });
  add("fit_percent", [](const auto& at) { return at.comparison.fit_percent; });
  add("level", [](const auto& at) { return static_cast<int>(at.health.level); });
}

}  // namespace

void bindReports(py::module& module) {
  bindEstimates(module);
  bindCondition(module);
  bindCourse(module);
}

}  // namespace suspension_health_monitor
