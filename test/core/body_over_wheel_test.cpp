#include "suspension_health_monitor/internal/vehicle/body_over_wheel.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

using Complex = std::complex<double>;

constexpr double kRate = 100.0, kDuration = 80.0;

/// One frequency of a signal.
struct Line {
  double omega;
  Complex amplitude;
};
using Lines = std::vector<Line>;

/// Random phases at 0.3 to 18 Hz: a wheel that shakes with 2 m/s^2 and hops at 10 Hz.
Lines wheel(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> phase(0.0, 2.0 * M_PI), off(0.0, 1.0);
  Lines lines;
  for (double frequency = 0.3; frequency < 18.0; frequency += 0.1) {
    const double hop = 1.0 + 2.0 / (1.0 + std::pow((frequency - 10.0) / 2.0, 2.0));
    lines.push_back({2.0 * M_PI * (frequency + 0.1 * off(random)), std::polar(0.2 * hop, phase(random))});
  }
  return lines;
}

double at(const Lines& lines, double t) {
  double sum = 0.0;
  for (const Line& line : lines) sum += (line.amplitude * std::polar(1.0, line.omega * t)).real();
  return sum;
}

/// The tops over wheels, by the equation of motion s^2 z_i = sum_j a_ij / a_jj (b1 s + b0) (w_j - z_j) at every
/// frequency of every wheel.
/// @param coupling  a_ij / a_jj.
std::vector<Lines> topsOver(const std::vector<Lines>& wheels, const Eigen::MatrixXd& coupling, double b1, double b0) {
  const auto n = static_cast<Eigen::Index>(wheels.size());
  std::vector<Lines> tops(wheels.size());
  for (Eigen::Index j = 0; j < n; ++j)
    for (const Line& line : wheels[static_cast<std::size_t>(j)]) {
      const Complex s(0.0, line.omega);
      const Eigen::MatrixXcd force = (b1 * s + b0) * coupling.cast<Complex>();
      const Eigen::VectorXcd z = (s * s * Eigen::MatrixXcd::Identity(n, n) + force).inverse() * force.col(j);
      for (Eigen::Index i = 0; i < n; ++i)
        tops[static_cast<std::size_t>(i)].push_back({line.omega, z[i] * line.amplitude});
    }
  return tops;
}

/// What IMUs read whose z points up.  @param late  stamps of the first IMU, by [s].
std::vector<BodyOverWheel> found(const std::vector<Lines>& imus, double late = 0.0, double sign = 1.0) {
  ImuSpectra spectra(imus.size());
  for (double t = 1.0; t < kDuration; t += 1.0 / kRate)
    for (std::size_t i = 0; i < imus.size(); ++i) {
      SixAxes reading = SixAxes::Zero();
      reading[2] = (i == 0 ? sign : 1.0) * at(imus[i], i == 0 ? t - late : t);
      spectra.push(i, fromSeconds(t), reading);
    }
  spectra.restart();
  const std::vector<Eigen::Vector3d> up(imus.size(), Eigen::Vector3d::UnitZ());
  return findBodiesOverWheels(
      spectra.along(up, std::vector<bool>(imus.size(), false), std::vector<double>(imus.size(), kRate)));
}

TEST(ImuSpectra, RmsOfASineIsInItsBandAlone) {
  ImuSpectra spectra(1);
  for (double t = 0.0; t < kDuration; t += 1.0 / kRate) {
    SixAxes reading = SixAxes::Zero();
    reading.head<3>() << 9.81, 3.0 * std::sin(2.0 * M_PI * 5.0 * t), 0.0;
    spectra.push(0, fromSeconds(t), reading);
  }
  EXPECT_NEAR(spectra.rms(0, Eigen::Vector3d::UnitY(), 3.0, 20.0), 3.0 / std::sqrt(2.0), 0.01);
  EXPECT_NEAR(spectra.rms(0, Eigen::Vector3d::UnitY(), 0.5, 3.0), 0.0, 0.01);
  EXPECT_NEAR(spectra.rms(0, Eigen::Vector3d::UnitX(), 0.25, 20.0), 0.0, 0.01) << "gravity is no motion";
}

// Hann's window mixes bins of 0.125 Hz, over which 1 / s^2 changes by a fifth at the bounce: b0 is known to a tenth.
TEST(FindBodiesOverWheels, FindsTheStrutThatWasBuilt) {
  const double b1 = 5.0, b0 = 66.0;
  const std::vector<Lines> wheels{wheel(1)};
  const Lines top = topsOver(wheels, Eigen::MatrixXd::Identity(1, 1), b1, b0)[0];
  for (const double late : {0.0, 0.003, -0.021}) {
    for (const double sign : {1.0, -1.0}) {
      const std::vector<BodyOverWheel> pairs = found({top, wheels[0]}, late, sign);
      ASSERT_EQ(pairs.size(), 1U) << late << ' ' << sign;
      EXPECT_EQ(pairs[0].body, 0U);
      EXPECT_EQ(pairs[0].wheel, 1U);
      EXPECT_EQ(pairs[0].is_reversed, sign < 0.0);
      EXPECT_TRUE(pairs[0].is_own);
      EXPECT_GT(pairs[0].explained, 0.95);
      EXPECT_NEAR(pairs[0].damping_to_mass, b1, 0.05 * b1);
      EXPECT_NEAR(pairs[0].stiffness_to_mass, b0, 0.1 * b0);
      EXPECT_NEAR(pairs[0].delay, late, 1e-3);
    }
  }
}

TEST(FindBodiesOverWheels, EachWheelGetsItsOwnTopOnABodyThatCouplesThem) {
  const std::vector<Lines> wheels{wheel(1), wheel(2), wheel(3)};
  Eigen::MatrixXd coupling(3, 3);
  coupling << 1.0, 0.5, -0.6, 0.4, 1.0, 0.3, -0.6, 0.3, 1.0;
  const std::vector<Lines> tops = topsOver(wheels, coupling, 6.0, 80.0);
  const std::vector<BodyOverWheel> pairs = found({wheels[1], tops[0], wheels[0], tops[1], wheels[2], tops[2]});
  ASSERT_EQ(pairs.size(), 3U);
  const std::size_t body_of[] = {3, 0, 1, 0, 5};
  for (const BodyOverWheel& pair : pairs) {
    EXPECT_EQ(pair.body, body_of[pair.wheel]) << pair.wheel;
    EXPECT_NEAR(pair.damping_to_mass, 6.0, 0.3);
    EXPECT_NEAR(pair.stiffness_to_mass, 80.0, 8.0);
  }
}

TEST(FindBodiesOverWheels, FindsNothingWhereNothingIs) {
  const std::vector<Lines> wheels{wheel(1), wheel(2)};
  EXPECT_TRUE(found({wheels[0], wheels[1]}).empty()) << "two wheels";
  EXPECT_TRUE(found({wheels[0], wheels[0]}).empty()) << "two IMUs on one part";
  Lines softly = wheels[1];
  for (Line& line : softly) line.amplitude *= 0.1;
  EXPECT_TRUE(found({wheels[0], softly}).empty()) << "what moves less, and otherwise";
}

TEST(FindBodiesOverWheels, AnImuThatIsSilentDoesNotHideTheOthers) {
  const std::vector<Lines> wheels{wheel(1)};
  const Lines top = topsOver(wheels, Eigen::MatrixXd::Identity(1, 1), 5.0, 66.0)[0];
  EXPECT_EQ(found({top, {}, wheels[0]}).size(), 1U);
}

}  // namespace
}  // namespace suspension_health_monitor
