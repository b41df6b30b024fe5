#include "suspension_health_monitor/identification/auxiliary_instruments.h"

#include <optional>

#include "suspension_health_monitor/identification/suspension_regression.h"

namespace suspension_health_monitor {

AuxiliaryInstruments::AuxiliaryInstruments(const IntegralFilterOptions& options)
    : auxiliary_(options.period), relative_(2, options), instrument_(Eigen::VectorXd::Zero(kNumStrutParameters)) {}

bool AuxiliaryInstruments::accepts(double damping_to_mass, double stiffness_to_mass) const {
  return auxiliary_.accepts(damping_to_mass, stiffness_to_mass);
}

void AuxiliaryInstruments::setModel(double damping_to_mass, double stiffness_to_mass) {
  auxiliary_.setModel(damping_to_mass, stiffness_to_mass);
}

const Eigen::VectorXd* AuxiliaryInstruments::push(double unsprung_acceleration) {
  const std::optional<double> sprung_acceleration = auxiliary_.push(unsprung_acceleration);
  if (!sprung_acceleration) return nullptr;
  relative_.push(auxiliary_.unsprungAcceleration() - *sprung_acceleration);
  if (!relative_.full()) return nullptr;
  instrument_[kDampingToMass] = relative_.output(1);
  instrument_[kStiffnessToMass] = relative_.output(0);
  return &instrument_;
}

void AuxiliaryInstruments::reset() {
  auxiliary_.reset();
  relative_.reset();
}

}  // namespace suspension_health_monitor
