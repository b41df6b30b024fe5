#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Why an estimate is not valid: the first that holds, in this order. The rules stand in validity_gate.cpp.
enum class EstimateDoubt {
  kNone,                 ///< it is valid
  kWrongPeriod,          ///< samples do not come at the sample period
  kWrongUnit,            ///< one of the IMUs reads in g
  kNoRows,               ///< the integral filter fills, or the first blocks do, at the start and after a gap
  kFewRows,              ///< LS and LA have seen fewer rows than they need
  kNotExcited,           ///< too little motion: neither damping nor stiffness is known to kMostRelativeStddev
  kDampingNotExcited,    ///< the same of the damping alone
  kStiffnessNotExcited,  ///< the same of the stiffness alone
  kNotExplained,         ///< the strut explains less than half of the body's motion
  kNotAStrut,            ///< a parameter that has to be above 0 is not
  kVehicleFile,          ///< the drives contradict the vehicle file, or the body's gyro is dead
  kOldData,              ///< the vehicle has not moved for longer than health/oldest_data
  kDisagrees,            ///< LS or LA is not what the block estimate says
  kFreeRunFails,         ///< the model, driven by the wheel, fits worse than a constant
  kModelError,           ///< what a vehicle's model lacks moves absolute values by more than kMostRelativeStddev
};

/// @return a sentence for people.
std::string describe(EstimateDoubt doubt);

/// @return of each effect nothing yet.
inline std::array<double, kMostEffects> unknownCoefficients() {
  std::array<double, kMostEffects> unknown{};
  unknown.fill(std::nan(""));
  return unknown;
}

/// Dry friction of the strut, which is estimated beside b1 and b0. The force does not depend on the road; what a linear
/// strut without friction would have to add to b1 for it does: the smoother the road, the more.
struct DryFriction {
  double force = 0.0;         ///< f over the body's mass [m/s^2]; a damper that is harder the faster it moves has f < 0
  double stddev = 0.0;        ///< [m/s^2]
  double damping_gain = 0.0;  ///< g: 1 m/s^2 of friction acts as so much of b1 at the present travel rate [s/m]
  double damping_covariance = 0.0;  ///< of the errors of b1 and f [m/s^3]
  double stiffness_gain = 0.0;      ///< 1 m/s^2 acts as so much of b0 where the strut sticks [1/m]

  static constexpr double kLawUnknown = 0.1;  ///< of what friction acts as, measured by friction_table

  /// @return standard deviation of b1 since no damper has exactly this law [1/s].
  double lawStddev() const { return kLawUnknown * std::abs(force) * damping_gain; }

  /// @return likewise of b0 [1/s^2]: half as much, since friction that slides is out of phase with the travel.
  double stiffnessLawStddev() const { return 0.5 * kLawUnknown * std::abs(force) * stiffness_gain; }
};

/// A stretch of a drive in which the strut differs from that of the rest, beyond chance and by more than another road
/// makes it differ.
struct ChangedStretch {
  double from = 0.0, to = 0.0;  ///< since the start of the first block, gaps left out [s]
  double damping = 0.0;         ///< b1 of the stretch over that of the rest, less 1 [-]
  double stiffness = 0.0;       ///< b0 likewise [-]
};

