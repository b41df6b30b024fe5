#include "suspension_health_monitor/internal/signal/smoothing_spline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace suspension_health_monitor {

void SmoothingSpline::begin(std::int64_t first) {
  empty_ = false;
  oldest_open_ = first;
  settled_ = first - 1;
  matrix_ = {};
  right_ = {};
  penalise({1.0, -2.0, 1.0, 0.0, 0.0});  // two readings make a straight line
  penalise({-1.0, 3.0, -3.0, 1.0, 0.0});
  penaliseNewest();
}

void SmoothingSpline::penaliseNewest() {
  penalise({0.0, -1.4, 4.2, -4.2, 1.4});
  penalise({1.0, -4.0, 6.0, -4.0, 1.0});
}

void SmoothingSpline::penalise(const std::array<double, kOpen>& difference) {
  for (int i = 0; i < kOpen; ++i)
    for (int j = 0; j <= i; ++j) matrix_[i][j] += kPenalty * difference[i] * difference[j];
}

void SmoothingSpline::add(double position, double value) {
  const double knot = std::floor(position);
  const auto first = static_cast<std::int64_t>(knot) - 1;  // whose B-spline the position is in
  if (empty_) begin(first);
  while (oldest_open_ < first) closeOldest();
  const double u = position - knot, v = 1.0 - u;
  const std::array<double, 4> weights{v * v * v / 6.0, 2.0 / 3.0 - u * u * (1.0 - u / 2.0),
                                      2.0 / 3.0 - v * v * (1.0 - v / 2.0), u * u * u / 6.0};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j <= i; ++j) matrix_[i][j] += weights[i] * weights[j];
    right_[i] += weights[i] * value;
  }
}

// Eliminates the oldest open coefficient, and opens the one after the newest.
void SmoothingSpline::closeOldest() {
  Closed& closed = closed_[place(oldest_open_++)];
  const double pivot = matrix_[0][0], inverse = 1.0 / pivot;
  closed.value = right_[0] * inverse;
  for (int i = 1; i < kOpen; ++i) {
    closed.factors[i - 1] = matrix_[i][0] * inverse;
    const double eliminated = closed.factors[i - 1] * pivot;
    for (int j = 1; j <= i; ++j) matrix_[i - 1][j - 1] = matrix_[i][j] - eliminated * closed.factors[j - 1];
    right_[i - 1] = right_[i] - eliminated * closed.value;
  }
  matrix_[kOpen - 1] = {};
  right_[kOpen - 1] = 0.0;
  penaliseNewest();
}

void SmoothingSpline::solve(std::int64_t first, std::int64_t settled) {
  auto matrix = matrix_;
  auto x = right_;
  for (int k = 0; k < kOpen; ++k) {
    const double inverse = matrix[k][k] = 1.0 / matrix[k][k];
    for (int i = k + 1; i < kOpen; ++i) {
      const double factor = matrix[i][k] * inverse;
      for (int j = k + 1; j <= i; ++j) matrix[i][j] -= factor * matrix[j][k];
      x[i] -= factor * x[k];
    }
  }
  for (int k = kOpen; k-- > 0;) {
    for (int i = k + 1; i < kOpen; ++i) x[k] -= matrix[i][k] * x[i];
    x[k] *= matrix[k][k];
    store(oldest_open_ + k, x[k]);
  }
  double next = x[0], second = x[1], third = x[2], fourth = x[3];
  for (std::int64_t k = oldest_open_ - 1; k >= std::max(first, settled_ + 1); --k) {
    const Closed& closed = closed_[place(k)];
    const double coefficient = closed.value - closed.factors[0] * next - closed.factors[1] * second -
                               closed.factors[2] * third - closed.factors[3] * fourth;
    fourth = std::exchange(third, std::exchange(second, std::exchange(next, coefficient)));
    store(k, coefficient);
  }
  settled_ = std::max(settled_, settled);
}

}  // namespace suspension_health_monitor
