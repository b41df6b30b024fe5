#pragma once

#include <algorithm>
#include <optional>
#include <string>

namespace suspension_health_monitor {

/// When a change of the strut counts, and what it is a change from.
struct HealthThresholds {
  std::optional<double> nominal_damping_to_mass;    ///< b1 of the healthy strut [1/s]
  std::optional<double> nominal_stiffness_to_mass;  ///< b0 of the healthy strut [1/s^2]
  std::optional<double> nominal_friction;           ///< its dry friction beside b1, over the body's mass [m/s^2]
  std::optional<double> nominal_friction_gain;      ///< 1 m/s^2 of it acted as so much of b1 where b1 is from [s/m]
  double damping_warn = 0.15;                       ///< relative change that is a warning [-]
  double damping_error = 0.30;                      ///< relative change that is an error [-]
  double stiffness_warn = 0.15;                     ///< [-]
  double stiffness_error = 0.30;                    ///< [-]
  double confirm_time = 0.5;                        ///< a new level must last this long before it is reported [s]
  double payload_range = 0.35;                      ///< relative change of the body's mass that may be payload; 0: none
  double oldest_data = 60.0;                        ///< of which an estimate may be, as of a parked vehicle [s]
  double learn_time = 60.0;                         ///< of valid estimates for a baseline [s]; 0: none is learned

  /// @return what b1 and b0 have to be known to, for a change as large as the error threshold to be seen well (half of
  /// it), StrutEstimate::knownTo() [-].
  double enough() const { return 0.5 * std::min(damping_error, stiffness_error); }
};

/// All settings of a StrutMonitor, flat as users write them. Unit, meaning and range of each are told by
/// `suspension_bag options monitor`, by config/monitor.yaml and by what validate() says of a value that is wrong.
struct MonitorOptions : HealthThresholds {
  std::string preset = "default";             ///< or "paper": estimators as in sections 3.2 and 4 of the paper
  std::optional<double> sample_period;        ///< T [s]; left out: measured from the stamps
  std::string alignment = "auto";             ///< or "paired", "resampled": how readings become samples
  bool tyre = false;                          ///< there is a third sensor, where the tyre touches the road
  std::optional<double> integration_horizon;  ///< h of the integral filter [s]; left out: 0.6
  std::optional<double> block_length;  ///< T of the first blocks [s]; then it follows the bounce by factors of two
  std::optional<double> memory;        ///< of LS and LA: a row that old counts 1/e [s]; left out: 2, or 10/3 of the
                                       ///< horizon if that is more
  std::optional<double> forgetting_factor;  ///< lambda, instead of memory: 1/(1 - lambda) rows [-]
  double comparison_window = 10.0;          ///< memory of the free run's rmse [s]
  std::optional<double> sprung_mass;        ///< [kg], for results in SI

  /// @param preset  "default" or "paper".
  /// @return the values of a preset, to which options are set.
  static MonitorOptions of(const std::string& preset);

  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  void validate() const;
};

}  // namespace suspension_health_monitor
