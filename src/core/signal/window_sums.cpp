#include "suspension_health_monitor/signal/window_sums.h"

#include <cmath>
#include <vector>

#include "suspension_health_monitor/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kCutoff = 0.5;        // -6 dB [cycles per grid period]
constexpr double kKaiser = 5.0;        // shape of the window: ripple 1.4e-3
constexpr double kHighestLine = 0.3;   // [cycles per grid period]
constexpr double kHighestRidge = 0.1;  // of the highest line, relative to the sum of g; falls with the 6th power
constexpr int kNodesPerPeriod = 512;   // of the table: h is interpolated to 1e-6

/// h and the phasor of the first line at one node of the table.
struct Node {
  double filter, cosine, sine;
};

std::vector<Node> tabulate(int half_width, double line) {
  std::vector<Node> nodes;
  for (int i = 0; i <= half_width * kNodesPerPeriod + 1; ++i) {
    const double tau = static_cast<double>(i) / kNodesPerPeriod;
    const double inside = std::max(0.0, 1.0 - tau * tau / (half_width * half_width));
    const double window = std::cyl_bessel_i(0.0, kKaiser * std::sqrt(inside)) / std::cyl_bessel_i(0.0, kKaiser);
    const double angle = 2.0 * kPi * kCutoff * tau;
    const double sinc = i == 0 ? 1.0 : std::sin(angle) / angle;
    nodes.push_back({2.0 * kCutoff * sinc * window, std::cos(line * tau), std::sin(line * tau)});
  }
  return nodes;
}

template <std::size_t N>
using Square = std::array<std::array<double, N>, N>;

/// Solves the symmetric positive definite system in place, from its lower triangle: L D L^T without pivoting.
/// Written out for this size it takes seven tenths of the instructions of Eigen's LLT.
template <std::size_t N>
void solve(Square<N>& matrix, std::array<double, N>& x) {
  for (std::size_t j = 0; j < N; ++j) {
    const double inverse = 1.0 / matrix[j][j];
    for (std::size_t i = j + 1; i < N; ++i) {
      const double factor = matrix[i][j] * inverse;
      for (std::size_t k = j + 1; k <= i; ++k) matrix[i][k] -= factor * matrix[k][j];
      x[i] -= factor * x[j];
    }
    x[j] *= inverse;
  }
  for (std::size_t j = N; j-- > 0;) {
    const double inverse = 1.0 / matrix[j][j];
    for (std::size_t i = j + 1; i < N; ++i) x[j] -= matrix[i][j] * inverse * x[i];
  }
}

}  // namespace

void WindowSums::add(double tau, double spacing, double value) {
  static const std::vector<Node> nodes = tabulate(kHalfWidth, 2.0 * kPi * kHighestLine / kLines);
  const double place = std::abs(tau) * kNodesPerPeriod;
  const auto i = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(i);
  const Node& a = nodes[i];
  const Node& b = nodes[i + 1];
  const double filter = spacing * (a.filter + part * (b.filter - a.filter));
  const double cosine = a.cosine + part * (b.cosine - a.cosine);
  const double sine = std::copysign(a.sine + part * (b.sine - a.sine), tau);
  const double scaled = tau / kHalfWidth;
  const double bump = spacing * (1.0 - scaled * scaled) * (1.0 - scaled * scaled);
  const double weighted = bump * value;

  filtered_ += filter * value;
  double c = 1.0, s = 0.0;  // of m theta tau
  for (int m = 0; m <= 2 * kLines; ++m) {
    cosine_[m] += bump * c;
    sine_[m] += bump * s;
    if (m <= kLines) {
      filter_cosine_[m] += filter * c;
      filter_sine_[m] += filter * s;
      weighted_cosine_[m] += weighted * c;
      weighted_sine_[m] += weighted * s;
    }
    const double next = c * cosine - s * sine;
    s = s * cosine + c * sine;
    c = next;
  }
}

double WindowSums::value() const {
  Square<2 * kLines + 1> gram;  // its lower triangle; first the cosines, then the sines
  std::array<double, 2 * kLines + 1> missing;
  for (int j = 0; j <= kLines; ++j) {
    for (int k = 0; k <= j; ++k) {
      gram[j][k] = 0.5 * (cosine_[j - k] + cosine_[j + k]);
      if (k > 0) gram[kLines + j][kLines + k] = 0.5 * (cosine_[j - k] - cosine_[j + k]);
    }
    missing[j] = 1.0 - filter_cosine_[j];
    if (j == 0) continue;
    for (int k = 0; k <= kLines; ++k)
      gram[kLines + j][k] = 0.5 * (sine_[j + k] + (j >= k ? sine_[j - k] : -sine_[k - j]));
    const double share = static_cast<double>(j) / kLines;
    const double ridge = kHighestRidge * cosine_[0] * (share * share * share) * (share * share * share);
    gram[j][j] += ridge;
    gram[kLines + j][kLines + j] += ridge;
    missing[kLines + j] = -filter_sine_[j];
  }
  solve(gram, missing);
  double value = filtered_;
  for (int k = 0; k <= kLines; ++k) value += missing[k] * weighted_cosine_[k];
  for (int k = 1; k <= kLines; ++k) value += missing[kLines + k] * weighted_sine_[k];
  return value;
}

}  // namespace suspension_health_monitor
