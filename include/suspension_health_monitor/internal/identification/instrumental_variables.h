#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/auxiliary_strut.h"
#include "suspension_health_monitor/internal/identification/block_equations.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// The strut of a whole drive by instrumental variables: rows psi = b1 phi_1 + b0 phi_0 + c + e of the regression
/// (28)-(30). At short horizons sensor noise in phi pulls least squares away from the truth, however long the drive;
/// the instruments have next to none of that noise, and so does the estimate. The constant c takes up what a difference
/// of the sensors' offsets does to phi_0.
///
/// Instruments are the forces in an auxiliary strut, in the middle of the filter's window. It is driven by the
/// acceleration that another one like it has on the measured wheel: passed twice, the wheel's hop is as good as gone,
/// to which no integration rule on samples is fair. Its stiffness is that of least squares on all rows so far. Source:
/// Soederstroem and Stoica (1981); paper, end of sec. 3.1. Assumes: b1 and b0 stay as they are; of a drive where they
/// change this is a mean. Cost per sample: O(1), no allocation but for a few hundred blocks.
class InstrumentalVariables {
 public:
  explicit InstrumentalVariables(const IntegralFilterOptions& options);

  /// Takes in the next sample of an uninterrupted uniform series.
  void push(const CornerSample& sample);

  /// Starts anew after a gap; what was learnt stays.
  void interrupt();

  /// @return none while there are too few rows.
  std::optional<BlockSolution> solution() const { return equations_.solution(); }

  /// @return samples without a gap that give enough rows: those that fill the filter, for a model, and for the blocks.
  int enoughSamples() const { return (1 + kFirstWindows + static_cast<int>(BlockEquations::kFewestBlocks)) * window_; }

  /// @return 1 - rms(rest) / rms(z''), means taken out, where rest is what no sum of the forces in the strut on the
  /// wheel explains of the body's motion [-]. Noise in the rows of a short horizon does not lower it. NaN without rows.
  double explained() const;

 private:
  static constexpr int kFirstWindows = 8;  // of rows, before least squares is believed
  void chooseModel();

  int window_;         // samples that make a row
  int rows_to_model_;  // until the auxiliary struts are judged anew
  SuspensionRegression regression_;
  EquationBlock least_squares_;
  AuxiliaryStrut on_wheel_, on_strut_;
  std::array<DelayLine, 2> instruments_;
  BlockEquations equations_;
  EquationBlock motion_;  // z'' by the forces in on_wheel_
  double motion_squares_ = 0.0;
  RunningMean gravity_{1.0};  // in the wheel's readings: the auxiliary struts start without it
};

}  // namespace suspension_health_monitor
