#include "suspension_health_monitor/internal/vehicle/body_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

/// Rows by Newton's law of a rigid body, written out strut by strut.
struct Body {
  double mass_to_pitch, mass_to_roll, x, y;  // M/Iyy, M/Ixx [1/m^2], centre of gravity [m]
  StrutPlaces places;
  std::vector<double> c, k;         // over the mass
  double bar_k = 0.0, bar_c = 0.0;  // between struts 0 and 1, over the mass

  double mobility(std::size_t i, std::size_t j) const {
    return 1.0 + (places[i][0] - x) * (places[j][0] - x) * mass_to_pitch +
           (places[i][1] - y) * (places[j][1] - y) * mass_to_roll;
  }
  double own(std::size_t i, const std::vector<double>& strut, double bar) const {
    return mobility(i, i) * strut[i] + (i < 2 ? bar * (mobility(i, i) - mobility(i, 1 - i)) : 0.0);
  }
  BodyRows rows(double noise, double error, unsigned seed) const {
    const auto n = static_cast<Eigen::Index>(places.size());
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    BodyRows rows;
    rows.rate = rows.travel = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < places.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        const double difference = j < 2 ? mobility(i, j) - mobility(i, 1 - j) : 0.0;
        rows.rate(row, column) = mobility(i, j) * c[j] + bar_c * difference;
        rows.travel(row, column) = mobility(i, j) * k[j] + bar_k * difference;
      }
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::VectorXd stddev(2 * n);
      const double rate = rows.rate.row(i).cwiseAbs().maxCoeff(), travel = rows.travel.row(i).cwiseAbs().maxCoeff();
      stddev << Eigen::VectorXd::Constant(n, rate), Eigen::VectorXd::Constant(n, travel);
      for (Eigen::Index j = 0; j < n; ++j) {
        rows.rate(i, j) += std::hypot(noise, error) * rate * normal(random);
        rows.travel(i, j) += std::hypot(noise, error) * travel * normal(random);
      }
      rows.covariance.push_back((noise * stddev).cwiseAbs2().asDiagonal());
    }
    return rows;
  }
};

Body car() {
  return {0.65,
          2.7,
          -0.1,
          0.05,
          {{1.2, 0.7}, {1.2, -0.7}, {-1.5, 0.7}, {-1.5, -0.7}},
          {1.6, 1.7, 1.9, 2.0},
          {18.0, 19.0, 30.0, 28.0}};
}

Body halfCar() { return {0.65, 0.0, -0.1, 0.0, {{1.2, 0.0}, {-1.5, 0.0}}, {1.6, 1.9}, {18.0, 30.0}}; }

Body tricycle() {
  return {0.9, 3.0, 0.0, 0.0, {{1.2, 0.0}, {-1.0, 0.6}, {-1.0, -0.6}}, {1.6, 1.7, 1.9}, {18.0, 19.0, 30.0}};
}

Body sixWheels() {
  Body body = car();
  body.places.insert(body.places.end(), {{-0.2, 0.7}, {-0.2, -0.7}});
  body.c.insert(body.c.end(), {1.5, 1.4});
  body.k.insert(body.k.end(), {20.0, 21.0});
  return body;
}

constexpr double kNoise = 0.002;

TEST(BodyFit, FindsTheBodyOfTwoThreeFourAndSixStruts) {
  for (const Body& body : {halfCar(), tricycle(), car(), sixWheels()}) {
    const auto fit = fitRigidBody(body.rows(kNoise, 0.0, 1), body.places);
    ASSERT_TRUE(fit) << body.places.size();
    EXPECT_LT(fit->phi, 0.005);
    EXPECT_NEAR(fit->inertia.mass_to_pitch_inertia.value, body.mass_to_pitch,
                5.0 * fit->inertia.mass_to_pitch_inertia.stddev);
    EXPECT_LT(fit->inertia.mass_to_pitch_inertia.stddev, 0.1 * body.mass_to_pitch);
    EXPECT_NEAR(fit->inertia.x.value, body.x, 5.0 * fit->inertia.x.stddev);
    if (body.places.size() > 2) {
      EXPECT_NEAR(fit->inertia.mass_to_roll_inertia.value, body.mass_to_roll,
                  5.0 * fit->inertia.mass_to_roll_inertia.stddev);
      EXPECT_NEAR(fit->inertia.y.value, body.y, 5.0 * fit->inertia.y.stddev);
    } else {
      EXPECT_TRUE(std::isinf(fit->inertia.mass_to_roll_inertia.stddev)) << "two struts do not see it roll";
    }
    for (std::size_t i = 0; i < body.places.size(); ++i) {
      EXPECT_NEAR(fit->b1[i].value, body.own(i, body.c, 0.0), 5.0 * fit->b1[i].stddev);
      EXPECT_NEAR(fit->b0[i].value, body.own(i, body.k, 0.0), 5.0 * fit->b0[i].stddev);
    }
  }
}

