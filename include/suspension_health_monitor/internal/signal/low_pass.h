#pragma once

#include <Eigen/Core>
#include <vector>

namespace suspension_health_monitor {

/// @param taps  of a LowPass; none: nothing is filtered.
/// @return the filtered signal. Where the filter reaches beyond an end, the value at the end goes on.
inline Eigen::VectorXd lowPassed(const std::vector<double>& taps, const Eigen::Ref<const Eigen::VectorXd>& signal) {
  if (taps.empty() || signal.size() == 0) return signal;
  const Eigen::Map<const Eigen::VectorXd> h(taps.data(), static_cast<Eigen::Index>(taps.size()));
  const Eigen::Index size = signal.size(), reach = h.size() / 2;
  Eigen::VectorXd extended(size + 2 * reach), passed(size);
  extended << Eigen::VectorXd::Constant(reach, signal[0]), signal, Eigen::VectorXd::Constant(reach, signal[size - 1]);
  for (Eigen::Index k = 0; k < size; ++k) passed[k] = h.dot(extended.segment(k, h.size()));
  return passed;
}

/// The same in place.
inline void passLow(const std::vector<double>& taps, std::vector<double>& signal) {
  if (taps.empty()) return;
  Eigen::Map<Eigen::VectorXd> values(signal.data(), static_cast<Eigen::Index>(signal.size()));
  values = lowPassed(taps, values);
}

}  // namespace suspension_health_monitor
