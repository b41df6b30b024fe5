#include "suspension_health_monitor/internal/identification/instrumental_variables.h"

#include <cmath>
#include <limits>
#include <utility>

#include "suspension_health_monitor/internal/identification/suspension_regression.h"

namespace suspension_health_monitor {

InstrumentalVariables::Rows::Rows(double period, int window, int rows_late)
    : age(window / 2 + rows_late),
      wheel(kFirstWindows * window),
      columns(kFirstWindows * window),
      on_wheel(period),
      on_strut(period),
      forces{DelayLine(age + 1), DelayLine(age + 1)} {}

void InstrumentalVariables::Rows::setModel(double stiffness_to_mass) {
  stiffness = stiffness_to_mass;
  on_wheel.setModel(stiffness_to_mass);
  on_strut.setModel(stiffness_to_mass);
}

void InstrumentalVariables::Rows::push(double reading) {
  const auto [input] = wheel.push({reading});
  if (!on_wheel.hasModel()) return;
  on_wheel.push(input);
  on_strut.push(on_wheel.forces().sum());
  for (const int i : {0, 1}) forces[static_cast<std::size_t>(i)].push(on_strut.forces()[i]);
}

void InstrumentalVariables::Rows::add(const RegressionRow& row) {
  const auto [phi_1, phi_0, psi] =
      columns.push({row.regressor[kDampingToMass], row.regressor[kStiffnessToMass], row.output});
  instrument = {forces[0].at(age), forces[1].at(age)};
  regressor = {phi_1, phi_0};
  output = psi;
}

InstrumentalVariables::InstrumentalVariables(const IntegralFilterOptions& options, int rows_late, Noise noise)
    : options_(options),
      noise_(std::move(noise)),
      window_(LinearIntegralFilter::window(2, options)),
      rows_late_(rows_late),
      rows_to_model_(kFirstWindows * window_),
      rows_(options.period, window_, rows_late),
      equations_(window_) {}

void InstrumentalVariables::push(const CornerSample& sample, const RegressionRow* row, const WheelRow& wheel) {
  rows_.push(sample.unsprung_acceleration);
  if (row == nullptr) return;
  rows_.add(*row);
  if (rows_.on_wheel.hasModel()) {
    const Eigen::Vector2d& forces = rows_.on_wheel.forces();
    equations_.add(rows_.instrument, rows_.regressor, rows_.output, {wheel.output, wheel.damping});
    motion_.add(forces, forces, sample.sprung_acceleration);
    motion_squares_ += sample.sprung_acceleration * sample.sprung_acceleration;
  }
  least_squares_.add(rows_.regressor, rows_.regressor, rows_.output);
  if (--rows_to_model_ == 0) chooseModel();
}

void InstrumentalVariables::chooseModel() {
  rows_to_model_ = window_;
  const std::optional<Eigen::Vector3d> theta = least_squares_.solution();
  if (theta && (*theta)[kStiffnessToMass] > 0.0) rows_.setModel((*theta)[kStiffnessToMass]);
}

void InstrumentalVariables::interrupt() {
  rows_.on_wheel.reset();
  rows_.on_strut.reset();
}

// The moments that a row has of noise, of sensors whose variance is 1. Of white noise they are sums over what one
// reading of the wheel makes of all rows; the body's is in no instrument.
EquationBlock InstrumentalVariables::ofNoise() const {
  EquationBlock moments;
  Rows rows(options_.period, window_, 0);
  SuspensionRegression regression(options_);
  rows.setModel(rows_.stiffness);
  const auto take = [&](const CornerSample& sample) {
    rows.push(sample.unsprung_acceleration);
    const RegressionRow* row = regression.push(sample);
    if (row == nullptr) return;
    rows.add(*row);
    moments.add(rows.instrument, rows.regressor, rows.output);
  };
  if (noise_ && !noise_->empty()) {
    for (const CornerSample& sample : *noise_) take(sample);
    return moments.scaled(1.0 / moments.rows());
  }
  const int settled = 4 * kFirstWindows * window_;  // of what is taken out as level e^-4 is missing then
  for (int k = 0; k < 2 * settled; ++k) take({{}, 0.0, k == settled ? 1.0 : 0.0});
  return moments;
}

std::optional<InstrumentalVariables::Solution> InstrumentalVariables::solution(const RowErrors& errors) const {
  const std::optional<BlockSolution> with_noise = equations_.solution({});
  if (!with_noise) return std::nullopt;
  const EquationBlock noise = ofNoise();
  const std::optional<BlockSolution> without = equations_.solution(noise.scaled(errors.noise_variance));
  if (!without) return std::nullopt;
  Solution solution{*without};
  solution.addError(0.5 * (with_noise->theta - solution.theta));
  solution.addError(std::sqrt(errors.skew_variance) * solution.rate);
  const std::optional<BlockSolution> least =
      equations_.solution(noise.scaled(errors.noise_variance + errors.wrong_variance));
  const Eigen::Vector2d moved = least ? Eigen::Vector2d(least->theta - solution.theta)
                                      : Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  solution.addError(moved / std::sqrt(3.0));
  solution.wrong_share = least ? (moved.array() / least->theta.array()).abs().maxCoeff() : moved[0];
  return solution;
}

double InstrumentalVariables::explained() const {
  const std::optional<Eigen::Vector3d> share = motion_.solution();
  if (!share) return std::nan("");
  const double rest = motion_squares_ - share->dot(motion_.outputs);  // the rest of least squares
  const double whole = motion_squares_ - std::pow(motion_.outputs[2], 2) / motion_.rows();
  return 1.0 - std::sqrt(rest / whole);
}

}  // namespace suspension_health_monitor
