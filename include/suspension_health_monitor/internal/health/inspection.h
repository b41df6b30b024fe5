#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// From the least to the largest value that something may have.
struct ValueRange {
  double low = std::nan(""), high = low;
};

/// Wheel and tyre of a quarter car, over its sprung mass M.
struct WheelRanges {
  ValueRange mass_ratio;      ///< m/M [-]
  ValueRange tyre_to_mass{};  ///< K0/M [1/s^2]
};

/// The least load of a wheel over its static load, on a plate that moves up and down as a sine of 6 mm from top to
/// bottom: with u = 3 mm the plate's amplitude, w and z those of wheel and body, s = 2 pi i f,
///     z = H w,  H = (b1 s + b0) / (s^2 + b1 s + b0),      of  M z'' = beta (w' - z') + K (w - z)
///     K0 (u - w) = M z'' + m w''  =>  w = K0/M u / (K0/M + s^2 (H + m/M)),
/// so that the load swings by |K0 (u - w)| = M |K0/M s^2 (H + m/M) / (K0/M + s^2 (H + m/M))| u about (M + m) g. A wheel
/// that would pull at the plate leaves it: 0. Source: the method of the European Shock Absorber Manufacturers
/// Association (EUSAMA), as M. Klapka, I. Mazurek, O. Machacek describe it (Engineering Mechanics 2016).
/// @param frequency  f [Hz], >= 0.  @param mass_ratio  m/M [-], >= 0.  @param tyre_to_mass  K0/M [1/s^2], > 0.
/// @return in [0, 1].
double adhesionAt(double frequency, const LinearStrut& strut, double mass_ratio, double tyre_to_mass);

/// @return the worst of all frequencies up to 25 Hz, from where the plate of a tester runs down.
double leastAdhesion(const LinearStrut& strut, double mass_ratio, double tyre_to_mass);

enum class InspectedQuantity {
  kDampingRatio,        ///< of a strut, b1 / (2 sqrt(b0)) [-]; its limit is the least
  kDampingImbalance,    ///< of an axle, 1 - b1 of the weaker strut over that of the other [-]; its limit is the most
  kStiffnessImbalance,  ///< likewise of b0
  kAdhesion             ///< of a strut, leastAdhesion() [-]; its limit is the least
};

enum class InspectionVerdict { kPasses, kFails, kCannotTell };

/// A number of one strut or of the two of an axle, against its limit.
struct InspectedNumber {
  InspectedQuantity quantity = InspectedQuantity::kDampingRatio;
  std::vector<std::size_t> struts;  ///< one, or left and right
  double value = std::nan("");      ///< NaN: nothing is known
  ValueRange interval{};            ///< that holds the true value 95 times of 100
  double limit = 0.0;
  InspectionVerdict verdict = InspectionVerdict::kCannotTell;
  std::optional<std::size_t> weaker;  ///< strut with less damping or stiffness, of an imbalance that is known
  std::optional<double> longer;       ///< kCannotTell: so many times the data would tell; empty: no longer drive would
  std::string doubt;                  ///< why nothing is known, in words
};

/// What is asked about one strut.
struct InspectedStrut {
  std::string name;  ///< front_left, front_right, rear_left, rear_right find their axle without a place
  StrutEstimate estimate;
  std::optional<std::array<double, 2>> place;  ///< x ahead, y to the left [m]
  std::optional<WheelRanges> wheel;            ///< empty: no adhesion is asked for
  std::string doubt;                           ///< why the estimate is not to be trusted, in words; empty: it is
};

/// What workshops compare with; no law is meant.
/// - Damping ratio: Lehr's, which theta testers (ASA, MAHA 2006) tell of an axle. At 0.1 a bounce still has
///   exp(-2 pi 0.1) = 53 % of its amplitude a period later.
/// - Imbalance: limits of the difference of adhesion in use are 15 and 20 % (Bilstein's mobile tester), and up to 30 %.
///   Damping differs more than adhesion does, so this is the largest of them.
/// - Adhesion: the classes that testers by EUSAMA's method print are below 20 % bad, below 40 % weak, 60 % good.
struct InspectionLimits {
  double damping_ratio = 0.1;  ///< least [-]
  double imbalance = 0.3;      ///< most [-]
  double adhesion = 0.2;       ///< least [-]
};

struct Inspection {
  std::vector<ValueRange> frequencies;   ///< by strut the 95 % interval of the bounce [Hz]; NaN: not known
  std::vector<InspectedNumber> numbers;  ///< of the struts, then of the axles
  InspectionVerdict verdict = InspectionVerdict::kCannotTell;  ///< fails if one does, passes if all do
};

/// Judges a vehicle by itself, without nominal values. A number passes where its whole 95 % interval is on the good
/// side of its limit. It fails where a wider interval is wholly on the bad side: that of a vehicle of N numbers is so
/// wide that chance fails each of them with 1 % / N, so that it fails one of all N with 1 % at most (Bonferroni). The
/// damping ratio and the adhesion have the model's error (StrutEstimate::damping_model_stddev), the imbalance has what
/// the struts of an axle do not share of it. Cost: milliseconds, with adhesion some ten of them for each strut.
Inspection inspect(const std::vector<InspectedStrut>& struts, const InspectionLimits& limits = {});

/// @return the verdict on a number in a sentence: "fails: weaker is front right".
/// @param seconds  of data that it is from.
std::string describe(const InspectedNumber& number, const std::vector<InspectedStrut>& struts, double seconds);

}  // namespace suspension_health_monitor
