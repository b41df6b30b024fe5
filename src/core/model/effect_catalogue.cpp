#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {
namespace {

using M = StrutMotion;

constexpr bool kPositive = true, kLasts = true, kOpenBelow = true, kOpenAbove = true;

double beyondPlay(double x, double width) { return x - std::clamp(x, -width / 2.0, width / 2.0); }

// @param memory  the load's place on its spring and its speed there.  @param shapes  f [Hz], zeta.
double pullOfLoad(const Memory& memory, const double* shapes) {
  const double w = 2.0 * M_PI * shapes[0];
  return w * (2.0 * shapes[1] * memory.second + w * memory.s);
}

}  // namespace

// d travel, v travel rate, t time, s memory, c the coefficient. A new effect is one more record.
const std::vector<ForceEffect>& forceEffects() {
  static const std::vector<ForceEffect> effects{
      {"progressive_spring",
       "c d |d|^(p-1)",
       "m^(1-p)/s^2",
       "progressive or sagging coil, rubber helper",
       "Design of a progressive coil or a rubber helper; wear if the spring was linear when new: check for sagged or "
       "touching coils and a worn spring seat.",
       [](const M& m, const double* p) { return m.travel * std::pow(std::abs(m.travel), p[0] - 1.0); },
       {{"p", "-", ShapeScale::kNone, 1.5, 5.0}}},
      {"asymmetric_spring", "c |d|", "1/s^2", "different spring rate in bump and rebound",
       "Design only with a helper spring; else a fault: check for a coil that lifts off its seat and a loose spring "
       "clamp.",
       [](const M& m, const double*) { return std::abs(m.travel); }},
      {"bump_stop",
       "c max(0, d - g)",
       "1/s^2",
       "bump stop in use: overload or sag",
       "The stop is design, to be in it often is not: check load and ride height, a sagged spring, then the stop for "
       "cracks.",
       [](const M& m, const double* g) { return std::max(0.0, m.travel - g[0]); },
       {{"g", "m", ShapeScale::kTravel, 0.2, 4.0}},
       {},
       kPositive},
      {"rebound_stop",
       "c min(0, d + g)",
       "1/s^2",
       "topping out",
       "The stop is design, to be in it often is not: check ride height and rebound damping, then the stop for "
       "knocking.",
       [](const M& m, const double* g) { return std::min(0.0, m.travel + g[0]); },
       {{"g", "m", ShapeScale::kTravel, 0.2, 4.0}},
       {},
       kPositive},
      // b0 is the spring beyond the play, b0 - c the one within.
      {"backlash",
       "-c max(-w/2, min(d, w/2))",
       "1/s^2",
       "play of a worn joint or bushing",
       "Wear: a joint or bushing that moves freely before it carries; check ball joints, bushings and the stabiliser's "
       "links for play of the width w.",
       [](const M& m, const double* w) { return beyondPlay(m.travel, w[0]) - m.travel; },
       {{"w", "m", ShapeScale::kTravel, 0.2, 4.0}},
       {},
       kPositive},
      {"coulomb_friction",
       "c tanh(v/vs)",
       "m/s^2",
       "dry friction: seal, bent rod, top mount",
       "A little is design of any seal; more than when new is wear: check for a bent or scored rod, a dry seal, a top "
       "mount or bushing that binds.",
       [](const M& m, const double* vs) { return std::tanh(m.travel_rate / vs[0]); },
       {{"vs", "m/s", ShapeScale::kTravelRate, 0.01, 0.5, kOpenBelow}},
       {},
       kPositive},
      {"quadratic_damping",
       "c v |v|",
       "1/m",
       "orifice flow in the damper",
       "Design, not wear: oil through an orifice; check oil and valve only if the damper was linear when new.",
       [](const M& m, const double*) { return m.travel_rate * std::abs(m.travel_rate); },
       {},
       {},
       kPositive},
      {"asymmetric_damping", "c |v|", "1/s", "bump and rebound valves differ",
       "Design of most dampers, harder in rebound than in bump; check the valve of the softer direction if it has "
       "grown since new.",
       [](const M& m, const double*) { return std::abs(m.travel_rate); }},
      {"digressive_damping",
       "c v / sqrt(1 + (v/v0)^2)",
       "1/s",
       "blow-off valve of the damper",
       "Design of a damper with a blow-off valve; wear if the valve opens earlier than when new: check its shims and "
       "spring.",
       [](const M& m, const double* v0) {
         const double ratio = m.travel_rate / v0[0];
         return m.travel_rate / std::sqrt(1.0 + ratio * ratio);
       },
       {{"v0", "m/s", ShapeScale::kTravelRate, 0.2, 3.0}},
       {},
       kPositive},
      {"position_dependent_damping",
       "c d^2 v",
       "1/(m^2 s)",
       "bypass damper",
       "Design of a bypass damper; in any other wear: check the tube for scoring or a dent where the piston runs most.",
       [](const M& m, const double*) { return m.travel * m.travel * m.travel_rate; },
       {},
       {},
       kPositive},
      {"hysteresis",
       "c s, s' = (v - |v| s)/x",
       "m/s^2",
       "rubber bushing, pre-sliding friction (Dahl)",
       "Design of rubber bushings; more than when new is wear: check bushings and top mount for cracked rubber and "
       "joints that bind.",
       [](const M& m, const double*) { return m.memory; },
       {{"x", "m", ShapeScale::kTravel, 0.05, 3.0}},
       [](const M& m, const double* x) { return (m.travel_rate - std::abs(m.travel_rate) * m.memory) / x[0]; },
       kPositive},
      {"bouc_wen",
       "c s, s' = v - |v| s/xa + v |s|/xb",
       "1/s^2",
       "rubber bushing, wire rope mount: hysteresis that stiffens",
       "Design of rubber bushings and wire rope mounts; more than when new is wear: check them for cracks, broken "
       "strands and loose bolts.",
       [](const M& m, const double*) { return m.memory; },
       {{"xa", "m", ShapeScale::kTravel, 0.1, 3.0}, {"xb", "m", ShapeScale::kTravel, 0.1, 3.0}},
       [](const M& m, const double* x) {
         return m.travel_rate - std::abs(m.travel_rate) * m.memory / x[0] + m.travel_rate * std::abs(m.memory) / x[1];
       },
       kPositive},
      {"viscoelastic_mount",
       "c (d - s), s' = (d - s)/tau",
       "1/s^2",
       "top mount in series (Maxwell)",
       "Design of a soft top mount; wear if it has become softer: check its rubber for cracks and its nut for torque.",
       [](const M& m, const double*) { return m.travel - m.memory; },
       {{"tau", "s", ShapeScale::kTime, 0.1, 10.0}},
       [](const M& m, const double* tau) { return (m.travel - m.memory) / tau[0]; },
       kPositive},
      // s the rod's place: it moves as its joint pulls. The end without play is viscoelastic_mount.
      {"damper_backlash",
       "c x, x = d - s beyond +-w/2, s' = x/tau",
       "1/s^2",
       "damper with play in its eye or top mount",
       "Wear: the damper pulls only after the play w; check its eyes, the bushings in them and the top mount's nut, "
       "and the damper itself for air in the oil.",
       [](const M& m, const double* p) { return beyondPlay(m.travel - m.memory, p[0]); },
       {{"w", "m", ShapeScale::kTravel, 0.05, 4.0}, {"tau", "s", ShapeScale::kTime, 0.01, 10.0}},
       [](const M& m, const double* p) { return beyondPlay(m.travel - m.memory, p[0]) / p[1]; },
       kPositive},
      // The body's velocity is its acceleration, integrated with a memory that is long against the strut's motion.
      {"body_drag",
       "-c s, s' = z'' - s/tau",
       "1/s",
       "drag of the body itself: guides, a towed load",
       "Neither design nor wear of the strut, it holds the body itself: check guides, cables, hoses and what is towed.",
       [](const M& m, const double*) { return -m.memory; },
       {{"tau", "s", ShapeScale::kTime, 10.0, 30.0, kOpenBelow, kOpenAbove}},
       [](const M& m, const double* tau) { return m.body_acceleration - m.memory / tau[0]; },
       kPositive},
      // s the load's place on its spring, counted from rest; c its mass, per mass of the body.
      {"load_on_spring",
       "c r, r = 2 zeta w s' + w^2 s = -z'' - s'', w = 2 pi f",
       "-",
       "load with a spring of its own: passenger, tank, cargo on mounts",
       "Neither design nor wear of the strut, it is what the body carries: a passenger, a tank or cargo on mounts; if "
       "nothing is loaded, check what is bolted to the body for a mount that is loose.",
       [](const M& m, const double* p) { return pullOfLoad(m.memory, p); },
       {{"f", "Hz", ShapeScale::kFrequency, 0.5, 20.0}, {"zeta", "-", ShapeScale::kNone, 0.05, 2.0, kOpenBelow}},
       [](const M& m, const double* p) {
         return Memory(m.memory.second, -m.body_acceleration - pullOfLoad(m.memory, p));
       },
       kPositive},
      // Heat comes as the damper's power, v^2, and goes as the damper is warmer than its surroundings. s counts from
      // how warm it was at the start, as a drive of that rms rate would have made it.
      {"warming",
       "-c s v, s' = (v^2 - vh^2 - s)/tc",
       "s/m^2",
       "damper that gets warm: thin oil",
       "Design as far as any oil gets thinner, and it comes back after a rest; more than when new is wear: check the "
       "damper for oil and for the right grade.",
       [](const M& m, const double*) { return -m.memory * m.travel_rate; },
       {{"tc", "s", ShapeScale::kTime, 100.0, 8000.0}, {"vh", "m/s", ShapeScale::kTravelRate, 0.3, 2.0, kOpenBelow}},
       [](const M& m, const double* p) { return (m.travel_rate * m.travel_rate - p[1] * p[1] - m.memory) / p[0]; },
       kPositive,
       kLasts},
      {"damping_drift", "c t v", "1/s^2", "damping changes during the drive: oil loss, heat",
       "Wear if it stays, heat if it comes back: check the damper for oil, and drive again with a cold one.",
       [](const M& m, const double*) { return m.time * m.travel_rate; }},
      {"stiffness_drift", "c t d", "1/s^3", "stiffness changes during the drive: broken coil, load",
       "Damage, unless the load has changed while driving: check for a broken coil or an air spring that leaks.",
       [](const M& m, const double*) { return m.time * m.travel; }},
  };
  return effects;
}

EffectLibrary builtInEffects() { return {forceEffects(), measurementEffects()}; }

}  // namespace suspension_health_monitor
