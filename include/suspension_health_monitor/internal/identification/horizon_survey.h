#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"

namespace suspension_health_monitor {

/// Finds a horizon from data alone: least squares over all rows of horizons in steps of about sqrt(2). The one is taken
/// that comes closest to what proposeHorizon() asks for with its own result. Nothing about the strut or the rate is
/// assumed. Cost per sample: one row for each of the log2(longest / shortest) * 2 horizons, no allocation.
class HorizonSurvey {
 public:
  static constexpr int kLongest = 4096;  ///< [samples], a horizon that is long enough for any strut
  static constexpr int kEnough = 40000;  ///< samples of a drive that are worth looking at
  static constexpr double kClear = 0.5;  ///< share of the output that a strut explains at least

  /// @param period  sampling time [s].
  /// @param longest  L of the longest horizon tried, >= 8.
  HorizonSurvey(double period, IntegrationRule rule, int longest);

  /// Takes in the next sample of an uninterrupted uniform series.
  void push(const CornerSample& sample);

  /// Starts anew after a gap; what was learnt stays.
  void interrupt();

  /// What the horizon gives that is proposed.
  struct Result {
    int horizon_samples;
    double damping_to_mass, stiffness_to_mass;
    double explained;  ///< share of the output that the strut explains, 0 .. 1
  };

  /// @return nothing if no horizon has given parameters of a strut yet.
  std::optional<Result> result() const;

  /// @return L; nothing if no horizon has given parameters of a strut yet.
  std::optional<int> horizonSamples() const;

  /// @return true if there is a proposal within the range of those tried, and the strut explains at least half of the
  /// output there: more of the same kind of data will not change it much.
  bool isClear() const;

  /// @return true if every horizon that has enough rows gives negative damping.
  bool dampingIsNegative() const;

 private:
  /// One horizon, and the sums over its rows (phi, psi) about their means, so that the offset between the sensors is no
  /// part of them, that least squares needs.
  struct Candidate {
    int horizon_samples;
    SuspensionRegression regression;
    Eigen::Vector3d means = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    int rows = 0;

    bool hasEnough() const;
    Eigen::Vector2d theta() const;  ///< (b1, b0)
  };

  struct Choice {
    const Candidate* candidate;
    double horizon;   ///< proposed [s]
    double distance;  ///< |log| of the ratio of that to the candidate's
  };
  std::optional<Choice> choose() const;

  double period_;
  std::vector<Candidate> candidates_;
};

/// @param period  sampling time [s].
/// @return what was learnt of the drives.
HorizonSurvey surveyOf(const std::vector<Drive>& drives, double period, std::size_t most_samples);

/// @param period  sampling time [s].
/// @param most_samples  of every drive, from its start on, that are looked at.
/// @return L that is proposed for the drives; nothing if no horizon gives a strut.
std::optional<int> surveyHorizon(const std::vector<Drive>& drives, double period, std::size_t most_samples);

}  // namespace suspension_health_monitor
