#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "suspension_health_monitor/internal/blocks/window_fit.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

namespace suspension_health_monitor {

/// Where the column of strut j is among the neighbours of strut i, as StrutBlock::neighbours has them: the rate's; the
/// travel's is the next.
inline int neighbourColumn(std::size_t i, std::size_t j) { return 2 * static_cast<int>(j < i ? j : j - 1); }

/// What the model of all rows makes of the wheels alone, in the bins of one block, (B22) in doc/equations.md: with Q(s)
/// = b1 s + b0 (matrices)
///     Z = (s^2 I + Q)^-1 (Q X + s^2 c F).
/// These motions are free of the noise of all body sensors: instruments. Source: R. Pintelon, J. Schoukens, System
/// Identification: A Frequency Domain Approach, 2012, ch. 9 (instrumental variables by a model's output).
/// Cost: O(bins * struts^3), no allocation after the construction.
class CoupledTops {
 public:
  CoupledTops(const BlockBand& band, std::size_t struts, std::size_t forces);

  void setRows(const TopRows& rows);
  const TopRows& rows() const { return rows_; }

  /// @param blocks  of all struts, of the same time.  @param first_force  among their force columns.
  void predict(const std::vector<const StrutBlock*>& blocks, int first_force);

  /// @return by band what noise of power 1 of every wheel does in the equations of one strut top: that of wheel j is in
  /// the regressors s / A, 1 / A of its own travel, by T = s^2 (s^2 I + Q)^-1 in the instruments of all struts, and by
  /// I - T in the outputs.
  const std::vector<WheelNoise>& wheelNoise(std::size_t strut, const StrutEquations& equations);

  /// @return H_0(w_j'' - z_j'') of the newest prediction, bins by struts.
  const Eigen::ArrayXXcd& travel() const { return travel_; }

 private:
  using Small = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, 0, kMostStruts, kMostStruts>;
  using SmallVector = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 1, 0, kMostStruts, 1>;

  Modulation modulation_;
  Eigen::ArrayXcd s_;
  TopRows rows_;
  Eigen::ArrayXXcd wheels_, forces_, travel_;
  Eigen::PartialPivLU<Small> lu_;
  std::vector<Small> follows_;  // T by bin
  std::vector<WheelNoise> noise_;
};

}  // namespace suspension_health_monitor