TEST(BodyFit, TellsTheErrorOfTheModelAndItsIntervalsHold) {
  const Body body = car();
  constexpr double kError = 0.05;
  constexpr int kDraws = 40;
  double phi = 0.0;
  int inside = 0;
  for (unsigned seed = 1; seed <= kDraws; ++seed) {
    const BodyRows rows = body.rows(kNoise, kError, seed);
    const auto fit = fitRigidBody(rows, body.places, {rows, rows});
    ASSERT_TRUE(fit);
    phi += fit->phi / kDraws;
    EXPECT_TRUE(fit->found.empty()) << "bars that are none";
    for (std::size_t i = 0; i < body.places.size(); ++i) {
      const double b1 = body.own(i, body.c, 0.0), b0 = body.own(i, body.k, 0.0);
      inside += std::abs(fit->b1[i].value - b1) < 1.96 * fit->b1[i].stddev ? 1 : 0;
      inside += std::abs(fit->b0[i].value - b0) < 1.96 * fit->b0[i].stddev ? 1 : 0;
    }
  }
  EXPECT_NEAR(phi, kError, 0.01);
  EXPECT_GT(inside, 0.9 * kDraws * 8);
}

TEST(BodyFit, NamesABarAndItsShare) {
  Body body = car();
  body.bar_k = 8.0;
  const auto fit =
      fitRigidBody(body.rows(kNoise, 0.0, 1), body.places, {body.rows(kNoise, 0.0, 2), body.rows(kNoise, 0.0, 3)});
  ASSERT_TRUE(fit);
  ASSERT_EQ(fit->found.size(), 1u);
  EXPECT_EQ(fit->found[0].struts, StrutPair(0, 1));
  for (const std::size_t end : {0, 1}) {
    const Measured& stiffness = fit->found[0].stiffness[end];
    EXPECT_NEAR(stiffness.value, body.bar_k * body.mobility(end, end), 5.0 * stiffness.stddev) << end;
  }
  EXPECT_NEAR(fit->b0[0].value, body.own(0, body.k, body.bar_k), 5.0 * fit->b0[0].stddev) << "its share is in b0";
}

TEST(BodyFit, NamesNoBarByNegativeOnesOrByHalvesThatDisagree) {
  Body negative = car(), none = car(), bar = car();
  negative.bar_k = -4.0;
  bar.bar_k = 8.0;
  const auto by_negative = fitRigidBody(negative.rows(kNoise, 0.0, 1), negative.places,
                                        {negative.rows(kNoise, 0.0, 2), negative.rows(kNoise, 0.0, 3)});
  ASSERT_TRUE(by_negative);
  EXPECT_TRUE(by_negative->found.empty());
  EXPECT_GT(by_negative->phi, 0.02) << "what no bar explains is an error of the model";
  const auto by_halves =
      fitRigidBody(bar.rows(kNoise, 0.0, 1), bar.places, {bar.rows(kNoise, 0.0, 2), none.rows(kNoise, 0.0, 3)});
  ASSERT_TRUE(by_halves);
  EXPECT_TRUE(by_halves->found.empty());
}

TEST(BodyFit, AbsoluteValuesCarryTheErrorOfTheModelAndFriction) {
  const Body body = car();
  const auto fit = fitRigidBody(body.rows(kNoise, 0.05, 1), body.places);
  ASSERT_TRUE(fit);
  const Eigen::Vector2d own(4.0, 80.0);
  const Eigen::Array2d variances = fit->modelVariances(0, own, 0.3);
  const double of_b1 = fit->b1[0].stddev / fit->b1[0].value * own[0];
  EXPECT_NEAR(variances[0], of_b1 * of_b1 + 0.03, 1e-12);
  EXPECT_GT(variances[1], 0.0);
}

TEST(BodyFit, RowsOfOneSensorAreNoMoreThanItsMotions) {
  const Body body = car();
  BodyRows rows = body.rows(kNoise, 0.05, 1);
  const auto apart = fitRigidBody(rows, body.places);
  rows.is_by_body = true;
  const auto together = fitRigidBody(rows, body.places);
  ASSERT_TRUE(apart && together);
  EXPECT_GT(together->b1[0].stddev, 1.2 * apart->b1[0].stddev);
}

TEST(BodyFit, PairsAreSideBySide) {
  const auto pairs = pairsOf(sixWheels().places);
  EXPECT_EQ(pairs, (std::vector<StrutPair>{{0, 1}, {2, 3}, {4, 5}}));
  EXPECT_TRUE(pairsOf(halfCar().places).empty());
}

}  // namespace
}  // namespace suspension_health_monitor