/// What one estimator knows of the strut. NaN: nothing yet; an infinite standard deviation: nobody knows.
struct StrutEstimate {
  double damping_to_mass = std::nan("");           ///< b1 = beta/M [1/s]
  double stiffness_to_mass = std::nan("");         ///< b0 = K/M [1/s^2]
  double damping_to_mass_stddev = std::nan("");    ///< [1/s]; changes are judged by it; that of LS and LA is of their
                                                   ///< own scatter only
  double stiffness_to_mass_stddev = std::nan("");  ///< [1/s^2], likewise
  double damping_model_stddev = 0.0;  ///< of b1, by what the model lacks: links, bushings, laws [1/s]. It is no part of
                                      ///< changes, and 0 but in struts of a vehicle (fitRigidBody)
  double stiffness_model_stddev = 0.0;  ///< likewise of b0 [1/s^2]
  double correlation = 0.0;             ///< of the errors of b1 and b0 [-]; of the block estimate
  std::size_t num_effects = 0;          ///< in the model
  std::array<double, kMostEffects> coefficients = unknownCoefficients();  ///< c_j [unit of the effect's coefficient]
  std::array<double, kMostEffects> coefficient_stddevs = unknownCoefficients();  ///< likewise
  double offset = std::nan("");        ///< of the wheel carrier's reading against the body's [m/s^2]; of LS and LA
  double delay = std::nan("");         ///< by which the wheel carrier's readings are stamped late [s]; of the blocks
  double delay_stddev = std::nan("");  ///< [s]
  /// Of the body's sensor over that of the wheel's, less 1 [-]; of the blocks, where it is more than 5 %, else 0.
  double gain = std::nan("");
  double gain_stddev = std::nan("");    ///< [-]
  std::optional<DryFriction> friction;  ///< of the blocks; empty: other effects are in the model
  double effective_rows = 0.0;          ///< rows in the memory of LS, LA; blocks of the window
  double explained = 0.0;               ///< LS, LA: 1 - mean |epsilon| / mean |psi|; blocks: share of the body's power
  double tails = 0.0;  ///< mean square of the residuals of LS, LA over their squared mean size [-]: 1.57 if normal
  double age = std::nan("");             ///< of what the block estimate rests on [s], on average
  double window = std::nan("");          ///< span of its blocks [s]
  double roughest = 1.0;                 ///< information of the best quarter of that span over the mean of four [-]
  std::optional<double> temperature;     ///< of the damper [deg C]; empty: it has no thermometer
  std::optional<ChangedStretch> change;  ///< of the blocks over a whole drive; empty: it is one strut
  EstimateDoubt doubt = EstimateDoubt::kNoRows;  ///< why it is not valid (validity_gate.h)

  bool valid() const { return doubt == EstimateDoubt::kNone; }
  /// @return true if changes of b1 and b0 can be told, whatever the absolute values are.
  bool tellsChanges() const { return valid() || doubt == EstimateDoubt::kModelError; }
  /// Standard deviations of b1 [1/s] and b0 [1/s^2] as absolute values.
  double dampingAbsoluteStddev() const { return std::hypot(damping_to_mass_stddev, damping_model_stddev); }
  double stiffnessAbsoluteStddev() const { return std::hypot(stiffness_to_mass_stddev, stiffness_model_stddev); }
  /// @return half the width of the interval that holds b1, and b0, 95 times of 100, over its size: the larger one [-].
  double knownTo() const {
    return 1.96 * std::fmax(damping_to_mass_stddev / damping_to_mass, stiffness_to_mass_stddev / stiffness_to_mass);
  }
  /// @return more driving on this road until knownTo() is that small [s]: standard deviations fall with the square root
  /// of the time. 0: it is; NaN: nothing is known.
  double secondsUntil(double known_to) const {
    return window * std::fmax(0.0, std::pow(knownTo() / known_to, 2) - 1.0);
  }
  /// Undamped natural frequency [Hz]; NaN unless b0 >= 0.
  double naturalFrequency() const { return std::sqrt(stiffness_to_mass) / (2 * M_PI); }
  /// Damping ratio b1 / (2 sqrt(b0)) [-]; NaN unless b0 > 0.
  double dampingRatio() const { return damping_to_mass / (2 * std::sqrt(stiffness_to_mass)); }
};

/// How the healthy strut's damping goes with the temperature of its damper: ln b1 changes by per_kelvin. The oil of
/// dampers loses 0.1 to 1 % of its damping per kelvin, so before anything is learned it is 0 +- kPriorStddev.
struct DamperTemperature {
  static constexpr double kPriorStddev = 0.005;  ///< [1/K]
  double celsius = 0.0;                          ///< at which the baseline's b1 holds
  double per_kelvin = 0.0;                       ///< d ln b1 / dT [1/K]
  double per_kelvin_stddev = kPriorStddev;       ///< [1/K]
};

/// What one estimator knows of wheel and tyre. NaN: nothing yet.
struct WheelEstimate {
  double damping_to_wheel_mass = std::nan("");           ///< beta/m [1/s]
  double stiffness_to_wheel_mass = std::nan("");         ///< K/m [1/s^2]
  double tyre_to_wheel_mass = std::nan("");              ///< K0/m [1/s^2]
  double damping_to_wheel_mass_stddev = std::nan("");    ///< [1/s], with the residuals' correlation
  double stiffness_to_wheel_mass_stddev = std::nan("");  ///< [1/s^2], likewise
  double tyre_to_wheel_mass_stddev = std::nan("");       ///< [1/s^2], likewise
  double effective_rows = 0.0;                           ///< rows in the estimator's memory
  double explained = 0.0;                                ///< 1 - mean|epsilon| / mean|psi| over the memory
  EstimateDoubt doubt = EstimateDoubt::kNoRows;          ///< why it is not valid (validity_gate.h)

