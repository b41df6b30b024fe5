#include "suspension_health_monitor/internal/blocks/strut_equations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "block_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr double kTrueB1 = 4.2, kTrueB0 = 52.0;
const BlockBand kBand(2.0, 0.01);

double sumOfProducts(const Eigen::ArrayXcd& a, const Eigen::ArrayXcd& b, int first, int size) {
  double sum = 0.0;
  for (int i = first; i < first + size; ++i) sum += a[i].real() * b[i].real() + a[i].imag() * b[i].imag();
  return sum;
}

// rms of the residual in all bins of the block, relative to the body's acceleration: a difference of sums of squares,
// so that rounding leaves kRounding of it.
constexpr double kRounding = 1e-7;
double unexplained(StrutEquations& equations, StrutBlock& block, const BlockVector& theta) {
  equations.linearise(theta, block);
  double left = 0.0, body = 0.0;
  for (const StrutBlock::Band& band : block.bands) {
    left += residualPower(band.moments, theta);
    body += band.powers[StrutBlock::Band::kBody];
  }
  return std::sqrt(left / body);
}

// The equations of a strut top as the header prints them, from a block's spectra; nothing is shared with the class but
// the modulation.
struct Printed {
  const StrutBlock& block;
  Eigen::ArrayXcd s;

  Eigen::ArrayXcd delayed(std::size_t p, const Eigen::ArrayXcd& integrals, double tau) const {
    Modulation modulation(kBand);
    modulation.setDelay(tau);
    Eigen::ArrayXcd result;
    modulation.apply(p, integrals, result);
    return result;
  }
  Eigen::ArrayXcd a(const BlockVector& t) const { return s * s + t[0] * s + t[1]; }
  Eigen::ArrayXcd g(const BlockVector& t) const { return t[0] * s + t[1]; }
  Eigen::ArrayXcd leftOver(const BlockVector& t) const {
    const auto x = [&](std::size_t p) -> Eigen::ArrayXcd { return (1.0 + t[4]) * delayed(p, block.wheel, t[2]); };
    Eigen::ArrayXcd result = block.body.col(2) - t[0] * (x(1) - block.body.col(1)) - t[1] * (x(0) - block.body.col(0));
    for (int m = 0; m < block.forces.cols(); ++m) result -= t[5 + m] * delayed(2, block.forces.col(m), t[2]);
    for (int m = 0; m < block.neighbours.cols(); ++m)
      result -= t[5 + block.forces.cols() + m] * block.neighbours.col(m);
    return result;
  }
  Eigen::ArrayXd rho(const BlockVector& t) const {
    return t[3] * g(t).abs2() / (t[3] * g(t).abs2() + (1.0 - t[3]) * a(t).abs2());
  }
  Eigen::ArrayXcd wheel(const BlockVector& t) const {
    return (1.0 + t[4]) * delayed(0, block.wheel, t[2]) + rho(t) * (leftOver(t) / a(t)) * a(t) / g(t);
  }
};

TEST(StrutEquations, OfAnExactStrutHoldInOneBlockWhateverItsInitialState) {
  StrutEquations equations(kBand, BlockColumns{});
  const Exponentials wheel = severalSines();
  Exponentials body = wheel.throughStrut(kTrueB1, kTrueB0);
  body.addFreeDecay(5.0, kTrueB1, kTrueB0);
  StrutBlock block = exactBlocks(equations, wheel, body, 1).front();
  EXPECT_LT(unexplained(equations, block, blockTheta(kTrueB1, kTrueB0)), kRounding);
  EXPECT_GT(unexplained(equations, block, blockTheta(1.01 * kTrueB1, kTrueB0)), 1e-4);
  EXPECT_GT(unexplained(equations, block, blockTheta(kTrueB1, 1.01 * kTrueB0)), 1e-4);
  EXPECT_GT(unexplained(equations, block, blockTheta(kTrueB1, kTrueB0, 0.001)), 1e-4);
}

