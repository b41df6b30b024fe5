#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/circular_buffer.hpp>
#include <vector>

#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/math/delay_line.h"
#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/internal/model/strut_integrator.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Travel and travel rate of a strut from its relative acceleration u = w'' - z'' alone, integrated twice.
///
/// The unknown first travel and rate, and the noise of the sensors, make the integrals drift. A washout forgets what is
/// slower than a fiftieth of the natural frequency, d'' = u - 2 zeta omega d' - omega^2 d, at which the phase at the
/// natural frequency is right to 3 %. The rest of the drift, which is slower than the strut moves, is taken off as the
/// mean of the mean of the mean over a natural period. That has no phase, but is late by a period and a half.
/// Cost per sample: O(1), no allocation.
class TravelObserver {
 public:
  /// @param period  T [s].  @param stiffness_to_mass  b0 > 0 of the strut [1/s^2].
  /// @param natural_period  that the means are taken over [samples], even.
  TravelObserver(double period, double stiffness_to_mass, int natural_period);

  /// Takes in the next sample of an uninterrupted uniform series [m/s^2].
  void push(double relative_acceleration);

  bool full() const { return slow_.front().full(); }

  /// [samples]
  static int delayOf(int natural_period) { return kInterpolationReach + kVehicleTuning.means * natural_period / 2; }

  /// At the sample so much before the newest one, once full():
  double travel() const { return fast(0); }      ///< d [m]
  double travelRate() const { return fast(1); }  ///< v [m/s]
  /// What of the relative acceleration that travel belongs to [m/s^2]: the rest of it is slower than is observed.
  double acceleration() const { return fast(2); }

  /// After a gap.
  void startNewSeries();

 private:
  double fast(std::size_t which) const { return recent_[which].front() - slow_[which].output(0) / horizon_; }

  double period_, washout_, horizon_;
  WheelInterpolator step_;
  LimitedMean offset_;           // between the sensors
  double age_ = 0.0;             // of the series [s]
  std::array<double, 3> now_{};  // travel, rate, acceleration
  DelayLine input_{WheelInterpolator::kWidth};
  std::vector<LinearIntegralFilter> slow_;
  std::vector<boost::circular_buffer<double>> recent_;
};

/// Takes what the other struts and known forces do to the body out of both signals of every strut,
///   S_i = z_i'' - n_i,   W_i = w_i'' - n_i,
///   n_i = sum_{j != i} (b1_ij / b1_jj F1_j + b0_ij / b0_jj F0_j + rho_ij L_j) + sum_k c_ik x_k,
/// with F1 = b1 v, F0 = b0 d and L, what its effects add, by the model of strut j, and ratios from the rows of all tops
/// (BodyRows). W_i - S_i stays w_i'' - z_i'', and S_i is a quarter car's with the strut's own b1 and b0, its share of
/// an anti-roll bar among them.
///
/// The models see the travel of their struts by a TravelObserver, and with it everything is late by delay(). Travel
/// that is slower than it observes is not seen, nor the slow part E of n_i. A strut passes it nearly as it is, S = G W
/// with G near 1: what remains, (1 - G) E = G E'' / (b1 s + b0), is that of a wheel which moves by E'' / b0, and E''
/// needs no travel, only the slow part of w_j'' - z_j''. The travel observed has no mean; that of a strut has the one
/// at which its force has none, as in a free run. Behind a low-pass filter a neighbour's travel is observed with what
/// its wheel did before it, and what its model says passes it: the law of a filtered travel is not the filtered law.
/// Cost per sample: O(N^2 + N taps), no allocation.
class Decoupler {
 public:
  /// @param period  T [s].  @param models  of the struts, b0 > 0: as they show in others.
  /// @param low_pass  taps of the filter that samples have passed, if they come with what the wheels did before it
  /// (LowPass); none: models see the motion of the samples.
  Decoupler(double period, const BodyRows& rows, const std::vector<StrutModel>& models,
            const std::vector<double>& low_pass = {});

  /// From the next sample on. Effects with a memory go on with what they remember.
  void setRows(const BodyRows& rows);
  void setModel(std::size_t strut, const StrutModel& model) { struts_[strut].model = model; }

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @return S and W as a sample of the vehicle, delay() before this one, valid until the next call; nullptr: the
  /// series is too short yet.
  const VehicleSample* push(const VehicleSample& sample);

  int delay() const { return static_cast<int>(recent_.capacity()) - 1; }  ///< [samples]

  /// After a gap.
  void startNewSeries();

 private:
  enum Part : int { kDamper, kSpring, kLaw, kParts };  // of a strut's force over the body's mass
  /// These, then u that the travel belongs to.
  using Observed = Eigen::Matrix<double, kParts + 1, 1>;

  struct Strut {
    StrutModel model;
    TravelObserver travel;
    LimitedMean gravity;                        // of z''
    RunningMean laws;                           // of the law's force
    boost::circular_buffer<Observed> observed;  // before the filter
    StrutMotion motion{};
    std::array<Memory, kMostEffects> memory{};
  };

  void follow(Strut& strut, double body_acceleration) const;

  double period_;
  std::array<StrutMatrix, kParts> ratios_;  // of each part, 0 for j = i
  ForceMatrix forces_;                      // c_ik
  std::vector<double> taps_;                // of the low-pass filter; {1}: there is none
  std::vector<Strut> struts_;
  std::vector<LimitedMean> force_means_;  // of each x
  boost::circular_buffer<VehicleSample> recent_;
  VehicleSample out_;
};

}  // namespace suspension_health_monitor