  bool valid() const { return doubt == EstimateDoubt::kNone; }
  /// @return undamped natural frequency of the wheel between strut and tyre, the body held fast [Hz].
  double wheelHopFrequency() const { return std::sqrt(stiffness_to_wheel_mass + tyre_to_wheel_mass) / (2 * M_PI); }
};

/// @return m/M = b1 / (beta/m) [-], the share of the wheel's mass in the body's; none unless both are valid.
std::optional<double> massRatio(const StrutEstimate& strut, const WheelEstimate& tyre);

struct TyreReport {
  bool has_row = false;  ///< the newest sample gave a regression row
  WheelEstimate ls, la;
};

/// The model, driven by the measured wheel acceleration, against the measured body acceleration at one sample.
struct ComparisonReport {
  bool has_sample = false;         ///< false at the first FreeRun::kDelay samples of a series: the rest then holds
  Stamp stamp{};                   ///< of the compared sample, FreeRun::kDelay before the newest
  double measured = std::nan("");  ///< z'' [m/s^2]
  std::optional<double>
      predicted;               ///< by the free run with the estimate's parameters [m/s^2]; empty until it has settled
  double rmse = std::nan("");  ///< over the window [m/s^2]; renewed every few samples, as what follows
  double fit_percent = std::nan("");
  double base_rmse = std::nan("");  ///< the same of the model without effects
  double base_fit_percent = std::nan("");
};

/// What is known of one model after one sample.
struct ModelReport {
  bool has_row = false;    ///< the sample gave a regression row; false while the filter fills: the estimates then hold
  StrutEstimate estimate;  ///< of the blocks (internal/blocks): what to trust
  StrutEstimate ls, la;    ///< the paper's, renewed with every row
  ComparisonReport comparison;
};

/// Severity, numbered as in diagnostic_msgs/DiagnosticStatus.
enum class HealthLevel : unsigned char { kOk = 0, kWarn = 1, kError = 2, kStale = 3 };

/// What is wrong with the sensors, or how they are read, rather than with the strut.
enum class SensorFault : unsigned char {
  kNone,
  kSprungStuck,      ///< the body's IMU reads one value while the other moves
  kUnsprungStuck,    ///< the wheel carrier's IMU, likewise
  kOtherAxis,        ///< gravity is on another axis of an IMU than the settings say, and no estimate is valid
  kInG,              ///< one IMU reads 1 on average where the other reads gravity
  kNegativeDamping,  ///< damping is certainly negative
  kUnrelated,        ///< both move, but the one is not what a strut makes of the other
  kGainsDiffer,      ///< of slow motion, which a strut passes as it is, one reads more than the other
};

/// What was found, with the mean readings [m/s^2] that say so.
struct SensorReport {
  SensorFault fault = SensorFault::kNone;
  std::array<double, 2> mean{};  ///< sprung, unsprung
  double gain = 0.0;             ///< StrutEstimate::gain, of kGainsDiffer
  /// Of kOtherAxis: what gravity says points up, "x" to "-z"; sprung, unsprung; empty: as the settings say.
  std::array<std::string_view, 2> up{};
};

/// @return the finding in words for a person; empty for kNone.
std::string describe(const SensorReport& report);

/// What a load on the body explains as well as damage does. Heavier, or worn?
enum class LoadDoubt : unsigned char {
  kNone,
  kLoadOrDamper,  ///< damping has certainly changed; whether stiffness has as much is not known yet
  kLoadOrSpring,  ///< the other way round
  kLoadOrBoth,    ///< both are lower alike: a load, or damper and spring worn alike
};

