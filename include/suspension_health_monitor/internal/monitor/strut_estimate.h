#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/internal/model/strut_integrator.h"
#include "suspension_health_monitor/internal/monitor/estimate_doubt.h"

namespace suspension_health_monitor {

/// What one estimator knows of the strut. NaN: nothing yet.
struct StrutEstimate {
  double damping_to_mass = std::nan("");           ///< b1 = beta/M [1/s]
  double stiffness_to_mass = std::nan("");         ///< b0 = K/M [1/s^2]
  double damping_to_mass_stddev = std::nan("");    ///< [1/s], with the residuals' correlation and the shift by noise in
                                                   ///< the regressors; renewed every few rows
  double stiffness_to_mass_stddev = std::nan("");  ///< [1/s^2], likewise
  std::size_t num_effects = 0;                     ///< in the model
  std::array<double, StrutState::kMostEffects> coefficients{};         ///< c_j [unit of the effect's coefficient]
  std::array<double, StrutState::kMostEffects> coefficient_stddevs{};  ///< likewise
  double effective_rows = 0.0;                                         ///< rows in the estimator's memory
  double explained = 0.0;  ///< 1 - mean|epsilon| / mean|psi| over the memory: 1 all explained, 0 nothing
  EstimateDoubt doubt = EstimateDoubt::kNoRows;  ///< why it is not valid (validity_gate.h)
  double damping_excitation = std::nan("");      ///< information of phi_1 of late over that of noise (Excitation) [-]
  double stiffness_excitation = std::nan("");    ///< that of phi_0 likewise

  bool valid() const { return doubt == EstimateDoubt::kNone; }
  /// Undamped natural frequency [Hz]; NaN unless b0 >= 0.
  double naturalFrequency() const { return std::sqrt(stiffness_to_mass) / (2 * M_PI); }
  /// Damping ratio b1 / (2 sqrt(b0)) [-]; NaN unless b0 > 0.
  double dampingRatio() const { return damping_to_mass / (2 * std::sqrt(stiffness_to_mass)); }
};

}  // namespace suspension_health_monitor
