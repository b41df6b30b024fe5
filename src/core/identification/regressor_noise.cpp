#include "suspension_health_monitor/internal/identification/regressor_noise.h"

#include <vector>

#include "suspension_health_monitor/internal/identification/horizon_mean.h"

namespace suspension_health_monitor {
namespace {

/// phi_1, phi_0 and psi, row by row, with their changes and a horizon's mean of them.
class NoiseRows {
 public:
  explicit NoiseRows(const IntegralFilterOptions& options)
      : body_(2, options), relative_(2, options), means_(3, HorizonMean(options.horizon_samples)) {}

  void push(double sprung, double unsprung) {
    body_.push(sprung);
    relative_.push(unsprung - sprung);
    const Eigen::Vector3d now(relative_.output(1), relative_.output(0), body_.output(2));
    change = now - row;
    row = now;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      mean[column] = means_[i].push(row[column]);
    }
  }

  Eigen::Vector3d row = Eigen::Vector3d::Zero(), change = row, mean = row;

 private:
  LinearIntegralFilter body_, relative_;
  std::vector<HorizonMean> means_;
};

}  // namespace

RegressorNoise::RegressorNoise(const IntegralFilterOptions& options) {
  const int settled = LinearIntegralFilter::window(2, options);
  for (const bool of_body : {true, false}) {
    NoiseRows rows(options);
    for (int k = 0; k < settled; ++k) rows.push(0.0, 0.0);
    for (int k = 0; k < 2 * settled; ++k) {
      const double reading = k == 0 ? 1.0 : 0.0;
      rows.push(of_body ? reading : 0.0, of_body ? 0.0 : reading);
      rows_.add(rows.row, 1.0);
      changes_.add(rows.change, 1.0);
      means_.add(rows.mean, 1.0);
    }
  }
}

RegressorNoise::RegressorNoise(const IntegralFilterOptions& options, const std::vector<CornerSample>& noise)
    : RegressorNoise(options) {
  const std::size_t settled = 2 * static_cast<std::size_t>(LinearIntegralFilter::window(2, options));
  if (noise.size() <= 2 * settled) return;
  of_two_sensors_ = false;
  rows_ = changes_ = means_ = {};
  NoiseRows rows(options);
  const double weight = 1.0 / static_cast<double>(noise.size() - settled);
  for (std::size_t k = 0; k < noise.size(); ++k) {
    rows.push(noise[k].sprung_acceleration, noise[k].unsprung_acceleration);
    if (k < settled) continue;  // the filter and its mean fill
    rows_.add(rows.row, weight);
    changes_.add(rows.change, weight);
    means_.add(rows.mean, weight);
  }
}

void RegressorNoise::Moments::add(const Eigen::Vector3d& row, double weight) {
  const Eigen::Vector2d regressor = row.head<2>();
  regressors += weight * regressor * regressor.transpose();
  cross += weight * regressor * row[2];
  outputs += weight * row[2] * row[2];
}

}  // namespace suspension_health_monitor
