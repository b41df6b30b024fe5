#pragma once

#include <array>
#include <vector>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/vehicle/neighbour_weights.h"
#include "suspension_health_monitor/internal/vehicle/travel_observer.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Takes what the other struts do to the body out of both signals of every strut,
///   S_i = z_i'' - n_i,   W_i = w_i'' - n_i,   n_i = sum_{j != i} rho_ij p_j + sum_k kappa_ik x_k (NeighbourWeights),
/// so that S_i = p_i and W_i - S_i = w_i'' - z_i'': what is left is a quarter car, with the strut's own b1 and b0.
///
/// The travel of the neighbours is forgotten below a fiftieth of the natural frequency: slower than that only what
/// their models miss would be told, and above it the phase is right to 3 %. What is wrong in n_i there is the same in
/// S_i and W_i, which a strut follows at such frequencies as it does gravity.
/// The answer comes kDelay samples late. Cost per sample: O(N^2), no allocation.
class Decoupler {
 public:
  static constexpr int kDelay = TravelObserver::kDelay;  ///< samples

  /// @param period  T [s].
  Decoupler(int num_struts, double period);

  /// From the next sample on.
  void setCoupling(const Coupling& coupling) { weights_ = NeighbourWeights(coupling); }

  /// The model of strut j, where it shows in others.
  void setModel(int j, const StrutModel& model);

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @return S and W as a sample of the vehicle, kDelay before this one, valid until the next call; nullptr: the series
  /// is too short yet.
  const VehicleSample* push(const VehicleSample& sample);

  /// After a gap.
  void startNewSeries();

 private:
  /// What is followed of one strut.
  struct Strut {
    Strut(double period, double forgetting_factor);
    StrutModel model;
    TravelObserver travel;
    LimitedMean body, relative;  // gravity, and the offset between the sensors
  };

  NeighbourWeights weights_;
  std::vector<Strut> struts_;
  std::array<VehicleSample, kDelay + 1> recent_;
  std::size_t size_ = 0;  // of the series
  VehicleSample out_;
};

}  // namespace suspension_health_monitor
