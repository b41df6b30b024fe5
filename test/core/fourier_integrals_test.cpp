#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "block_drive.h"

namespace suspension_health_monitor {
namespace {

const BlockBand kBand(2.0, 0.01);

std::vector<double> evenStamps(double spacing, double end) {
  std::vector<double> stamps;
  for (int i = 0; i * spacing < end; ++i) stamps.push_back(i * spacing);
  return stamps;
}

std::vector<double> unevenStamps(double spacing, double end, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(0.7, 1.3);  // of a mean of 32: nothing looks lost
  std::vector<double> stamps;
  for (double t = 0.0; t < end; t += spacing * jitter(random)) stamps.push_back(t);
  return stamps;
}

FourierIntegrals integrate(const std::vector<double>& stamps, const Exponentials& signal, double offset = 0.0) {
  FourierIntegrals stream(kBand, 1);
  FourierIntegrals::Phases phases(kBand);
  for (const double t : stamps) {
    const double value = signal.at(t) + offset;
    stream.push(t, &value, phases);
  }
  return stream;
}

// x e^(-j w (t - a)) by the straight line between stamps, integrated over [a, b].
Complex byStraightLines(const std::vector<double>& stamps, const Exponentials& signal, double omega, double a,
                        double b) {
  const auto at = [&](double t) {
    return (signal.at(t) - signal.at(stamps.front())) * std::exp(Complex(0.0, -omega * (t - a)));
  };
  Complex sum;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const double from = std::max(stamps[i - 1], a), to = std::min(stamps[i], b);
    if (from >= to) continue;
    const Complex left = at(stamps[i - 1]), slope = (at(stamps[i]) - left) / (stamps[i] - stamps[i - 1]);
    sum += (to - from) * (left + slope * ((from + to) / 2.0 - stamps[i - 1]));
  }
  return sum;
}

TEST(FourierIntegrals, OfASineOfABinOnEvenStampsAreHalfTheBlockInThatBinAndZeroElsewhere) {
  for (const int bin : {2, 7, 31}) {
    Exponentials sine;
    sine.addSine(1.5, bin / kBand.length, 0.4);
    const FourierIntegrals stream = integrate(evenStamps(0.01, 6.1), sine);
    for (const long half : {1L, 2L, 4L}) {
      const Eigen::ArrayXcd block = wholeBlock(kBand, stream, half);
      for (int i = 0; i < kBand.spectrumSize(); ++i) {
        const double turned = half % 2 == 0 && bin % 2 == 1 ? -1.0 : 1.0;  // the block begins half a block later
        const Complex expected = kBand.first - 1 + i == bin ? turned * std::polar(1.5, 0.4) : Complex{};
        EXPECT_NEAR(std::abs(block[i] - expected), 0.0, 1e-12) << "bin " << kBand.first - 1 + i << " of " << bin;
      }
    }
  }
}

TEST(FourierIntegrals, AreTheTrapezoidRuleOnTheStreamsOwnStampsWhereverTheHalfBlocksCutThem) {
  const Exponentials signal = severalSines();
  for (const auto& stamps : {evenStamps(0.0073, 4.2), unevenStamps(0.01, 4.2, 3)}) {
    const FourierIntegrals stream = integrate(stamps, signal);
    for (const long half : {0L, 1L, 2L, 3L})
      for (int i = 0; i < kBand.spectrumSize(); ++i) {
        const double a = static_cast<double>(half), omega = kBand.omega(kBand.first - 1 + i);
        EXPECT_NEAR(std::abs((*stream.half(half))(i, 0) - byStraightLines(stamps, signal, omega, a, a + 1.0)), 0.0,
                    1e-11);
      }
  }
}

TEST(FourierIntegrals, OnUnevenStampsDifferFromTheClosedFormByNoMoreThanTheTrapezoidRule) {
  Exponentials sine;
  sine.addSine(2.0, 1.37, 0.9);
  const std::vector<double> stamps = unevenStamps(0.005, 4.2, 5);
  const FourierIntegrals stream = integrate(stamps, sine);
  double cubes = 0.0;
  for (std::size_t i = 1; i < stamps.size() && stamps[i - 1] < 3.0; ++i)
    if (stamps[i] > 1.0) cubes += std::pow(stamps[i] - stamps[i - 1], 3);
  for (int i = 0; i < kBand.spectrumSize(); ++i) {
    const double omega = kBand.omega(kBand.first - 1 + i);
    // The constant x_0 has no part in a bin; of the straight lines' product with it the rule makes an error, too.
    const double curvature = 2.0 * std::pow(omega + 2.0 * M_PI * 1.37, 2) + std::abs(sine.at(0.0)) * omega * omega;
    const Complex expected = sine.integral(1.0, 2.0, omega);
    EXPECT_LT(std::abs(wholeBlock(kBand, stream, 2)[i] - expected), curvature * cubes / 12.0);
  }
}

// The weights of t +- h, t +- 2 h at t are 4/6 and -1/6: of a sine of w the cubic misses 1 - (4 cos wh - cos 2wh) / 3.
TEST(FourierIntegrals, ALostReadingIsInterpolatedByTheCubicThroughItsNeighbours) {
  Exponentials sine;
  sine.addSine(1.5, 7.3, 0.4);
  const std::vector<double> all = evenStamps(0.01, 4.2);
  for (const std::size_t lost : {133u, 200u, 201u}) {  // 2 s is an end of a half block
    std::vector<double> lossy = all;
    lossy.erase(lossy.begin() + static_cast<std::ptrdiff_t>(lost));
    const double turn = 2.0 * M_PI * 7.3 * 0.01;
    const double missed = (1.0 - (4.0 * std::cos(turn) - std::cos(2.0 * turn)) / 3.0) * sine.at(all[lost]);
    const long half = lost < 200 ? 1 : 2;  // the newer one of a block that it lies within
    const Eigen::ArrayXcd error =
        wholeBlock(kBand, integrate(lossy, sine), half) - wholeBlock(kBand, integrate(all, sine), half);
    for (int i = 0; i < kBand.spectrumSize(); ++i) {
      const double phase = kBand.omega(kBand.first - 1 + i) * (all[lost] - static_cast<double>(half - 1));
      EXPECT_NEAR(std::abs(error[i] + 0.01 * missed * std::polar(1.0, -phase)), 0.0, 1e-12) << lost << ", bin " << i;
    }
  }
}

TEST(FourierIntegrals, ThreeLostReadingsAreInterpolatedAndFourAreTheStraightLine) {
  const std::vector<double> all = evenStamps(0.01, 4.2);
  const auto cubic = [](double t) { return std::pow(t - 1.3, 3) - 2.0 * t; };
  const auto onlyAt132 = [&](double t) { return t == all[132] ? 1.0 : 0.0; };
  const auto block = [&](int lost, const std::function<double(double)>& signal) {
    FourierIntegrals stream(kBand, 1);
    FourierIntegrals::Phases phases(kBand);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double value = signal(all[i]);
      if (i < 133 || i >= 133 + static_cast<std::size_t>(lost)) stream.push(all[i], &value, phases);
    }
    return wholeBlock(kBand, stream, 2);
  };
  EXPECT_LT((block(3, cubic) - block(0, cubic)).abs().maxCoeff(), 1e-13);
  EXPECT_NEAR(std::abs(block(4, onlyAt132)[0]), (0.01 + 0.05) / 2.0, 1e-12);
}

