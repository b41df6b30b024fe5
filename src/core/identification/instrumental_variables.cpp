#include "suspension_health_monitor/internal/identification/instrumental_variables.h"

#include <cmath>

namespace suspension_health_monitor {

InstrumentalVariables::InstrumentalVariables(const IntegralFilterOptions& options)
    : window_(LinearIntegralFilter::window(2, options)),
      rows_to_model_(kFirstWindows * window_),
      regression_(options),
      on_wheel_(options.period),
      on_strut_(options.period),
      instruments_{DelayLine(window_ / 2 + 1), DelayLine(window_ / 2 + 1)},
      equations_(window_) {}

void InstrumentalVariables::push(const CornerSample& sample) {
  gravity_.add(sample.unsprung_acceleration);
  if (on_wheel_.hasModel()) {
    on_wheel_.push(sample.unsprung_acceleration - gravity_.mean());
    on_strut_.push(on_wheel_.forces().sum());
    instruments_[0].push(on_strut_.forces()[0]);
    instruments_[1].push(on_strut_.forces()[1]);
  }
  const RegressionRow* row = regression_.push(sample);
  if (row == nullptr) return;
  const Eigen::Vector2d regressor = row->regressor.head<2>();
  if (on_wheel_.hasModel()) {
    equations_.add({instruments_[0].at(window_ / 2), instruments_[1].at(window_ / 2)}, regressor, row->output);
    motion_.add(on_wheel_.forces(), on_wheel_.forces(), sample.sprung_acceleration);
    motion_squares_ += sample.sprung_acceleration * sample.sprung_acceleration;
  }
  least_squares_.add(regressor, regressor, row->output);
  if (--rows_to_model_ == 0) chooseModel();
}

void InstrumentalVariables::chooseModel() {
  rows_to_model_ = window_;
  const std::optional<Eigen::Vector3d> theta = least_squares_.solution();
  if (!theta || !((*theta)[kStiffnessToMass] > 0.0)) return;
  on_wheel_.setModel((*theta)[kStiffnessToMass]);
  on_strut_.setModel((*theta)[kStiffnessToMass]);
}

void InstrumentalVariables::interrupt() {
  regression_.reset();
  on_wheel_.reset();
  on_strut_.reset();
}

double InstrumentalVariables::explained() const {
  const std::optional<Eigen::Vector3d> share = motion_.solution();
  if (!share) return std::nan("");
  const double rest = motion_squares_ - share->dot(motion_.outputs);  // the rest of least squares
  const double whole = motion_squares_ - std::pow(motion_.outputs[2], 2) / motion_.rows();
  return 1.0 - std::sqrt(rest / whole);
}

}  // namespace suspension_health_monitor
