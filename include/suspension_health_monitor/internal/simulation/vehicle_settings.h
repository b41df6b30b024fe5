#pragma once

#include "suspension_health_monitor/internal/option_table.h"
#include "suspension_health_monitor/internal/simulation/vehicle.h"

namespace suspension_health_monitor {

/// Changes a vehicle by settings, and takes them out of `values`: those of kVehicleFields by their names;
/// struts/NAME/FIELD, with effects as struts/NAME/effects/EFFECT/coefficient and /SHAPE; body_imu/FIELD;
/// anti_roll_bars/NAME/OTHER, a stiffness; known_forces/NAME/FIELD, of a new force or of one that is there.
/// @throws std::invalid_argument  naming the setting, and what is allowed.
void changeVehicle(OptionMap& values, const EffectLibrary& library, Vehicle& vehicle);

/// Makes a vehicle of such settings; its struts are those that they name.
/// @throws std::invalid_argument  also naming a setting that is missing.
Vehicle takeVehicle(OptionMap& values, const EffectLibrary& library);

}  // namespace suspension_health_monitor
