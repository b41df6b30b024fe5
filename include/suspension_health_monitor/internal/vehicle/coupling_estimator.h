#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/every_n.h"
#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"
#include "suspension_health_monitor/internal/vehicle/coupling.h"
#include "suspension_health_monitor/strut_model.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What the rows of all struts say of their coupling.
struct CouplingEstimate {
  Coupling coupling;
  StrutMatrix stddevs;                             ///< of the ratios
  ForceMatrix force_stddevs;                       ///< of Coupling::forces; infinite of a force that has been still
  StrutVector damping_to_mass, stiffness_to_mass;  ///< b1_i [1/s], b0_i [1/s^2] over the same rows
  /// Of b1_i [1/s], b0_i [1/s^2] where the ratios are not known better than these rows tell them.
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kMostStruts, 2> own_stddevs;
  double condition = HUGE_VAL;  ///< of the columns of all struts, each scaled to 1
  double told_apart = 0.0;  ///< information of the combination of struts that these rows tell least of, over noise's
  int first_alike = 0, second_alike = 0;  ///< the two struts that it is about
  double doubt = HUGE_VAL;  ///< largest rms that these errors give a strut's own acceleration, as a share of it

  /// @return true if the ratios may be relied upon.
  bool isKnown() const;

  /// @return the linear struts.
  std::vector<StrutModel> models() const;
};

/// Estimates how the struts of a vehicle move one another from the rows of all of them,
///   I_2^2 z_i'' = sum_j rho_ij (b1_j I_1^2 u_j + b0_j I_0^2 u_j) + sum_k kappa_ik I_2^2 x_k + c_i + e_i,
/// by least squares over a long memory: rho does not wear. The right side is linear in rho for given b1, b0 and the
/// other way round; solve() alternates between the two, each step of which lowers the sum of squares. The moments that
/// the sensors' noise has of itself are taken off: their pattern is that of the rows that follow one wrong reading of
/// every sensor, their size what the rows leave at least.
///
/// An anti-roll bar is looked for between every two struts: it stays if it takes more of what is left than chance, and
/// more than any law in one strut would (lookForBars()).
///
/// A known force counts from its first value: one that never changes moves nothing, and of it nothing is known.
///
/// Tracks that are alike move struts alike: then the rows' information of some combination of struts is not clear of
/// that of noise, and nothing is known.
/// Cost per sample: O(N) and, every eighth of a horizon, O(N^2); no allocation.
class CouplingEstimator {
 public:
  /// @param memory  of the rows [samples].
  CouplingEstimator(int num_struts, int num_forces, const IntegralFilterOptions& filter, double memory,
                    const SensorNoise& noise);

  /// From the next solve() on.
  void setNoise(const SensorNoise& noise);

  /// Takes in the next sample of an uninterrupted uniform series.
  void add(const VehicleSample& sample);

  /// After a gap.
  void startNewSeries();

  /// @return what is known by now; O(N^3).
  const CouplingEstimate& solve();

  const CouplingEstimate& estimate() const { return estimate_; }

 private:
  static constexpr int kMostColumns = 3 * kMostStruts + kMostKnownForces + 1;
  using Row = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostColumns, 1>;
  using Moments = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostColumns, kMostColumns>;

  /// What the struts do of their own is linear in.
  struct OwnUnknowns {
    Eigen::MatrixXd columns;  ///< by unknown, what one of it is as a combination of I_1^2 u, I_0^2 u of all struts
    std::vector<int> place;   ///< the strut that it belongs to
  };

  OwnUnknowns ownUnknowns() const;
  bool fillRow(const VehicleSample& sample);
  double weightOfRow();
  bool start(const Moments& moments);
  void solveRatios(const Moments& moments);
  void solveStruts(const Moments& moments);
  void refine(const Moments& plain, int steps);
  void lookForBars(const Moments& plain);
  bool addBar(const Moments& plain);
  double shareLeft(const Moments& plain) const;
  bool isCertain(double left, double less) const;
  Row ownColumns(int j) const;
  Moments combined(const Moments& moments) const;
  double sensorVariance(const Moments& moments) const;
  void describe(const Moments& plain, const Moments& moments, double sensor_variance);
  void describeAlike(const Moments& plain, double sensor_variance);
  double describeErrors(const Moments& moments, const Moments& of_struts, const StrutVector& rest);
  StrutVector restOf(const Moments& moments) const;

  int num_struts_, num_forces_, fill_;  // fill_: samples until there are rows
  double forgetting_factor_;            // of a row that is taken
  std::vector<SuspensionRegression> regressions_;
  std::vector<LinearIntegralFilter> forces_;
  ForceVector first_forces_;  // empty before the first sample
  EveryN row_due_;
  Row row_;          // I_1^2 u_j, I_0^2 u_j, I_2^2 x_k, I_2^2 z_i'', 1
  Moments moments_;  // mean of row row'
  Moments noise_;    // the same of noise whose standard deviation is 1 in every sensor
  double weight_ = 0.0;
  LimitedMean usual_rest_;
  bool has_start_ = false;
  double valley_doubt_ = 0.0;  // of start()
  std::vector<std::pair<int, int>> bars_;  // between which struts
  CouplingEstimate estimate_;
};

}  // namespace suspension_health_monitor
