#include "suspension_health_monitor/internal/identification/regressor_noise.h"

#include <vector>

#include "suspension_health_monitor/internal/identification/horizon_mean.h"
#include "suspension_health_monitor/internal/identification/slow_mean.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

/// phi_1, phi_0 and psi, row by row, with their changes, a horizon's mean of them, and what is slow in phi_0.
class NoiseRows {
 public:
  explicit NoiseRows(const IntegralFilterOptions& options)
      : body_(2, options),
        relative_(2, options),
        means_(3, HorizonMean(options.horizon_samples)),
        slow_(options.period) {}

  int fills() const { return slow_.fills(); }

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
    slow = slow_.push(row[1]);
  }

  Eigen::Vector3d row = Eigen::Vector3d::Zero(), change = row, mean = row;
  double slow = 0.0;

 private:
  LinearIntegralFilter body_, relative_;
  std::vector<HorizonMean> means_;
  SlowMean slow_;
};

}  // namespace

RegressorNoise::RegressorNoise(const IntegralFilterOptions& options) {
  const int settled = LinearIntegralFilter::window(2, options);
  for (const bool of_body : {true, false}) {
    NoiseRows rows(options);
    for (int k = 0; k < settled; ++k) rows.push(0.0, 0.0);
    for (int k = 0; k < 2 * settled + rows.fills(); ++k) {
      const double reading = k == 0 ? 1.0 : 0.0;
      rows.push(of_body ? reading : 0.0, of_body ? 0.0 : reading);
      rows_.add(rows.row, 1.0);
      changes_.add(rows.change, 1.0);
      means_.add(rows.mean, 1.0);
      slow_ += square(rows.slow);
    }
  }
}

RegressorNoise::RegressorNoise(const IntegralFilterOptions& options, const std::vector<CornerSample>& noise)
    : RegressorNoise(options) {
  NoiseRows rows(options);
  const auto settled = static_cast<std::size_t>(LinearIntegralFilter::window(2, options) + rows.fills());
  if (noise.size() <= 2 * settled) return;
  of_two_sensors_ = false;
  rows_ = changes_ = means_ = {};
  slow_ = 0.0;
  const double weight = 1.0 / static_cast<double>(noise.size() - settled);
  for (std::size_t k = 0; k < noise.size(); ++k) {
    rows.push(noise[k].sprung_acceleration, noise[k].unsprung_acceleration);
    if (k < settled) continue;  // the filter and its means fill
    rows_.add(rows.row, weight);
    changes_.add(rows.change, weight);
    means_.add(rows.mean, weight);
    slow_ += weight * square(rows.slow);
  }
}

void RegressorNoise::Moments::add(const Eigen::Vector3d& row, double weight) {
  const Eigen::Vector2d regressor = row.head<2>();
  regressors += weight * regressor * regressor.transpose();
  cross += weight * regressor * row[2];
  outputs += weight * row[2] * row[2];
}

}  // namespace suspension_health_monitor
