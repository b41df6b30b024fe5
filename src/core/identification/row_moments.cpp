#include "suspension_health_monitor/internal/identification/row_moments.h"

#include <algorithm>
#include <initializer_list>

namespace suspension_health_monitor {
namespace {

bool isWithin(double x, double end) { return x >= std::min(0.0, end) && x <= std::max(0.0, end); }

// The least of a x^2 - 2 b x with x between 0 and `end`.
double leastAt(double a, double b, double end) {
  return a > 0.0 ? std::clamp(b / a, std::min(0.0, end), std::max(0.0, end)) : 0.0;
}

double restOf(const RowMoments& m, double b1, double b0) {
  const double of_damping = b1 * (b1 * m.damping_information - 2.0 * m.damping_output);
  const double of_stiffness = b0 * (b0 * m.stiffness_information - 2.0 * m.stiffness_output);
  return std::max(0.0, m.output + of_damping + of_stiffness + 2.0 * b1 * b0 * m.between);
}

}  // namespace

RowMoments& RowMoments::operator+=(const RowMoments& other) {
  damping_information += other.damping_information;
  stiffness_information += other.stiffness_information;
  between += other.between;
  damping_output += other.damping_output;
  stiffness_output += other.stiffness_output;
  output += other.output;
  return *this;
}

StrutFit RowMoments::bestStrut(const Eigen::Vector2d& most) const {
  const double determinant = damping_information * stiffness_information - between * between;
  if (determinant > 0.0) {
    const double b1 = (damping_output * stiffness_information - stiffness_output * between) / determinant;
    const double b0 = (stiffness_output * damping_information - damping_output * between) / determinant;
    if (isWithin(b1, most[0]) && isWithin(b0, most[1])) return {{b1, b0}, restOf(*this, b1, b0)};
  }
  // It is on one of the four edges.
  StrutFit best{Eigen::Vector2d::Zero(), output};
  const auto consider = [&](double b1, double b0) {
    const double rest = restOf(*this, b1, b0);
    if (rest < best.rest) best = {{b1, b0}, rest};
  };
  for (const double b1 : {0.0, most[0]})
    consider(b1, leastAt(stiffness_information, stiffness_output - b1 * between, most[1]));
  for (const double b0 : {0.0, most[1]})
    consider(leastAt(damping_information, damping_output - b0 * between, most[0]), b0);
  return best;
}

}  // namespace suspension_health_monitor
