#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/identification/recursive_least_squares.h"
#include "suspension_health_monitor/identification/suspension_regression.h"

namespace suspension_health_monitor {

/// Finds a horizon from data alone: LS runs with horizons in steps of about sqrt(2), and the one is taken that comes
/// closest to what proposeHorizon() asks for with its own result. Nothing about the strut or the rate is assumed.
/// Cost per sample: one LS row for each of the log2(longest / shortest) * 2 horizons.
class HorizonSurvey {
 public:
  /// @param period  sampling time [s].
  /// @param longest  L of the longest horizon tried, >= 8.
  HorizonSurvey(double period, IntegrationRule rule, int longest);

  /// Takes in the next sample of an uninterrupted uniform series.
  void push(const CornerSample& sample);

  /// Starts anew after a gap; what was learnt stays.
  void interrupt();

  /// @return L; nothing if no horizon has given parameters of a strut yet.
  std::optional<int> horizonSamples() const;

  /// @return true if every horizon that has enough rows gives negative damping.
  bool dampingIsNegative() const;

 private:
  struct Candidate {
    int horizon_samples;
    SuspensionRegression regression;
    RecursiveLeastSquares least_squares;
  };

  double period_;
  IntegrationRule rule_;
  std::vector<Candidate> candidates_;
};

}  // namespace suspension_health_monitor
