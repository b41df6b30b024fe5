#include "suspension_health_monitor/internal/signal/folded_power.h"

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kBelow = 5.0 / 8.0;  // of half the rate; in whole periods per window, so that a mean is not in it

/// What a window's values are weighed by; the squares of either band's weights have the sum 1.
struct Weight {
  double at_limit, in_phase, in_quadrature;
};

template <std::size_t kSize>
std::array<Weight, kSize> hannWeights() {
  std::array<Weight, kSize> weights;
  for (std::size_t i = 0; i < kSize; ++i) {
    const double place = static_cast<double>(i), angle = kBelow * kPi * place;
    // A Hann taper's squares have the mean 3/8.
    const double taper = 0.5 * (1.0 - std::cos(2.0 * kPi * place / kSize)) / std::sqrt(0.375 * kSize);
    weights[i] = {i % 2 == 0 ? taper : -taper, taper * std::cos(angle), taper * std::sin(angle)};
  }
  return weights;
}

}  // namespace

void FoldedPower::add(double value) {
  static const std::array<Weight, kWindow> weights = hannWeights<kWindow>();
  newest_[size_++ % kWindow] = value;
  if (size_ < kWindow || size_ % kEvery != 0) return;
  double at_limit = 0.0, in_phase = 0.0, in_quadrature = 0.0;
  for (std::size_t i = 0; i < kWindow; ++i) {
    const double x = newest_[(size_ + i) % kWindow];
    at_limit += weights[i].at_limit * x;
    in_phase += weights[i].in_phase * x;
    in_quadrature += weights[i].in_quadrature * x;
  }
  below_.add(in_phase * in_phase + in_quadrature * in_quadrature);
  at_limit_.add(at_limit * at_limit);
}

// An octave further the density is that at half the rate times what it has fallen by from kBelow, for log(2) /
// log(1 / kBelow) times the way.
double FoldedPower::level() const {
  if (!(below_.mean() > 0.0)) return 0.0;
  const double octave = std::log(2.0) / std::log(1.0 / kBelow);
  return std::sqrt(at_limit_.mean() * std::pow(at_limit_.mean() / below_.mean(), octave));
}

}  // namespace suspension_health_monitor
