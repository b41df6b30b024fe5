// The coupling of struts from the moments of their rows.
#include "suspension_health_monitor/internal/vehicle/coupling_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace suspension_health_monitor {
namespace {

constexpr int kRows = 2000, kDrives = 300;
constexpr CouplingColumns kTwo{2, 0};

StrutMatrix ratiosOfTwo() {
  StrutMatrix ratios(2, 2);
  ratios << 1.0, -0.4, 0.3, 1.0;
  return ratios;
}

// Moments of rows of two struts, b1 = 2 and 3, b0 = 40 and 60, whose columns have a size of 1 and whose outputs are
// wrong by what one gyro reads wrong, `turned`, far more than by anything else.
CouplingMoments momentsOfDrive(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const StrutMatrix ratios = ratiosOfTwo();
  CouplingMoments moments = CouplingMoments::Zero(kTwo.size(), kTwo.size());
  for (int k = 0; k < kRows; ++k) {
    CouplingRow row(kTwo.size());
    for (int a = 0; a < kTwo.numOwn(); ++a) row[a] = normal(random);
    const StrutVector own = Eigen::Vector2d(2.0 * row[0] + 40.0 * row[2], 3.0 * row[1] + 60.0 * row[3]);
    const double turned = 30.0 * normal(random);
    const Eigen::Vector2d wrong(turned + 2.0 * normal(random), -turned + 2.0 * normal(random));
    row.tail(2) = ratios * own + wrong;
    moments += row * row.transpose() / kRows;
  }
  return moments;
}

// The mean square of 300 standard normal numbers has a standard deviation of sqrt(2 / 300) = 0.08.
TEST(CouplingSolver, ErrsAsMuchAsItSaysWhereOneGyroMakesAllTopsWrong) {
  const StrutMatrix ratios = ratiosOfTwo();
  CouplingMoments noise = CouplingMoments::Zero(kTwo.size(), kTwo.size());
  noise.diagonal().head(kTwo.numOwn()).setConstant(1e-12);
  noise.diagonal().tail(2).setOnes();
  double damping = 0.0, stiffness = 0.0, ratio = 0.0;
  for (unsigned seed = 1; seed <= kDrives; ++seed) {
    CouplingSolver solver(kTwo, noise);
    const CouplingEstimate& found = solver.solve(momentsOfDrive(seed), kRows);
    damping += std::pow((found.damping_to_mass[0] - 2.0) / found.own_stddevs(0, 0), 2) / kDrives;
    stiffness += std::pow((found.stiffness_to_mass[1] - 60.0) / found.own_stddevs(1, 1), 2) / kDrives;
    ratio += std::pow((found.coupling.ratios(0, 1) - ratios(0, 1)) / found.stddevs(0, 1), 2) / kDrives;
  }
  const double most = 5.0 * std::sqrt(2.0 / kDrives);
  for (const double mean_square : {damping, stiffness, ratio}) EXPECT_NEAR(mean_square, 1.0, most);
}

}  // namespace
}  // namespace suspension_health_monitor
