#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/internal/option_table.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

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

}  // namespace suspension_health_monitor
