#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/auxiliary_strut.h"
#include "suspension_health_monitor/internal/identification/block_equations.h"
#include "suspension_health_monitor/internal/identification/regression_row.h"
#include "suspension_health_monitor/internal/identification/wheel_history.h"
#include "suspension_health_monitor/internal/identification/without_level.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// The strut of a whole drive by instrumental variables: rows psi = b1 phi_1 + b0 phi_0 + c + e of the regression
/// (28)-(30). At short horizons sensor noise in phi pulls least squares away from the truth, however long the drive;
/// the instruments have next to none of that noise, and so does the estimate. The constant c takes up what a difference
/// of the sensors' offsets does to phi_0.
///
/// Instruments are the forces in an auxiliary strut, in the middle of the filter's window. It is driven by the
/// acceleration that another one like it has on the measured wheel: passed twice, the wheel's hop is as good as gone,
/// to which no integration rule on samples is fair. Its stiffness is that of least squares on all rows so far. Offsets
/// drift: what the wheel reads and the rows are on average over some windows is taken out of both. Source:
/// Soederstroem and Stoica (1981); paper, end of sec. 3.1. Assumes: b1 and b0 stay as they are; of a drive where they
/// change this is a mean. Cost per sample: O(1), no allocation but for a few hundred blocks.
class InstrumentalVariables {
 public:
  using Noise = std::shared_ptr<const std::vector<CornerSample>>;

  /// @param rows_late  by how much a row comes behind the sample that completes it [samples].
  /// @param noise  as of RegressorNoise; none: white noise of either sensor.
  InstrumentalVariables(const IntegralFilterOptions& options, int rows_late, Noise noise = {});

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @param row  that it completes, of which the strut's own columns count; nullptr: none.
  /// @param wheel  the wheel's part of that row.
  void push(const CornerSample& sample, const RegressionRow* row, const WheelRow& wheel);

  /// Starts anew after a gap; what was learnt stays.
  void interrupt();

  /// What rows are wrong by beyond what their scatter shows.
  struct RowErrors {
    double noise_variance = 0.0;  ///< of a sensor [(m/s^2)^2]
    double wrong_variance = 0.0;  ///< of what the wheel's readings may be wrong by beside it, at most [(m/s^2)^2]
    double skew_variance = 0.0;   ///< of that by which the wheel's readings are late [s^2]
  };

  struct Solution : BlockSolution {
    double wrong_share = 0.0;  ///< as ErrorBudget::wrongShare()
  };

  /// @return what the noise in the instruments shifts is taken off, with half of it in the standard deviation as in
  /// RegressorNoise::momentSpread(); of what wrong readings may shift a third of the square is. None while there are
  /// too few rows.
  std::optional<Solution> solution(const RowErrors& errors) const;

  /// @return samples without a gap that give enough rows: those that fill the filter, before and after a row, for a
  /// model, and for the blocks.
  int enoughSamples() const {
    return 2 * rows_late_ + (1 + kFirstWindows + static_cast<int>(BlockEquations::kFewestBlocks)) * window_;
  }

  /// @return 1 - rms(rest) / rms(z''), means taken out, where rest is what no sum of the forces in the strut on the
  /// wheel explains of the body's motion [-]. Noise in the rows of a short horizon does not lower it. NaN without rows.
  double explained() const;

 private:
  static constexpr int kFirstWindows = 8;  // of rows, before least squares is believed

  /// Instruments and rows, without what drifts.
  struct Rows {
    int age;                  // of the middle of a row's window [samples]
    WithoutLevel<1> wheel;    // readings
    WithoutLevel<3> columns;  // phi_1, phi_0, psi
    double stiffness = 0.0;   // of the auxiliary struts, b0 [1/s^2]; 0: not known yet
    AuxiliaryStrut on_wheel, on_strut;
    std::array<DelayLine, 2> forces;
    Eigen::Vector2d instrument, regressor;
    double output;

    Rows(double period, int window, int rows_late);
    void setModel(double stiffness_to_mass);
    void push(double reading);
    void add(const RegressionRow& row);
  };

  void chooseModel();
  EquationBlock ofNoise() const;

  IntegralFilterOptions options_;
  Noise noise_;
  int window_;         // samples that make a row
  int rows_late_;      // [samples]
  int rows_to_model_;  // until the auxiliary struts are judged anew
  EquationBlock least_squares_;
  Rows rows_;
  BlockEquations equations_;
  EquationBlock motion_;  // z'' by the forces in on_wheel
  double motion_squares_ = 0.0;
};

}  // namespace suspension_health_monitor
