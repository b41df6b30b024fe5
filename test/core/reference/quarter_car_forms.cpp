#include "quarter_car_forms.h"

#include <stdexcept>

namespace suspension_health_monitor {

RoadDrivenForm roadDrivenForm(const QuarterCar& car) {
  if (!car.tyre_stiffness) {
    throw std::invalid_argument(
        "tyre_stiffness = none [N/m], must be given for the road-driven form: a rigid wheel has w = mu and no state");
  }
  const double b1 = car.dampingToMass();
  const double b0 = car.stiffnessToMass();
  const double m = car.unsprung_mass;
  const double k0 = *car.tyre_stiffness;
  RoadDrivenForm form;
  form.a << 0.0, 0.0, 1.0, 0.0,  //
      0.0, 0.0, 0.0, 1.0,        //
      -b0, b0, -b1, b1,          //
      car.stiffness / m, -(car.stiffness + k0) / m, car.damping / m, -car.damping / m;
  form.b << 0.0, 0.0, 0.0, k0 / m;
  return form;
}

WheelDrivenForm wheelDrivenForm(const QuarterCar& car) {
  const double b1 = car.dampingToMass();
  const double b0 = car.stiffnessToMass();
  WheelDrivenForm form;
  form.a << 0.0, 1.0, -b0, -b1;
  form.b << 0.0, 1.0;
  form.c << b0, b1;
  return form;
}

}  // namespace suspension_health_monitor
