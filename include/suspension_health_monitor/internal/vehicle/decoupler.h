#pragma once

#include <array>
#include <boost/circular_buffer.hpp>
#include <vector>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/vehicle/neighbour_weights.h"
#include "suspension_health_monitor/internal/vehicle/travel_observer.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Takes what the other struts do to the body out of both signals of every strut,
///   S_i = z_i'' - n_i,   W_i = w_i'' - n_i,   n_i = sum_{j != i} rho_ij p_j + sum_k kappa_ik x_k + anti-roll bars
/// (NeighbourWeights),
/// so that S_i = p_i and W_i - S_i = w_i'' - z_i'': what is left is a quarter car, with the strut's own b1 and b0.
/// The models of the neighbours see their travel by a TravelObserver, and with it everything is late by delay(). What
/// is slower than that observes, E of n_i, is not seen. A strut passes it nearly as it is, S = G W with G near 1: what
/// it leaves, (1 - G) E = G E'' / (b1 s + b0), is that of a wheel which moves by E'' / b0, and E'' needs no travel,
/// only the slow part of u_j.
/// The travel observed has no mean; that of a strut has the one at which its force has none, as in a free run.
/// Behind a low-pass filter a neighbour's travel is observed with what its wheel did before it, and what its model says
/// passes it: the law of a filtered travel is not the filtered law. Above the filter z'' is missing in that travel, and
/// n_i in the W_i that is known unfiltered; a body moves little there.
/// Cost per sample: O(N^2 + N taps), no allocation.
class Decoupler {
 public:
  /// @param period  T [s].  @param models  of the struts, b0 > 0: as they show in others.
  /// @param low_pass  taps of the filter that samples have passed, if they come with what the wheels did before it
  /// (LowPass); none: models see the motion of the samples.
  Decoupler(double period, const Coupling& coupling, const std::vector<StrutModel>& models,
            const std::vector<double>& low_pass = {});

  /// From the next sample on. Effects with a memory go on with what they remember.
  void setCoupling(const Coupling& coupling) {
    weights_ = NeighbourWeights(coupling);
    bars_ = coupling.bars;
  }
  void setModel(std::size_t strut, const StrutModel& model) { struts_[strut].model = model; }

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @return S and W as a sample of the vehicle, delay() before this one, valid until the next call; nullptr: the
  /// series is too short yet.
  const VehicleSample* push(const VehicleSample& sample);

  int delay() const { return static_cast<int>(recent_.capacity()) - 1; }  ///< [samples]

  /// After a gap.
  void startNewSeries();

 private:
  struct Strut {
    StrutModel model;
    TravelObserver travel;
    LimitedMean gravity;                           // of z''
    RunningMean laws;                              // of the force beside b1 v + b0 d
    boost::circular_buffer<Eigen::Vector3d> told;  // before the filter: its model's force, travel, u that belongs to it
    StrutMotion motion{};
    std::array<double, kMostEffects> memory{};
  };

  void follow(Strut& strut, double body_acceleration) const;
  Eigen::Vector3d filtered(const Strut& strut) const;
  StrutVector ofBars(const StrutVector& travels) const;

  double period_;
  NeighbourWeights weights_;
  StrutMatrix bars_;
  std::vector<double> taps_;  // of the low-pass filter; {1}: there is none
  std::vector<Strut> struts_;
  std::vector<LimitedMean> force_means_;  // of each x
  boost::circular_buffer<VehicleSample> recent_;
  VehicleSample out_;
};

}  // namespace suspension_health_monitor
