#pragma once

#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/option_table.h"

namespace suspension_health_monitor {

/// Force effects that a user writes down as expressions, without compiling. Settings, here as YAML:
///
///   effects:
///     second_spring:
///       force: "max(0, d - gap)^2"        # per unit of the coefficient c; in d, v, t, s and the shapes, SI
///       memory_rate: "(d - s) / tau"      # optional: s', the rate of the effect's own state; s is 0 at the start
///       unit: "1/(m s^2)"                 # of c
///       finding: "second spring engages"  # optional: what a workshop would find
///       shapes:                           # numbers that do not enter linearly, at most kMostUserShapes of them
///         gap: {unit: m, scale: travel, min: 0.2, max: 3}  # scale: none, travel, travel_rate, time or frequency
///         (ShapeScale)
///
/// Expressions are muParser's, on doubles: + - * / ^, comparisons, && and ||, `a ? b : c`, numbers, _pi, _e, and its
/// functions (abs, sign, min, max, sqrt, exp, ln, log = ln, log10, tanh, sin, ...).
///
/// The laws of the result own their parser: every copy of an effect may be used on a thread of its own, without a lock;
/// one copy serves one thread at a time. Evaluating allocates nothing.
/// Takes the settings out of `values`.
/// @throws std::invalid_argument  naming effect and setting: an expression that is wrong (with the position of the
/// mistake, counted from 1), not a plain formula, or not finite at rest or in motion; a name that a built-in effect, a
/// variable or a function has; a missing, unknown or wrong setting.
std::vector<ForceEffect> takeUserEffects(OptionMap& values);

/// The search tries every combination of starting values of an effect's shapes.
inline constexpr std::size_t kMostUserShapes = 3;

}  // namespace suspension_health_monitor
