#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace suspension_health_monitor {

/// Calls work(p), with p as a constant of the compiler for the two parameters of the plain strut: its loops over p cost
/// no counting then. For everything on the path of a sample.
/// @param p  number of parameters.
template <class Work>
decltype(auto) withPlainSize(Eigen::Index p, const Work& work) {
  if (p == 2) return work(std::integral_constant<Eigen::Index, 2>{});
  return work(p);
}

}  // namespace suspension_health_monitor
