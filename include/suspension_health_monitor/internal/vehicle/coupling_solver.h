#pragma once

#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/coupling_estimate.h"

namespace suspension_health_monitor {

/// From the moments of the rows of all struts to their coupling. The right side of
///   I_2^2 z_i'' = sum_j rho_ij (b1_j I_1^2 u_j + b0_j I_0^2 u_j) + sum_k kappa_ik I_2^2 x_k + c_i + e_i
/// is linear in rho for given b1, b0 and the other way round; solve() alternates between the two, each step of which
/// lowers the sum of squares, and goes on from where it has come to. The moments that the sensors' noise has of itself
/// are taken off: their pattern is known, their size is what the rows leave at least.
///
/// An anti-roll bar is looked for between every two struts: it stays if it takes more of what is left than chance, and
/// more than any law in one strut would.
class CouplingSolver {
 public:
  /// @param noise  moments of noise whose standard deviation is 1 in every sensor.
  CouplingSolver(const CouplingColumns& columns, CouplingMoments noise);

  /// From the next solve() on.
  void setNoise(const CouplingMoments& noise) { noise_ = noise; }

  /// @param moments  of rows, about their mean.  @param rows  how many of independent errors they are of.
  /// @return what is known by now; O(N^3).
  const CouplingEstimate& solve(const CouplingMoments& moments, double rows);

  const CouplingEstimate& estimate() const { return estimate_; }

  /// @return false as long as there is nothing that a row could be judged by.
  bool hasStart() const { return has_start_; }

 private:
  using Bars = std::vector<std::pair<int, int>>;
  struct Valley {
    double left;
    CouplingEstimate estimate;
  };

  bool start();
  std::vector<CouplingEstimate> beginnings() const;
  double doubtOf(const std::vector<Valley>& valleys) const;
  void refine(const Bars& bars, int steps);
  void solveRatios(const CouplingMoments& moments);
  void solveStruts(const CouplingMoments& moments, const Bars& bars);
  bool addBar();
  double shareLeft() const;
  bool isCertain(double left, double less) const;

  CouplingColumns columns_;
  CouplingMoments noise_;
  CouplingMoments moments_;  // that solve() was called with; and its rows
  double rows_ = 0.0;
  bool has_start_ = false;
  double valley_doubt_ = 0.0;  // of start()
  CouplingEstimate estimate_;
};

}  // namespace suspension_health_monitor
