#include "suspension_health_monitor/internal/signal/bandlimited_interpolator.h"

#include <Eigen/Dense>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace suspension_health_monitor {
namespace {

// Where the energy of a wheel's motion is counts most; near Nyquist's frequency an error is cheaper than the length
// that would avoid it. Bands from 0, as shares of Nyquist's frequency, and their weights.
struct Band {
  double edge, weight;
};
constexpr Band kBands[] = {{0.5, 1.0}, {0.75, 1e-2}, {0.9, 1e-4}};
constexpr double kRidge = 1e-12;  // keeps the weights small where the bands leave them free

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

// Weighted mean of cos(omega x) over the bands.
double bandMean(double x) {
  double sum = 0.0;
  for (const Band& band : kBands) sum += band.weight * band.edge * sinc(band.edge * M_PI * x);
  return sum;
}

// Mean over the band of |sum_i h_i e^(j w i) - e^(j w D)|^2 is a quadratic form in h with these entries.
Eigen::LDLT<Eigen::MatrixXd> factoredGram(Eigen::Index n) {
  Eigen::MatrixXd gram(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) gram(i, j) = bandMean(static_cast<double>(i - j));
    gram(i, i) += kRidge;
  }
  return gram.ldlt();
}

}  // namespace

BandlimitedInterpolator::BandlimitedInterpolator(double fraction) : weights_(2 * kHalfWidth) {
  constexpr Eigen::Index n = 2 * kHalfWidth;
  static const Eigen::LDLT<Eigen::MatrixXd> gram = factoredGram(n);
  Eigen::VectorXd target(n);
  const double wanted = kHalfWidth - 1 + fraction;
  for (Eigen::Index i = 0; i < n; ++i) target[i] = bandMean(static_cast<double>(i) - wanted);
  const Eigen::VectorXd solution = gram.solve(target);
  // A constant, gravity say, comes out exactly.
  for (Eigen::Index i = 0; i < n; ++i) weights_[static_cast<std::size_t>(i)] = solution[i] / solution.sum();
}

BandlimitedInterpolator BandlimitedInterpolator::integral(double from, double to, int power) {
  using Gauss = boost::math::quadrature::gauss<double, 10>;
  std::vector<double> weights(2 * kHalfWidth, 0.0);
  for (std::size_t n = 0; n < Gauss::abscissa().size(); ++n)
    for (const double side : {-1.0, 1.0}) {
      const double position = from + (to - from) * (1.0 + side * Gauss::abscissa()[n]) / 2.0;
      const BandlimitedInterpolator node(position);
      for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] += (to - from) / 2.0 * Gauss::weights()[n] * std::pow(to - position, power) * node.weights_[i];
    }
  return BandlimitedInterpolator(weights);
}

}  // namespace suspension_health_monitor