// Two readings 1 ms apart among others of 10 ms: their slope is noise.
TEST(FourierIntegrals, NothingIsInterpolatedBesideReadingsThatAreMuchCloser) {
  std::vector<double> stamps = evenStamps(0.01, 4.2);
  stamps.erase(stamps.begin() + 133);
  stamps.insert(stamps.begin() + 133, stamps[133] + 0.001);
  std::sort(stamps.begin(), stamps.end());
  const auto push = [&](double noise) {
    FourierIntegrals stream(kBand, 1);
    FourierIntegrals::Phases phases(kBand);
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      const double value = i == 133 ? noise : 0.0;
      stream.push(stamps[i], &value, phases);
    }
    return stream;
  };
  // By the trapezoid rule the reading at 1.34 s counts for (20 + 1) ms / 2.
  const double counts = (wholeBlock(kBand, push(1.0), 2) - wholeBlock(kBand, push(0.0), 2)).abs()[0];
  EXPECT_NEAR(counts, 0.0105, 1e-9);
}

TEST(FourierIntegrals, AreNotChangedByAConstantHoweverUnevenTheStamps) {
  const std::vector<double> stamps = unevenStamps(0.01, 4.2, 7);
  const FourierIntegrals plain = integrate(stamps, severalSines()), moved = integrate(stamps, severalSines(), 4096.0);
  // A reading of 4096 is rounded to 2^-41; the half block is 1 s.
  for (const long half : {0L, 3L}) EXPECT_LT((*plain.half(half) - *moved.half(half)).abs().maxCoeff(), 1e-12);
}

