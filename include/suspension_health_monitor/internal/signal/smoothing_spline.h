#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace suspension_health_monitor {

/// Cubic spline on unit knots through readings at any positions, as they come:
///   s(u) = sum_k c_k B(u - k), whose coefficients minimise
///   sum_i (s(u_i) - x_i)^2 + lambda sum_k 2 (D^3 c)_k^2 + (D^4 c)_k^2,   D c_k = c_k - c_(k-1),
/// with B the cubic B-spline, 0 outside of (-2, 2). The penalty decides where readings are fewer than knots: there it
/// gives the smoothest curve through them, fast motion by its fourth differences, and holes of several readings, which
/// these would fill with noise, by its third. Where readings are more, the sum of squares averages them.
///
/// A reading concerns four neighbouring coefficients, and a term of the penalty at most five. So the normal equations
/// are banded, and are factored from the oldest coefficient on while readings come; only the newest five are open at
/// any time. Back substitution gives coefficients by all readings so far. Those of an instant hardly change once
/// readings of some ten knots after it are in (a fixed-lag smoother), and are then left as they are. Source: P-splines,
/// Eilers and Marx, Statistical Science 11 (1996), 89-121. Cost: O(1) per reading and per knot, no allocation.
class SmoothingSpline {
 public:
  static constexpr std::int64_t kKept = 128;  ///< newest coefficients that solve() can give, a power of two

  /// Forgets all readings; the next one may be at any position.
  void clear() { empty_ = true; }

  /// Takes in the next reading.
  /// @param position  in knots, not before the last one.
  void add(double position, double value);

  /// Solves for the coefficients from `first` to the newest, but for those that are settled.
  /// @param settled  those up to here stay as they are from now on.
  void solve(std::int64_t first, std::int64_t settled);

  /// @return c_first and those after it, as many as solve() has given.
  const double* coefficients(std::int64_t first) const { return &coefficients_[place(first)]; }

 private:
  static constexpr int kOpen = 5;
  static constexpr double kPenalty = 4e-6;  // lambda: 0.1 % of what a reading weighs, for the fastest motion

  static std::size_t place(std::int64_t k) { return static_cast<std::size_t>(k & (kKept - 1)); }
  void begin(std::int64_t first);
  void penalise(const std::array<double, kOpen>& difference);
  void penaliseNewest();
  void closeOldest();
  void store(std::int64_t k, double coefficient) {
    coefficients_[place(k)] = coefficients_[place(k) + kKept] = coefficient;
  }

  /// c_k = value - sum_i factors[i] c_(k+1+i).
  struct Closed {
    std::array<double, kOpen - 1> factors;
    double value;
  };

  bool empty_ = true;
  std::int64_t oldest_open_ = 0, settled_ = 0;
  std::array<std::array<double, kOpen>, kOpen> matrix_{};  // of the open coefficients, its lower triangle
  std::array<double, kOpen> right_{};
  std::array<Closed, kKept> closed_{};
  std::array<double, 2 * kKept> coefficients_{};  // twice, so that any kKept are in a row
};

}  // namespace suspension_health_monitor
