#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/model/strut_model.h"
#include "suspension_health_monitor/option_table.h"

namespace suspension_health_monitor {

/// Effects with their values as settings: `effects/NAME/coefficient` and `effects/NAME/SHAPE` for every shape of the
/// effect, in SI. The simulator hides such effects; a model file holds them.
/// Takes them out of `values`.
/// @throws std::invalid_argument  naming an unknown effect or shape (and the known ones), or one that is missing.
std::vector<ActiveEffect> takeEffects(OptionMap& values, const std::vector<ForceEffect>& catalogue);

/// Faults of the measurement in the same way: `readings/NAME/coefficient`.
/// @throws std::invalid_argument  as takeEffects().
std::vector<ActiveMeasurementEffect> takeReadings(OptionMap& values, const std::vector<MeasurementEffect>& catalogue);

/// Turns `NAME=COEFFICIENT[,SHAPE=VALUE]...` into such settings.
/// @throws std::invalid_argument  if it does not have that form.
void setEffect(OptionMap& values, const std::string& assignment);

}  // namespace suspension_health_monitor