TEST(FourierIntegrals, OfAHalfBlockWithAGapAreNone) {
  const double longest = kBand.length / 32.0;
  const auto wholeHalves = [&](double gap_from, double gap) {
    FourierIntegrals stream(kBand, 1);
    FourierIntegrals::Phases phases(kBand);
    const double value = 1.0;
    for (int i = 0; i < 430; ++i)
      if (const double t = 0.01 * i; t <= gap_from || t > gap_from + gap - 1e-9) stream.push(t, &value, phases);
    std::vector<bool> result;
    for (long half = 0; half < 4; ++half) result.push_back(stream.half(half) != nullptr);
    return result;
  };
  EXPECT_EQ(wholeHalves(1.5, longest - 0.01), (std::vector<bool>{true, true, true, true}));
  EXPECT_EQ(wholeHalves(1.5, longest + 0.01), (std::vector<bool>{true, false, true, true}));
  EXPECT_EQ(wholeHalves(1.97, longest + 0.01), (std::vector<bool>{true, false, false, true}));
  EXPECT_EQ(wholeHalves(0.99, 2.5), (std::vector<bool>{false, false, false, false}));
}

TEST(FourierIntegrals, OfAStreamThatBeginsLateLackTheHalfBlockItBeginsIn) {
  const auto firstHalf = [&](double begin) {
    FourierIntegrals stream(kBand, 1);
    FourierIntegrals::Phases phases(kBand);
    const double value = 1.0;
    for (int i = 0; i < 110; ++i) stream.push(begin + 0.01 * i, &value, phases);
    return stream.half(0);
  };
  EXPECT_NE(firstHalf(0.02), nullptr);
  EXPECT_EQ(firstHalf(0.2), nullptr);
}

TEST(FourierIntegrals, AreKeptForEightHalfBlocksAndForEveryChannelOnItsOwn) {
  FourierIntegrals both(kBand, 2), second(kBand, 1);
  FourierIntegrals::Phases phases(kBand);
  for (int i = 0; i <= 1200; ++i) {
    const double t = 0.01 * i, values[] = {std::cos(5.0 * t), std::sin(3.0 * t)};
    both.push(t, values, phases);
    second.push(t, values + 1, phases);
  }
  EXPECT_EQ(both.openHalf(), 12);
  EXPECT_EQ(both.half(3), nullptr);
  for (long half = 4; half < 12; ++half) {
    ASSERT_NE(both.half(half), nullptr) << half;
    EXPECT_EQ((both.half(half)->col(1) - second.half(half)->col(0)).abs().maxCoeff(), 0.0);
  }
  EXPECT_EQ(both.half(12), nullptr);
}

}  // namespace
}  // namespace suspension_health_monitor
