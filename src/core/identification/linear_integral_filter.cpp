#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

#include <algorithm>

#include "suspension_health_monitor/internal/plain_text.h"

namespace suspension_health_monitor {

LinearIntegralFilter::LinearIntegralFilter(int order, const IntegralFilterOptions& options, int lowest_derivative)
    : order_(order),
      horizon_(options.horizon_samples),
      lateness_(HorizonIntegral::lateness(options.rule)),
      window_(window(order, options)),
      missing_(window_) {
  if (order < 1) refuse("filter order n", order, "", "at least 1");
  requireIn("derivative r", lowest_derivative, "", 0.0, order);
  const HorizonIntegral integral(options.horizon_samples, options.period, options.rule);
  const int num_integrals = order - lowest_derivative;
  integrals_.assign(static_cast<std::size_t>(num_integrals), integral);
  for (int i = 0; i <= num_integrals; ++i) {
    const int for_differences = (order - i) * (horizon_ + lateness_) + 1;
    lines_.emplace_back(i < num_integrals ? std::max(for_differences, integral.requiredHistory()) : for_differences);
  }
}

void LinearIntegralFilter::push(double sample) {
  lines_.front().push(sample);
  for (std::size_t i = 0; i < integrals_.size(); ++i) lines_[i + 1].push(integrals_[i].update(lines_[i]));
  if (!full()) --missing_;
}

double LinearIntegralFilter::output(int derivative) const {
  const DelayLine& line = lines_[static_cast<std::size_t>(order_ - derivative)];
  int lag = derivative * lateness_;
  // The strut's own cases, without a loop.
  if (derivative == 0) return line.at(0);
  if (derivative == 1) return line.at(lag) - line.at(lag + horizon_);
  if (derivative == 2) return line.at(lag) - 2.0 * line.at(lag + horizon_) + line.at(lag + 2 * horizon_);
  double result = 0.0, coefficient = 1.0;  // of q^(-jL) in (1 - q^-L)^r
  for (int j = 0; j <= derivative; ++j) {
    result += coefficient * line.at(lag);
    coefficient = coefficient * (j - derivative) / (j + 1);
    lag += horizon_;
  }
  return result;
}

void LinearIntegralFilter::reset() {
  missing_ = window_;
  for (HorizonIntegral& integral : integrals_) integral.reset();
  for (DelayLine& line : lines_) line.reset();
}

}  // namespace suspension_health_monitor