/// The healthy strut, to judge changes by. Standard deviations are 0 for values that somebody has given.
struct Baseline {
  std::optional<double> damping_to_mass;    ///< b1 [1/s]
  std::optional<double> stiffness_to_mass;  ///< b0 [1/s^2]
  double damping_to_mass_stddev = 0.0;      ///< [1/s]
  double stiffness_to_mass_stddev = 0.0;    ///< [1/s^2]
  /// By how much windows of the healthy strut scatter beyond their own standard deviations, for example by side forces
  /// in bends [1/s], [1/s^2]. In the standard deviation of every change.
  double damping_scatter = 0.0, stiffness_scatter = 0.0;
  std::optional<DryFriction> friction;           ///< when it was learned; empty: it is not known
  std::optional<DamperTemperature> temperature;  ///< likewise
  bool learned = false;                          ///< from a drive; false: nominal values
  Stamp from{}, to{};                            ///< the drive that it was learned from

  bool isEmpty() const { return !damping_to_mass && !stiffness_to_mass; }
};

/// What is known of the strut's condition.
struct HealthReport {
  HealthLevel level = HealthLevel::kStale;
  std::optional<double> damping_change;    ///< beta / healthy - 1 [-]; empty without healthy value or estimate
  std::optional<double> stiffness_change;  ///< K / healthy - 1 [-]
  std::optional<double> payload_change;    ///< M / healthy - 1 [-]; needs both healthy values
  /// What all dampers of a vehicle have changed alike [-], as they warm or cool, where that is why there is no warning.
  std::optional<double> shared_damping_change;
  double damping_stddev = std::nan("");  ///< of ln(1 + change); NaN: not known
  double stiffness_stddev = std::nan("");
  double damping_significance = std::nan("");  ///< change in its standard deviations, or less: a load may explain it
  double stiffness_significance = std::nan("");
  HealthLevel damping_level = HealthLevel::kOk;
  HealthLevel stiffness_level = HealthLevel::kOk;
  double known_to = std::nan("");      ///< StrutEstimate::knownTo() of the newest estimate; NaN: there is none
  double seconds_more = std::nan("");  ///< secondsUntil(enough) [s]
  double roughest = 1.0;               ///< StrutEstimate::roughest
  double enough = std::nan("");        ///< HealthThresholds::enough() [-]
  EstimateDoubt doubt = EstimateDoubt::kNoRows;  ///< why the estimate of the blocks is not valid
  bool uncertain = false;       ///< valid, but a change as large as the error threshold would not be significant
  bool friction_doubt = false;  ///< `uncertain`, mainly because friction acts otherwise than on the baseline's road
  LoadDoubt load_doubt = LoadDoubt::kNone;
  bool early_warning = false;  ///< a small change is certain before it reaches a threshold; raises no level
  bool outliers = false;       ///< residuals of LS have had heavy tails for long: outliers or saturation
  SensorReport sensor;
  bool learned = false;             ///< judged by a baseline from a drive, else by nominal values
  std::optional<double> learning;   ///< progress 0..1 of learning the baseline
  bool learning_restarted = false;  ///< because the strut was changing
};

/// @return the report in one sentence for a person, e.g. "damping 31 % below baseline (28 to 34 %), stiffness
/// at baseline"; the interval holds the truth 95 times of 100.
std::string describe(const HealthReport& report);

/// Everything that is known after one sample.
struct MonitorReport : ModelReport {
  Stamp stamp{};          ///< of the row's sample: the newest; with effects in the model FreeRun::kDelay before it
  double measured = 0.0;  ///< z'' at this stamp [m/s^2]
  HealthReport health;
};

/// How the input has been so far.
struct InputStatus {
  std::uint64_t samples = 0;   ///< taken in
  std::uint64_t rows = 0;      ///< regression rows that they gave
  std::uint64_t gaps = 0;      ///< interruptions of at least one sample, after which the filter filled anew
  std::uint64_t restarts = 0;  ///< times that the clock went back and the series began anew
  double mean_period = 0.0;    ///< of uninterrupted samples of late [s], as of the newest judgement; 0: none yet
  bool period_fits = true;     ///< mean_period is within 2 % of the sample period, or not yet certain
  bool unit_fits = true;       ///< no mean reading is that of a sensor in g

  double beyond_strut = 0.0;        ///< share of the body's power above the strut's band, in [0, 1]
  double beyond_strut_level = 0.0;  ///< and its rms [m/s^2]
};

/// @return that a sensor shakes as the estimation cannot follow, in words; empty if none does.
std::string describeShaking(const InputStatus& input);

}  // namespace suspension_health_monitor
