#include "suspension_health_monitor/internal/model/quarter_car.h"

namespace suspension_health_monitor {

void validate(const QuarterCar& car) { validate(car, kQuarterCarFields); }

}  // namespace suspension_health_monitor
