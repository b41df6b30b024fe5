#include <algorithm>
#include <array>

#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

struct Advice {
  std::string_view effect, sentence;
};

constexpr std::array kAdvice{
    Advice{"progressive_spring",
           "Design of a progressive coil or a rubber helper; wear if the spring was linear when new: check for sagged "
           "or touching coils and a worn spring seat."},
    Advice{"asymmetric_spring",
           "Design only with a helper spring; else a fault: check for a coil that lifts off its seat and a loose "
           "spring clamp."},
    Advice{"bump_stop",
           "The stop is design, to be in it often is not: check load and ride height, a sagged spring, then the stop "
           "for cracks."},
    Advice{"rebound_stop",
           "The stop is design, to be in it often is not: check ride height and rebound damping, then the stop for "
           "knocking."},
    Advice{"backlash",
           "Wear: a joint or bushing that moves freely before it carries; check ball joints, bushings "
           "and the stabiliser's links for play of the width w."},
    Advice{"coulomb_friction",
           "A little is design of any seal; more than when new is wear: check for a bent or scored rod, a dry seal, a "
           "top mount or bushing that binds."},
    Advice{"quadratic_damping",
           "Design, not wear: oil through an orifice; check oil and valve only if the damper was linear when new."},
    Advice{"asymmetric_damping",
           "Design of most dampers, harder in rebound than in bump; check the valve of the softer direction if it has "
           "grown since new."},
    Advice{"digressive_damping",
           "Design of a damper with a blow-off valve; wear if the valve opens earlier than when new: check its shims "
           "and spring."},
    Advice{"position_dependent_damping",
           "Design of a bypass damper; in any other wear: check the tube for scoring or a dent where the piston runs "
           "most."},
    Advice{"hysteresis",
           "Design of rubber bushings; more than when new is wear: check bushings and top mount for cracked rubber and "
           "joints that bind."},
    Advice{"bouc_wen",
           "Design of rubber bushings and wire rope mounts; more than when new is wear: check them for cracks, broken "
           "strands and loose bolts."},
    Advice{"viscoelastic_mount",
           "Design of a soft top mount; wear if it has become softer: check its rubber for cracks and its nut for "
           "torque."},
    Advice{
        "damper_backlash",
        "Wear: the damper pulls only after the play w; check its eyes, the bushings in them and the top mount's nut, "
        "and the damper itself for air in the oil."},
    Advice{"body_drag",
           "Neither design nor wear of the strut, it holds the body itself: check guides, cables, hoses and what is "
           "towed."},
    Advice{
        "load_on_spring",
        "Neither design nor wear of the strut, it is what the body carries: a passenger, a tank or cargo on mounts; if "
        "nothing is loaded, check what is bolted to the body for a mount that is loose."},
    Advice{
        "warming",
        "Design as far as any oil gets thinner, and it comes back after a rest; more than when new is wear: check the "
        "damper for oil and for the right grade."},
    Advice{"damping_drift",
           "Wear if it stays, heat if it comes back: check the damper for oil, and drive again with a cold one."},
    Advice{"stiffness_drift",
           "Damage, unless the load has changed while driving: check for a broken coil or an air spring that leaks."},
    Advice{"clock_offset",
           "A fault of the sensors, not of the strut: synchronise their clocks, or take the delay out of the stamps."},
    Advice{
        "accelerometer_bias",
        "A fault of the sensor, not of the strut: let it warm up, and calibrate it at rest; a few hundredths of m/s^2 "
        "in every strut may be a body that leans and turns."},
    Advice{"scale_error",
           "A fault of the sensor, not of the strut: check range and unit in its driver, and calibrate it upright and "
           "upside down."},
    Advice{"mount_tilt",
           "A fault of the sensor's mount, not of the strut: level the body's IMU, or tell its mount by target_frame."},
    Advice{"lever_arm",
           "A fault of the sensor's place, not of the strut: move the body's IMU to the top of the strut, or tell its "
           "position in a vehicle file."},
};

}  // namespace

std::string adviceOn(std::string_view effect) {
  const auto* const found =
      std::find_if(kAdvice.begin(), kAdvice.end(), [&](const Advice& advice) { return advice.effect == effect; });
  return std::string(found != kAdvice.end() ? found->sentence : "");
}

}  // namespace suspension_health_monitor
