#include "suspension_health_monitor/internal/vehicle/coupling_rows.h"

#include "suspension_health_monitor/internal/vehicle/separation.h"

namespace suspension_health_monitor {

CouplingRows::CouplingRows(const CouplingColumns& columns, const IntegralFilterOptions& filter)
    : columns_(columns),
      struts_(static_cast<std::size_t>(columns.struts), SuspensionRegression(filter)),
      forces_(static_cast<std::size_t>(columns.forces), LinearIntegralFilter(2, filter, 2)),
      row_(CouplingRow::Zero(columns.size())) {}

const CouplingRow* CouplingRows::push(const VehicleSample& sample) {
  if (first_forces_.size() == 0) first_forces_ = sample.forces;
  bool is_full = true;
  for (int j = 0; j < columns_.struts; ++j) {
    const RegressionRow* row =
        struts_[static_cast<std::size_t>(j)].push({sample.stamp, sample.sprung[j], sample.unsprung[j]});
    is_full = row != nullptr;
    if (!is_full) continue;
    row_[columns_.damping(j)] = row->regressor[kDampingToMass];
    row_[columns_.stiffness(j)] = row->regressor[kStiffnessToMass];
    row_[columns_.output(j)] = row->output;
  }
  for (int k = 0; k < columns_.forces; ++k) {
    auto& force = forces_[static_cast<std::size_t>(k)];
    force.push(sample.forces[k] - first_forces_[k]);
    row_[columns_.force(k)] = force.output(2);
  }
  return is_full ? &row_ : nullptr;
}

void CouplingRows::startNewSeries() {
  for (auto& strut : struts_) strut.reset();
  for (auto& force : forces_) force.reset();
}

CouplingMoments momentsOfNoise(const CouplingColumns& columns, const IntegralFilterOptions& filter,
                               const SensorNoise& noise) {
  CouplingMoments moments = CouplingMoments::Zero(columns.size(), columns.size());
  const VehicleSample at_rest{
      {}, StrutVector::Zero(columns.struts), StrutVector::Zero(columns.struts), ForceVector::Zero(columns.forces)};
  const auto fill = static_cast<std::size_t>(LinearIntegralFilter::window(2, filter));
  CouplingRows rows(columns, filter);
  for (const StrutDrives& response : noise) {
    const VehicleDrive wrong{response};
    const std::size_t length = response.front().samples.size();
    rows.startNewSeries();
    for (std::size_t k = 0; k < length + 2 * fill; ++k) {
      VehicleSample sample = k >= fill && k < fill + length ? sampleOf(wrong, k - fill) : at_rest;
      sample.forces = at_rest.forces;
      if (const CouplingRow* row = rows.push(sample)) moments += *row * row->transpose();
    }
  }
  return moments;
}

}  // namespace suspension_health_monitor
