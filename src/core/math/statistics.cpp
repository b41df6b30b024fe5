#include "suspension_health_monitor/internal/math/statistics.h"

#include <boost/math/distributions/normal.hpp>

namespace suspension_health_monitor {

double normalQuantile(double probability) {
  // Not in long double, as is Boost's habit: its tables are set up when the library is loaded, and that fails where
  // long double is no longer than double, under valgrind for one.
  using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  return boost::math::quantile(
      boost::math::complement(boost::math::normal_distribution<double, InDouble>(), probability));
}

}  // namespace suspension_health_monitor
