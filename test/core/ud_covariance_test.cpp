#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "suspension_health_monitor/internal/identification/recursive_covariance.h"

namespace suspension_health_monitor {
namespace {

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

// P of Eq. (16) and (25) as printed.
template <class Scalar>
class Textbook {
 public:
  Textbook(int size, double variance) : p_(Matrix<Scalar>::Identity(size, size) * static_cast<Scalar>(variance)) {}

  void update(const Eigen::VectorXd& regressor, double noise, double lambda) {
    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1> phi = regressor.cast<Scalar>();
    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1> p_phi = p_ * phi;
    const Matrix<Scalar> step = p_phi * (phi.transpose() * p_) / (static_cast<Scalar>(noise) + phi.dot(p_phi));
    p_ = (p_ - step) / static_cast<Scalar>(lambda);
  }

  const Matrix<Scalar>& matrix() const { return p_; }

 private:
  Matrix<Scalar> p_;
};

UdCovariance released(int size, double variance) {
  UdCovariance covariance(size);
  for (int i = 0; i < size; ++i) covariance.release(i, variance);
  return covariance;
}

Eigen::VectorXd randomRegressor(int size, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd regressor(size);
  for (double& entry : regressor) entry = normal(engine);
  return regressor;
}

TEST(UdCovariance, EqualsTheTextbookRecursionInLongDouble) {
  for (const int size : {1, 2, 4, 7}) {
    UdCovariance covariance = released(size, 1e5);
    Textbook<long double> textbook(size, 1e5);
    std::mt19937_64 engine(7);
    for (int k = 0; k < 300; ++k) {
      const Eigen::VectorXd regressor = randomRegressor(size, engine);
      const double noise = 0.98 * (0.1 + std::abs(regressor[0]));
      covariance.update(regressor, noise, 0.98);
      textbook.update(regressor, noise, 0.98);
      if (k < size) continue;  // P spans ten decades until every direction has had its row
      const Eigen::MatrixXd expected = textbook.matrix().cast<double>();
      EXPECT_LT((covariance.matrix() - expected).norm(), 1e-9 * expected.norm()) << "row " << k;
    }
  }
}

TEST(UdCovariance, ReturnsTheGainOfTheTextbook) {
  UdCovariance covariance = released(3, 10.0);
  std::mt19937_64 engine(8);
  for (int k = 0; k < 20; ++k) {
    const Eigen::VectorXd regressor = randomRegressor(3, engine);
    const Eigen::VectorXd p_phi = covariance.matrix() * regressor;
    const Eigen::VectorXd expected = p_phi / (0.9 + regressor.dot(p_phi));
    const Eigen::VectorXd gain = covariance.update(regressor, 0.9, 0.9);
    EXPECT_LT((gain - expected).norm(), 1e-12 * expected.norm());
    if (k < 3) continue;  // the ceiling holds directions that have not had a row
    // P(k) phi of (17) is the same vector.
    EXPECT_LT((covariance.matrix() * regressor - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(UdCovariance, GivesTheVarianceOfEveryParameter) {
  UdCovariance covariance = released(4, 3.0);
  std::mt19937_64 engine(9);
  for (int k = 0; k < 10; ++k) covariance.update(randomRegressor(4, engine), 0.95, 0.95);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(covariance.variance(i), covariance.matrix()(i, i), 1e-14);
}

TEST(UdCovariance, OfASumOfParametersIsThatOfItsParts) {
  UdCovariance covariance = released(4, 3.0);
  std::mt19937_64 engine(11);
  for (int k = 0; k < 10; ++k) covariance.update(randomRegressor(4, engine), 0.95, 0.95);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(4, 4);
  sum(1, 3) = 1.0;
  const Eigen::MatrixXd expected = sum * covariance.matrix() * sum.transpose();
  covariance.addTo(1, 3);
  EXPECT_LT((covariance.matrix() - expected).norm(), 1e-14);
}

double smallestEigenvalue(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}

// One direction is excited all the time, the others for 100 rows in 100 000, and weakly.
TEST(UdCovariance, StaysSymmetricAndPositiveWhereTheTextbookRecursionFails) {
  UdCovariance covariance = released(3, 1e5);
  Textbook<double> textbook(3, 1e5);
  std::mt19937_64 engine(10);
  for (int k = 0; k < 1'000'000; ++k) {
    Eigen::VectorXd regressor = randomRegressor(3, engine);
    if (k % 100'000 > 100) regressor[1] = 1e-3 * regressor[0] + 1e-9 * regressor[1];
    if (k % 100'000 > 50) regressor[2] = 0.0;
    covariance.update(regressor, 0.98, 0.98);
    textbook.update(regressor, 0.98, 0.98);
    if (k % 9973 != 0) continue;
    const Eigen::MatrixXd p = covariance.matrix();
    ASSERT_TRUE(p.allFinite());
    ASSERT_EQ((p - p.transpose()).cwiseAbs().maxCoeff(), 0.0);
    ASSERT_GE(smallestEigenvalue(p), -1e-15 * p.norm());
    for (int i = 0; i < 3; ++i) ASSERT_GT(covariance.variance(i), 0.0);
  }
  const bool textbook_is_sound = textbook.matrix().allFinite() && smallestEigenvalue(textbook.matrix()) > 0.0;
  EXPECT_FALSE(textbook_is_sound) << "this drive no longer shows why the factored form is used";
}

TEST(UdCovariance, NeverGrowsAboveTheVarianceAtTheStart) {
  UdCovariance covariance = released(2, 50.0);
  for (int k = 0; k < 10'000; ++k) covariance.update(Eigen::VectorXd::Unit(2, 0), 0.98, 0.98);
  EXPECT_DOUBLE_EQ(covariance.variance(1), 50.0);
  EXPECT_NEAR(covariance.variance(0), 1.0 - 0.98, 1e-12);  // 1 / sum of 0.98^i
}

TEST(UdCovariance, KeepsAParameterFixedUntilItIsReleased) {
  UdCovariance covariance(2);
  covariance.release(0, 5.0);
  EXPECT_TRUE(covariance.isReleased(0));
  EXPECT_FALSE(covariance.isReleased(1));
  const Eigen::VectorXd gain = covariance.update(Eigen::VectorXd::Ones(2), 1.0, 1.0);
  EXPECT_NEAR(gain[0], 5.0 / 6.0, 1e-15);
  EXPECT_EQ(gain[1], 0.0);
  EXPECT_EQ(covariance.variance(1), 0.0);
}

TEST(UdCovariance, ScalesTheCeilingWithTheCovariance) {
  UdCovariance covariance = released(1, 4.0);
  covariance.scale(0.5);
  EXPECT_DOUBLE_EQ(covariance.variance(0), 2.0);
  covariance.update(Eigen::VectorXd::Zero(1), 1.0, 0.5);
  EXPECT_DOUBLE_EQ(covariance.variance(0), 2.0);
}

TEST(UdCovariance, OfOtherParametersKeepsWhatIsKnownOfThoseThatStay) {
  UdCovariance before = released(4, 1e5);
  std::mt19937_64 engine(5);
  for (int k = 0; k < 50; ++k) before.update(randomRegressor(4, engine), 0.9, 0.98);
  const std::vector<ColumnOrigin> sources{{2}, {}, {0}, {3}};
  UdCovariance after(before, sources);
  const Eigen::MatrixXd p = before.matrix(), kept = after.matrix();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const auto from = sources[static_cast<std::size_t>(i)].before, to = sources[static_cast<std::size_t>(j)].before;
      EXPECT_NEAR(kept(i, j), from && to ? p(*from, *to) : 0.0, 1e-12 * p.norm()) << i << ", " << j;
    }
  EXPECT_TRUE(after.isReleased(0));
  EXPECT_FALSE(after.isReleased(1));
  after.update(randomRegressor(4, engine), 0.9, 0.98);
  EXPECT_EQ(after.variance(1), 0.0);
  EXPECT_GT(after.variance(2), 0.0);
}

}  // namespace
}  // namespace suspension_health_monitor
