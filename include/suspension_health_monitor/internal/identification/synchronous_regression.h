#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/identification/skew_profile.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"
#include "suspension_health_monitor/internal/identification/wheel_history.h"

namespace suspension_health_monitor {

/// Rows of the strut regression of readings whose clocks differ: the skew is learned from the rows (SkewProfile), and
/// the wheel's part of every row is that of the time when the body was measured. Rows are as late as the largest skew
/// that is looked for, since the wheel's readings may come by so much too late.
/// Cost per sample: O(1), no allocation.
class SynchronousRegression {
 public:
  /// @param sensors  kDriftingOffset; with the others the clocks are taken at their word, and rows are not late.
  /// @param noise  of the same filter.  @param forgetting_factor  of the estimator.
  SynchronousRegression(const IntegralFilterOptions& options, SensorColumns sensors, const RegressorNoise& noise,
                        double forgetting_factor);

  /// Goes on with other effects; the skew stays known. Allocates.
  void changeEffects(std::size_t num_effects);

  /// As SuspensionRegression::push().
  const RegressionRow* push(const CornerSample& sample, const double* effect_forces);

  /// Takes the newest row in.
  /// @param output  psi without what effects make of it.
  void learnSkew(double output);

  /// @return the row that push() has returned last.
  const RegressionRow& row() const { return row_; }

  /// @return by how much a row comes behind the sample that completes it [samples].
  int delay() const { return late_ ? late_->wheel.delay() : 0; }

  /// @return the newest row's part of the wheel, by its own clock if no skew is learned.
  const WheelRow& wheel() const { return wheel_; }

  /// @return none: clocks are taken at their word.
  const SkewProfile* skew() const { return late_ ? &late_->skew : nullptr; }

  void setForgettingFactor(double forgetting_factor);

  /// As SkewProfile::setNoise().
  void setNoise(double variance) {
    if (late_) late_->skew.setNoise(variance);
  }

  void reset();    ///< after a gap
  void restart();  ///< another drive: the clocks may be others

 private:
  /// What is kept until the wheel's readings of the same time are there.
  struct Late {
    Late(const IntegralFilterOptions& options, const RegressorNoise& noise, double forgetting_factor);

    WheelHistory wheel;
    std::vector<DelayLine> columns;  // psi, I_1^2 z'', I_0^2 z'', effects
    SkewProfile skew;
    WheelHistory::Place place;  // of the wheel's readings that belong to a row

    void setEffects(std::size_t num_effects);
    double at(std::size_t column) const { return columns[column].at(wheel.delay()); }
  };

  const RegressionRow* synchronised(const RegressionRow& newest);

  IntegralFilterOptions options_;
  SensorColumns sensors_;
  SuspensionRegression rows_;
  std::optional<Late> late_;
  RegressionRow row_;
  WheelRow wheel_{};
};

}  // namespace suspension_health_monitor
