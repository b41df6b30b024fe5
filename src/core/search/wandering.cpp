#include <algorithm>
#include <cmath>

#include "model_evaluator.h"
#include "rivals.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kMostly = 0.5;  // of what a fault takes

struct Moments {
  double mean = 0.0, mean_square = 0.0;
};

Moments momentsOf(const Residuals& residuals) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const std::vector<double>& segment : residuals)
    for (const double r : segment) {
      sum += r;
      squares += square(r);
      count += 1.0;
    }
  return {sum / count, squares / count};
}

}  // namespace

double wandering(const Residuals& residuals, double natural_period) {
  const auto length = static_cast<std::size_t>(std::max(1.0, std::ceil(natural_period)));
  const double mean = momentsOf(residuals).mean;
  double products = 0.0, count = 0.0;
  for (const std::vector<double>& segment : residuals) {
    double last = 0.0;
    for (std::size_t first = 0; first + length <= segment.size(); first += length) {
      double sum = 0.0;
      for (std::size_t k = first; k < first + length; ++k) sum += segment[k] - mean;
      if (first > 0) {
        products += last * sum;
        count += square(static_cast<double>(length));
      }
      last = sum;
    }
  }
  return products > 0.0 ? std::sqrt(products / count) : 0.0;
}

bool isWanderingOffset(const Residuals& before, const Residuals& after, double natural_period) {
  const Moments there = momentsOf(before), left = momentsOf(after);
  const double offset = there.mean - left.mean;
  return square(offset) > kMostly * (there.mean_square - left.mean_square) &&
         std::abs(offset) < normalQuantile(kSure) * wandering(after, natural_period);
}

}  // namespace suspension_health_monitor
