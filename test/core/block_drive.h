#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <iterator>
#include <limits>
#include <random>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"
#include "suspension_health_monitor/internal/blocks/window_fit.h"

namespace suspension_health_monitor {

using Complex = std::complex<double>;

/// A signal Re sum of c e^(lambda t): sines, free decays and constants, whose Fourier integrals are closed forms.
struct Exponentials {
  struct Term {
    Complex amplitude, exponent;
  };
  std::vector<Term> terms;

  double at(double t) const {
    double sum = 0.0;
    for (const Term& term : terms) sum += (term.amplitude * std::exp(term.exponent * t)).real();
    return sum;
  }

  /// @return the integral of the p-th derivative times e^(-j omega (t - a)) over [a, a + length).
  Complex integral(double a, double length, double omega, int p = 0) const {
    const auto one = [&](Complex amplitude, Complex exponent) {
      const Complex rate = exponent - Complex(0.0, omega);
      const Complex scale = amplitude * std::pow(exponent, p) * std::exp(exponent * a);
      return std::abs(rate) * length < 1e-9 ? scale * length : scale * (std::exp(rate * length) - 1.0) / rate;
    };
    Complex sum;
    for (const auto& [c, lambda] : terms) sum += 0.5 * (one(c, lambda) + one(std::conj(c), std::conj(lambda)));
    return sum;
  }

  Exponentials delayed(double tau) const {
    Exponentials result = *this;
    for (Term& term : result.terms) term.amplitude *= std::exp(-term.exponent * tau);
    return result;
  }

  /// @return z'' of a strut above a wheel with this w'', in its steady state.
  Exponentials throughStrut(double b1, double b0) const {
    Exponentials result = *this;
    for (auto& [c, s] : result.terms) c *= (b1 * s + b0) / (s * s + b1 * s + b0);
    return result;
  }

  Exponentials& addSine(double amplitude, double frequency, double phase) {
    terms.push_back({std::polar(amplitude, phase), {0.0, 2.0 * M_PI * frequency}});
    return *this;
  }

  /// Adds the free motion of a strut: its initial state.
  Exponentials& addFreeDecay(double amplitude, double b1, double b0) {
    terms.push_back({amplitude, {-b1 / 2.0, std::sqrt(b0 - b1 * b1 / 4.0)}});
    return *this;
  }
};

/// Sines at no bin of a block of 2 s, from below the bounce to beyond the wheel's hop.
inline Exponentials severalSines() {
  Exponentials result;
  const double frequencies[] = {0.83, 1.19, 1.77, 2.61, 3.47, 5.13, 7.9, 9.57, 12.3, 15.1, 18.71};
  for (std::size_t i = 0; i < std::size(frequencies); ++i)
    result.addSine(1.0 + 0.1 * static_cast<double>(i), frequencies[i], 0.7 * static_cast<double>(i * i));
  return result;
}

/// The two sensors of a strut on even stamps.
struct SampledStrut {
  double rate = 0.0;
  std::vector<double> body, wheel;
};

/// A strut that white noise drives through its wheel, band limited to a third of the rate, from the exact response in
/// the frequency domain: no integration error, no aliasing. White noise of the sensors is added.
struct NoisyDrive {
  double b1 = 4.2, b0 = 52.0, rate = 64.0, seconds = 32.0;
  double wheel_rms = 3.0, body_noise = 0.03, wheel_noise = 0.03, delay = 0.0;
  double memory_spring = 0.0, relaxation = 1.0;  ///< a Maxwell element beside the strut, over mass [1/s^2], [s]
  unsigned seed = 1;

