#pragma once

#include <array>
#include <optional>
#include <vector>

namespace suspension_health_monitor {

/// Why the rows of the struts do not tell how the body's mass is spread.
enum class InertiaDoubt {
  kNone,
  kNoPositions,  ///< it is not known where every strut stands
  kOnOneLine,    ///< fewer than three struts, or all on one line: they do not see the body turn about it
  kUncertain,    ///< the rows are too uncertain, or do not fit the positions
};

/// A number and its standard deviation.
struct Measured {
  double value, stddev;
};

/// How a rigid body's mass is spread.
struct BodyInertia {
  Measured mass_to_pitch_inertia;  ///< M/Iyy [1/m^2]
  Measured mass_to_roll_inertia;   ///< M/Ixx [1/m^2]
  Measured x, y;                   ///< of the centre of gravity, from where positions count [m]
};

struct BodyInertiaResult {
  std::optional<BodyInertia> body;
  InertiaDoubt doubt = InertiaDoubt::kNone;
};

/// By strut x ahead and y to the left of the strut's top, from any one point of the body [m].
using StrutPlaces = std::vector<std::array<double, 2>>;

struct BodyFitResult;

/// @param fit  of the rows of all struts; nothing: not known.  @param places  by strut; empty: not known.
BodyInertiaResult inertiaOf(const std::optional<BodyFitResult>& fit, const StrutPlaces& places);

}  // namespace suspension_health_monitor