TEST(StrutEquations, OfOneBlockGiveDampingAndStiffnessExactlyFromABadStart) {
  StrutEquations equations(kBand, BlockColumns{});
  const Exponentials wheel = severalSines();
  Exponentials body = wheel.throughStrut(kTrueB1, kTrueB0);
  body.addFreeDecay(5.0, kTrueB1, kTrueB0);
  std::vector<StrutBlock> blocks = exactBlocks(equations, wheel, body, 1);
  const WindowEstimate estimate = fitBlocks(equations, blocks, blockTheta(8.0, 30.0), blockPrior(), 12);
  EXPECT_NEAR(estimate.theta[0] / kTrueB1, 1.0, 1e-10);
  EXPECT_NEAR(estimate.theta[1] / kTrueB0, 1.0, 1e-10);
  EXPECT_NEAR(estimate.theta[2], 0.0, 1e-12);
  EXPECT_NEAR(estimate.explained, 1.0, 1e-12);

  const Eigen::Vector2d start = equations.start({&blocks.front()});
  EXPECT_NEAR(start[0] / kTrueB1, 1.0, 1e-9);
  EXPECT_NEAR(start[1] / kTrueB0, 1.0, 1e-9);
}

TEST(StrutEquations, AreDeafToOffsetsOfBothSensors) {
  StrutEquations equations(kBand, BlockColumns{});
  Exponentials wheel = severalSines(), body = wheel.throughStrut(kTrueB1, kTrueB0);
  wheel.terms.push_back({9.81, 0.0});
  body.terms.push_back({-3.0, 0.0});
  StrutBlock block = exactBlocks(equations, wheel, body, 1).front();
  EXPECT_LT(unexplained(equations, block, blockTheta(kTrueB1, kTrueB0)), kRounding);
}

// A drift c t leaves c T^2 / (4 pi k (k^2 - 1)) in H_0 of bin k and nothing in H_1 and H_2, so b0 times that over |A|
// in e. By Cauchy and Schwarz that moves an estimate by no more than sqrt(sum |e|^2 / s2) standard deviations of it, as
// uncorrelated bins would have; the covariance is larger by the correlation of bins.
TEST(StrutEquations, HearADriftOfTheWheelNoMoreThanItsClosedForm) {
  StrutEquations equations(kBand, BlockColumns{});
  const Exponentials wheel = severalSines(), body = wheel.throughStrut(kTrueB1, kTrueB0);
  std::vector<StrutBlock> blocks = exactBlocks(equations, wheel, body, 3);
  const double drift = 0.2;  // [m/s^3]: 0.4 m/s^2 in a block
  for (StrutBlock& block : blocks)
    for (int i = 0; i < kBand.spectrumSize(); ++i)
      block.wheel[i] += Complex(0.0, drift * kBand.length / kBand.omega(kBand.first - 1 + i));
  const BlockVector truth = blockTheta(kTrueB1, kTrueB0);
  for (StrutBlock& block : blocks) equations.linearise(truth, block);

  const NoiseBands& bands = equations.noiseBands();
  const Eigen::ArrayXcd s = equations.undelayed().s();
  for (int b = 0; b < bands.count(); ++b) {
    double expected = 0.0;
    for (int i = bands.first(b); i < bands.first(b) + bands.size(b); ++i) {
      const double k = kBand.first + i, left = drift * 4.0 / (4.0 * M_PI * k * (k * k - 1.0));
      expected += std::pow(kTrueB0 * left, 2) / std::norm(s[i] * s[i] + kTrueB1 * s[i] + kTrueB0);
    }
    const Eigen::MatrixXd& moments = blocks.front().bands[static_cast<std::size_t>(b)].moments;
    EXPECT_NEAR(residualPower(moments, truth), expected, 1e-6 * expected + kRounding * kRounding * moments(6, 6))
        << "band " << b;
  }

  // The sensors' noise besides, as a spectrum that is given: Z'R and Z'e of all blocks over it.
  const double s2 = 1e-3;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d score = Eigen::Vector2d::Zero();
  double power = 0.0;
  for (const StrutBlock& block : blocks)
    for (const StrutBlock::Band& band : block.bands) {
      information += band.information.topLeftCorner<2, 2>() / s2;
      score += scoreOf(band, truth, 1.0).head<2>() / s2;
      power += residualPower(band.moments, truth) / s2;
    }
  const Eigen::Vector2d moved = information.inverse() * score;
  for (const int i : {0, 1})
    EXPECT_LT(std::abs(moved[i]), 1.05 * std::sqrt(power * information.inverse()(i, i))) << "parameter " << i;
}

