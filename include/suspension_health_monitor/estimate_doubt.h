#pragma once

#include <string_view>

namespace suspension_health_monitor {

/// Why an estimate is not valid; the first that holds, in this order.
enum class EstimateDoubt {
  kNone,                 ///< it is valid
  kNoRows,               ///< the integral filter fills, at the start and after a gap
  kSensorStuck,          ///< the body's acceleration has not changed for a whole horizon
  kWrongPeriod,          ///< samples do not come at the sample period
  kFewRows,              ///< fewer rows than valid/min_rows
  kNotExcited,           ///< parked: the rows are the sensors' noise; the estimate is held
  kDampingNotExcited,    ///< the same of the damping alone; the stiffness goes on
  kStiffnessNotExcited,  ///< the same of the stiffness alone; the damping goes on
  kOutsideForce,         ///< something else than the wheel moves the body
  kNotExplained,         ///< the model explains less than valid/min_explained
  kNotAStrut,            ///< b1 or b0 is not above 0
  kNoSpread,             ///< no standard deviation can be told
  kFreeRunFails,         ///< the model, driven by the wheel, fits worse than a constant
};

/// @return a sentence for people.
std::string_view describe(EstimateDoubt doubt);

}  // namespace suspension_health_monitor
