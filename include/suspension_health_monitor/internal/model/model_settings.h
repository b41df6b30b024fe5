#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/strut_model.h"

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

/// What a shape may be at all: a plain number what its law allows; one that is measured in what a drive shows, anything
/// from a billionth of its unit to a billion, as nobody has seen the drive yet.
/// @param name  as people know it, e.g. bump_stop/g.
/// @throws std::invalid_argument  with name, value, unit and the range.
void requireAllowed(const std::string& name, const ShapeParameter& shape, double value);

/// Effects with their values as settings: `effects/NAME/coefficient` and `effects/NAME/SHAPE` for every shape of the
/// effect, in SI. The simulator hides such effects; a model file holds them.
/// Takes them out of `values`.
/// @param faults  that the caller takes by takeReadings(): a complaint of an unknown name lists them, too.
/// @throws std::invalid_argument  naming an unknown effect or shape (and the known ones), or one that is missing.
std::vector<ActiveEffect> takeEffects(OptionMap& values, const std::vector<ForceEffect>& catalogue,
                                      const std::vector<MeasurementEffect>& faults = {});

/// Faults of the measurement in the same way: `readings/NAME/COEFFICIENT`, which is called `coefficient`
/// where there is only one.
/// @throws std::invalid_argument  as takeEffects().
std::vector<ActiveMeasurementEffect> takeReadings(OptionMap& values, const std::vector<MeasurementEffect>& catalogue);

/// Turns `NAME=COEFFICIENT[,SHAPE=VALUE]...` into such settings; NAME may be one of `faults`, too. Of a fault with
/// several coefficients, COEFFICIENT is the first one, the others are given like shapes or are 0.
/// @throws std::invalid_argument  if it does not have that form.
void setEffect(OptionMap& values, const std::string& assignment, const std::vector<MeasurementEffect>& faults);

/// A model as settings, all in SI:
///   damping_to_mass, stiffness_to_mass, effects/NAME/coefficient, effects/NAME/SHAPE, readings/NAME/COEFFICIENT.
/// Takes them out of `values`.
/// @param library  what the model may be made of.
/// @throws std::invalid_argument  naming a setting that is missing, unknown or wrong, its value, and what is allowed.
StrutModel takeModel(OptionMap& values, const EffectLibrary& library);

/// @return the same settings as a YAML document, units as comments. takeModel() gets every number back to the last bit.
std::string toYaml(const StrutModel& model);

}  // namespace suspension_health_monitor