TEST(StrutEquations, RecoverADelayOfTheWheelAndItsSign) {
  StrutEquations equations(kBand, BlockColumns{});
  Exponentials wheel;
  for (const int bin : {2, 3, 5, 8, 13, 21, 34}) wheel.addSine(1.0, bin / kBand.length, 0.3 * bin);
  for (const double tau : {0.006, -0.004}) {
    std::vector<StrutBlock> blocks =
        exactBlocks(equations, wheel.delayed(tau), wheel.throughStrut(kTrueB1, kTrueB0), 3);
    const WindowEstimate estimate = fitBlocks(equations, blocks, blockTheta(kTrueB1, kTrueB0), blockPrior(), 12);
    EXPECT_NEAR(estimate.theta[2], tau, 1e-10);
    EXPECT_NEAR(estimate.theta[0] / kTrueB1, 1.0, 1e-9);
    EXPECT_NEAR(estimate.theta[1] / kTrueB0, 1.0, 1e-9);
  }
}

TEST(StrutEquations, RecoverTheDifferenceOfBothSensorsGainsAndItsSign) {
  StrutEquations equations(kBand, BlockColumns{});
  Exponentials wheel;
  for (const int bin : {2, 3, 5, 8, 13, 21, 34}) wheel.addSine(1.0, bin / kBand.length, 0.3 * bin);
  const Exponentials body = wheel.throughStrut(kTrueB1, kTrueB0);
  for (const double gain : {0.8, 1.1}) {
    std::vector<StrutBlock> blocks = exactBlocks(equations, wheel, body, 3);
    for (StrutBlock& block : blocks) block.wheel *= gain;
    const WindowEstimate estimate =
        fitBlocks(equations, blocks, blockTheta(kTrueB1, kTrueB0), blockPrior(0.005, 0.1), 20);
    EXPECT_NEAR(estimate.theta[kBlockGain], 1.0 / gain - 1.0, 1e-9);
    EXPECT_NEAR(estimate.theta[0] / kTrueB1, 1.0, 1e-8);
    EXPECT_NEAR(estimate.theta[1] / kTrueB0, 1.0, 1e-8);
  }
}