  SampledStrut sample() const {
    const auto n = static_cast<int>(rate * seconds);
    const int lines = n / 3;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<Complex> wheel(static_cast<std::size_t>(n)), body(wheel.size()), out(wheel.size());
    const double size = wheel_rms * n / std::sqrt(4.0 * lines);  // of the real and the imaginary part
    for (int k = 1; k <= lines; ++k) {
      const Complex s(0.0, 2.0 * M_PI * k * rate / n), w(size * normal(random), size * normal(random));
      const auto place = static_cast<std::size_t>(k), mirror = wheel.size() - place;
      wheel[place] = w * std::exp(-s * delay);
      const Complex force = b1 * s + b0 + memory_spring * relaxation * s / (relaxation * s + 1.0);
      body[place] = w * force / (s * s + force);
      wheel[mirror] = std::conj(wheel[place]);
      body[mirror] = std::conj(body[place]);
    }
    SampledStrut result{rate, {}, {}};
    Eigen::FFT<double> fft;
    fft.inv(out, body);
    for (const Complex& each : out) result.body.push_back(each.real() + body_noise * normal(random));
    fft.inv(out, wheel);
    for (const Complex& each : out) result.wheel.push_back(each.real() + wheel_noise * normal(random));
    return result;
  }
};

/// Fills a block from U_k of the wheel and of the body in bins first - 1 .. last + 1; its force column is zero.
inline void fillBlock(const StrutEquations& equations, const Eigen::ArrayXcd& wheel, const Eigen::ArrayXcd& body,
                      StrutBlock& block) {
  block.wheel = wheel;
  for (Eigen::Index p = 0; p < 3; ++p)
    equations.undelayed().apply(static_cast<std::size_t>(p), body, block.body.col(p));
}

inline Eigen::ArrayXcd exactIntegrals(const BlockBand& band, const Exponentials& signal, double a) {
  Eigen::ArrayXcd result(band.spectrumSize());
  for (int i = 0; i < band.spectrumSize(); ++i)
    result[i] = signal.integral(a, band.length, band.omega(band.first - 1 + i));
  return result;
}

/// @return half overlapped blocks of the motion itself: no sampling, no noise.
inline std::vector<StrutBlock> exactBlocks(const StrutEquations& equations, const Exponentials& wheel,
                                           const Exponentials& body, int count) {
  const BlockBand& band = equations.band();
  std::vector<StrutBlock> blocks;
  for (int b = 0; b < count; ++b) {
    const double a = 0.5 * band.length * b;
    blocks.push_back(equations.makeBlock());
    blocks.back().end = a + band.length;
    fillBlock(equations, exactIntegrals(band, wheel, a), exactIntegrals(band, body, a), blocks.back());
  }
  return blocks;
}

/// U_k of the channel of a stream over the half blocks half - 1 and half.
inline Eigen::ArrayXcd wholeBlock(const BlockBand& band, const FourierIntegrals& stream, long half,
                                  Eigen::Index channel = 0) {
  Eigen::ArrayXcd result = stream.half(half - 1)->col(channel);
  for (Eigen::Index i = 0; i < result.size(); ++i)
    result[i] += ((band.first - 1 + i) % 2 == 0 ? 1.0 : -1.0) * (*stream.half(half))(i, channel);
  return result;
}

/// @return all half overlapped blocks of a drive.
inline std::vector<StrutBlock> sampledBlocks(const StrutEquations& equations, const SampledStrut& drive) {
  const BlockBand& band = equations.band();
  FourierIntegrals wheel(band, 1), body(band, 1);
  FourierIntegrals::Phases phases(band);
  std::vector<StrutBlock> blocks;
  long half = 1;
  for (std::size_t i = 0; i < drive.body.size(); ++i) {
    const double time = static_cast<double>(i) / drive.rate;
    wheel.push(time, &drive.wheel[i], phases);
    body.push(time, &drive.body[i], phases);
    if (wheel.openHalf() <= half) continue;
    blocks.push_back(equations.makeBlock());
    blocks.back().end = 0.5 * band.length * static_cast<double>(half + 1);
    fillBlock(equations, wholeBlock(band, wheel, half), wholeBlock(band, body, half), blocks.back());
    ++half;
  }
  return blocks;
}

inline BlockVector blockTheta(double b1, double b0, double delay = 0.0, double share = 0.5, double friction = 0.0,
                              double gain = 0.0) {
  BlockVector theta(kNumBlockParameters + 1);
  theta << b1, b0, delay, share, gain, friction;
  return theta;
}

/// Knows nothing of b1 and b0, r as the estimator has it, and the delay and the gain so well; there is no force.
inline BlockPrior blockPrior(double delay_stddev = 0.005, double gain_stddev = 1e-6) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  BlockPrior prior{blockTheta(0.0, 0.0), blockTheta(kUnknown, kUnknown, delay_stddev, 0.29, 0.1, gain_stddev)};
  return prior;
}

/// Linearises and solves in turn.
inline WindowEstimate fitBlocks(StrutEquations& equations, std::vector<StrutBlock>& blocks, BlockVector theta,
                                const BlockPrior& prior, int steps = 6) {
  WindowFit fit(equations.band(), equations.columns(), static_cast<int>(blocks.size()));
  std::vector<const StrutBlock*> pointers;
  for (const StrutBlock& block : blocks) pointers.push_back(&block);
  WindowEstimate result;
  for (int i = 0; i < steps; ++i) {
    for (StrutBlock& block : blocks) equations.linearise(theta, block);
    fit.fit(pointers, prior, theta, {}, 1.0, result);
    theta = result.theta;
  }
  return result;
}

}  // namespace suspension_health_monitor
