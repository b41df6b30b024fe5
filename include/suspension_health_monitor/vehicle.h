#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/identify.h"

namespace suspension_health_monitor {

/// One Drive per strut of a vehicle, in the same order always, all with the same stamps.
using StrutDrives = std::vector<Drive>;

/// A force on the body that is measured: of an actuator, a tow bar. Or a torque.
struct KnownForceRecord {
  std::string name;
  std::vector<double> values;  ///< at the struts' stamps, in any unit, up or down positive
};

/// What the noise of the sensors makes of a vehicle's drives, where filters colour it or one IMU tells of the tops of
/// several struts: for every sensor a drive without motion in which it errs once, by its standard deviation, in a unit
/// that is the same for all. Empty: every strut has two accelerometers of its own, with white noise, all alike.
using SensorNoise = std::vector<StrutDrives>;

/// A recorded drive of a vehicle.
struct VehicleDrive {
  VehicleDrive() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): struts are a drive
  VehicleDrive(StrutDrives its_struts, std::vector<KnownForceRecord> known = {})
      : struts(std::move(its_struts)), forces(std::move(known)) {}

  StrutDrives struts;
  std::vector<KnownForceRecord> forces;  ///< in the same order always; none needs to be known
  SensorNoise noise;                     ///< that of the first drive is taken for all
  /// Of the struts' tops, x ahead and y to the left of any point of the body [m]; empty: not known, so that no
  /// anti-roll bar is looked for. Those of the first drive are taken for all.
  std::vector<std::array<double, 2>> places;
};

inline constexpr const char* kAntiRollBar = "anti_roll_bar";  ///< the name of the effect

/// A spring that resists the difference of two struts' travels, found in the drives: named `anti_roll_bar`.
struct AntiRollBarFound {
  std::size_t first, second;        ///< struts
  double first_stiffness_to_mass;   ///< of the bar, over the mass that the first strut has of the body [1/s^2]
  double second_stiffness_to_mass;  ///< the same over that of the second
};

/// What one unit of a known force does to the top of every strut [m/s^2]: of a vertical one in newtons at (x, y)
///   1/M + x_i x / Iyy + y_i y / Ixx [1/kg], with the sign of its direction.
struct KnownForceCoefficients {
  std::string name;
  std::vector<double> values;   ///< by strut
  std::vector<double> stddevs;  ///< of these; infinite of a force that never changes
};

/// How the struts of a vehicle move one another through its body: what strut j does to its own top it does to that of
/// strut i with the ratio rho_ij, of a rigid body without anti-roll bars
///   rho_ij = a_ij / a_jj,   a_ij = 1/M + x_i x_j / Iyy + y_i y_j / Ixx.
/// doc/conventions.md, Vehicles.
struct VehicleCoupling {
  std::vector<std::vector<double>> ratios;   ///< rho_ij in row i [-]; 1 for j = i
  std::vector<std::vector<double>> stddevs;  ///< of these
  std::vector<AntiRollBarFound> bars;        ///< that are part of it
  std::vector<KnownForceCoefficients> forces;
  double model_error = std::nan("");  ///< of any rigid body on linear struts, in the largest coefficient of a top [-]
  /// By strut: relative standard deviations of its damper and its spring by what the model lacks, as links [-].
  std::vector<std::array<double, 2>> strut_model_errors;
  std::string reason;  ///< why the ratios are not known, to be read after "the drives"; empty if they are

  explicit operator bool() const { return reason.empty(); }
  /// @return strut_model_errors of a strut; none of a strut alone.
  std::array<double, 2> modelErrorOf(std::size_t strut) const {
    return strut < strut_model_errors.size() ? strut_model_errors[strut] : std::array<double, 2>{};
  }
};

/// By strut the model that is known of it beforehand; a strut without one, and all where it is empty: the linear one,
/// by least squares.
using KnownModels = std::vector<std::optional<StrutModel>>;

/// Every strut on its own: what the others and known forces do to the body is taken out of both signals.
struct SeparatedVehicle {
  VehicleCoupling coupling;
  std::vector<std::vector<Drive>> struts;  ///< by strut the drives of a quarter car with its b1 and b0; empty without
                                           ///< a coupling
  std::vector<StrutModel> models;          ///< of each: as it was known, else b1, b0 by least squares over all drives
};

/// @param drives  of one vehicle, each with all of its struts.
/// @param names  of the struts, for what is said of them; a single empty one: a strut alone, whose drives stay as they
/// are, without a model.
/// @param sample_period  T [s]; nothing: the median spacing of the samples.
/// @throws std::invalid_argument  if there is no drive or no strut, if the struts of a drive have not the same stamps
/// and its forces not a value for each, if drives have not the same forces, or for a period that is not above 0; for
/// models of another number of struts.
SeparatedVehicle separateVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                 const std::optional<double>& sample_period = {}, const KnownModels& models = {});

struct VehicleIdentification {
  VehicleCoupling coupling;
  std::vector<IdentifyResult> struts;  ///< by strut; empty without a coupling

  explicit operator bool() const { return static_cast<bool>(coupling); }
};

/// identify() for every strut of a vehicle; what the coupling does not know is in the standard deviations.
/// @param options  by strut, or those of all, or none; the sample_period is that of the first.
/// @param report  IdentifyOptions::report of every strut, as samples come.
/// @throws std::invalid_argument  as separateVehicle() and identify(); for options of another number of struts.
VehicleIdentification identifyVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                      const std::vector<IdentifyOptions>& options = {},
                                      const std::function<void(std::size_t strut, const MonitorReport&)>& report = {});

/// What a search found in a vehicle.
struct VehicleDiagnosis {
  VehicleCoupling coupling;
  std::vector<Diagnosis> struts;           ///< by strut; empty without a coupling
  std::vector<std::vector<Drive>> drives;  ///< by strut those of a quarter car that it was judged by
  Verdict verdict = Verdict::kNothingMissing;
  std::string summary;  ///< in a sentence: which effect is missing in which strut

  /// @return the effects of a strut that its linear model lacks, anti-roll bars included.
  std::vector<std::string> selected(std::size_t strut) const;

  /// @return the verdict on a strut: kEffectFound also where a bar was found and what is left beside it is noise.
  Verdict verdictOn(std::size_t strut) const;

  explicit operator bool() const { return static_cast<bool>(coupling); }
};

/// diagnose() for every strut of a vehicle. An effect in one strut shows in others: what was found in the strut where
/// it explains most is taken out of them, before they are searched again, until nothing more is found. For a strut
/// alone it is diagnose().
/// @param options  by strut, or those of all, or none; sample_period and progress are those of the first.
/// @throws std::invalid_argument  as separateVehicle() and diagnose(); for options of another number of struts.
VehicleDiagnosis diagnoseVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                 const std::vector<DiagnoseOptions>& options = {}, const KnownModels& models = {});

}  // namespace suspension_health_monitor