TEST(StrutEquations, SumDerivativesOfTheModelAndOfTheResidualOverEveryBand) {
  const BlockColumns columns{2, 2};
  StrutEquations equations(kBand, columns);
  StrutBlock block = equations.makeBlock();
  std::srand(1);
  block.wheel.setRandom();
  block.forces.setRandom();
  block.body.setRandom();
  block.neighbours.setRandom();
  block.predicted_neighbours.setRandom();
  block.predicted_travel.setRandom();
  BlockVector theta(columns.numParameters());
  theta << kTrueB1, kTrueB0, 0.003, 0.3, 0.05, 0.7, -0.4, 2.0, 9.0;
  equations.linearise(theta, block);

  const Printed printed{block, equations.undelayed().s()};
  const Eigen::ArrayXcd a = printed.a(theta), g = printed.g(theta), w = printed.wheel(theta);
  const auto p = static_cast<std::size_t>(theta.size());
  std::vector<Eigen::ArrayXcd> instruments(p), regressors(p + 1);
  regressors[p] = printed.leftOver(theta) / a;
  for (std::size_t i = 0; i < p; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    BlockVector above = theta, below = theta;
    const double step = at == kBlockDelay ? 1e-6 : 1e-5 * std::max(std::abs(theta[at]), 1.0);
    above[at] += step;
    below[at] -= step;
    // Over A as it is: the residual's weight is no part of its derivative.
    regressors[i] = (printed.leftOver(below) - printed.leftOver(above)) / (2.0 * step) / a;
    if (at == kBlockDelay) {
      // The forces' columns are delayed, too, but the delay is the wheel's: their part is of second order in f.
      for (int m = 0; m < 2; ++m) regressors[i] -= theta[5 + m] * printed.delayed(3, block.forces.col(m), theta[2]) / a;
      instruments[i] = g / a * printed.s * w;  // of G W^ e^(s tau)
    } else if (at == kBlockGain) {
      instruments[i] = g / a * w / (1.0 + theta[at]);
    } else if (at == kBlockWheelShare) {
      instruments[i] = -((printed.rho(above) - printed.rho(below)) / (2.0 * step)) / (g / a).conjugate() * w;
      regressors[i] = instruments[i];
    } else if (at < 2) {
      const Eigen::ArrayXcd slope =
          (printed.g(above) / printed.a(above) - printed.g(below) / printed.a(below)) / (2.0 * step);
      // The travel that the coupled model predicts, with the wheel's part of e.
      const Eigen::ArrayXcd e_over_g = printed.rho(theta) * regressors[p] * a / g;
      instruments[i] = slope * e_over_g + (at == 0 ? printed.s : printed.s.pow(0)) * block.predicted_travel / a;
    } else {
      const auto neighbour = at - columns.firstNeighbour();
      instruments[i] = neighbour < 0 ? regressors[i] : Eigen::ArrayXcd(block.predicted_neighbours.col(neighbour) / a);
    }
  }
  for (std::size_t i = 0; i < p; ++i)  // the block keeps the residual at theta = 0
    if (i != kBlockWheelShare) regressors[p] += theta[static_cast<Eigen::Index>(i)] * regressors[i];
  for (int b = 0; b < equations.noiseBands().count(); ++b) {
    const StrutBlock::Band& band = block.bands[static_cast<std::size_t>(b)];
    const int first = equations.noiseBands().first(b), size = equations.noiseBands().size(b);
    const auto sum = [&](const auto& left, const auto& right) { return sumOfProducts(left, right, first, size); };
    const auto expectEqual = [&](double found, const auto& left, const auto& right, std::size_t i, std::size_t j) {
      const double scale = std::sqrt(sum(left, left) * sum(right, right));
      EXPECT_NEAR(found, sum(left, right), 1e-7 * scale) << "band " << b << ", parameters " << i << ", " << j;
    };
    for (std::size_t i = 0; i < p; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      expectEqual(band.score[row], instruments[i], regressors[p], i, p);
      for (std::size_t j = 0; j < p; ++j)
        expectEqual(band.information(row, static_cast<Eigen::Index>(j)), instruments[i], regressors[j], i, j);
    }
    for (std::size_t i = 0; i <= p; ++i)
      for (std::size_t j = 0; j <= p; ++j)
        expectEqual(band.moments(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), regressors[i],
                    regressors[j], i, j);
    EXPECT_NEAR(band.powers[StrutBlock::Band::kWheel], sum(w, w), 1e-9 * band.powers[StrutBlock::Band::kWheel]);
    const Eigen::ArrayXcd body = block.body.col(0);
    const Eigen::ArrayXcd rate =
        ((1.0 + theta[4]) * printed.delayed(1, block.wheel, theta[2]) - block.body.col(1)) / (printed.s * printed.s);
    EXPECT_NEAR(band.powers[StrutBlock::Band::kBody], sum(body, body), 1e-9 * band.powers[StrutBlock::Band::kBody]);
    EXPECT_NEAR(band.powers[StrutBlock::Band::kRate], sum(rate, rate), 1e-9 * band.powers[StrutBlock::Band::kRate]);
  }
}

TEST(StrutEquations, OfAStrutAloneHaveTheDerivativesOfGTimesTheWheelAsInstruments) {
  StrutEquations equations(kBand, BlockColumns{});
  StrutBlock block = equations.makeBlock();
  std::srand(2);
  block.wheel.setRandom();
  block.body.setRandom();
  block.forces.setRandom();
  const BlockVector theta = blockTheta(kTrueB1, kTrueB0, -0.002, 0.8, 0.2);
  equations.linearise(theta, block);
  const Printed printed{block, equations.undelayed().s()};
  const Eigen::ArrayXcd w = printed.wheel(theta), e = printed.leftOver(theta) / printed.a(theta);
  for (const Eigen::Index i : {0, 1}) {
    BlockVector above = theta, below = theta;
    above[i] *= 1.0 + 1e-5;
    below[i] *= 1.0 - 1e-5;
    const Eigen::ArrayXcd instrument =
        (printed.g(above) / printed.a(above) - printed.g(below) / printed.a(below)) * w / (2e-5 * theta[i]);
    for (int b = 0; b < equations.noiseBands().count(); ++b) {
      const int first = equations.noiseBands().first(b), size = equations.noiseBands().size(b);
      const double scale =
          std::sqrt(sumOfProducts(instrument, instrument, first, size) * sumOfProducts(e, e, first, size));
      const BlockVector score = scoreOf(block.bands[static_cast<std::size_t>(b)], theta, 1.0);
      EXPECT_NEAR(score[i], sumOfProducts(instrument, e, first, size), 1e-7 * scale);
    }
  }
}

}  // namespace
}  // namespace suspension_health_monitor
