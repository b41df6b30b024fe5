#pragma once

namespace suspension_health_monitor {

/// Why an estimate is not valid: the first that holds, in this order. The rules stand in validity_gate.cpp.
enum class EstimateDoubt {
  kNone,                 ///< it is valid
  kWrongPeriod,          ///< samples do not come at the sample period
  kNoRows,               ///< the integral filter fills, at the start and after a gap
  kSensorStuck,          ///< the body's acceleration has not changed for a whole horizon
  kFewRows,              ///< fewer rows than an estimate needs
  kNotExcited,           ///< parked: the rows are the sensors' noise; the estimate is held
  kDampingNotExcited,    ///< the same of the damping alone; the stiffness goes on
  kStiffnessNotExcited,  ///< the same of the stiffness alone; the damping goes on
  kOutsideForce,         ///< something else than the wheel moves the body
  kNotExplained,         ///< the model explains less than half of what was measured
  kNotAStrut,            ///< a parameter that has to be above 0 is not
  kNoSpread,             ///< no standard deviation can be told
  kFreeRunFails,         ///< the model, driven by the wheel, fits worse than a constant
};

}  // namespace suspension_health_monitor
