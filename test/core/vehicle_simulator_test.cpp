#include "suspension_health_monitor/internal/simulation/vehicle_simulator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>

#include "simulated_drive.h"
#include "simulated_vehicle.h"

namespace suspension_health_monitor {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

TEST(VehicleModels, AreValidAndPlausibleAtEveryStrut) {
  for (const char* name : {"sedan", "ugv", "truck", "half_sedan"}) {
    const Vehicle vehicle = namedVehicle(name);
    EXPECT_NO_THROW(validate(vehicle)) << name;
    for (const VehicleStrut& strut : vehicle.struts) {
      const double b1 = vehicle.mobility(strut, strut) * strut.damping;
      const double b0 = vehicle.mobility(strut, strut) * strut.stiffness;
      const double hop = std::sqrt((strut.tyre_stiffness + strut.stiffness) / strut.wheel_mass) / (2.0 * M_PI);
      EXPECT_GT(std::sqrt(b0) / (2.0 * M_PI), 1.0) << name << ' ' << strut.name;
      EXPECT_LT(std::sqrt(b0) / (2.0 * M_PI), 3.0) << name << ' ' << strut.name;
      EXPECT_GT(b1 / (2.0 * std::sqrt(b0)), 0.2) << name << ' ' << strut.name;
      EXPECT_LT(b1 / (2.0 * std::sqrt(b0)), 0.4) << name << ' ' << strut.name;
      EXPECT_GT(hop, 8.0) << name << ' ' << strut.name;
      EXPECT_LT(hop, 16.0) << name << ' ' << strut.name;
    }
    EXPECT_NE(vehicle.struts.front().x, -vehicle.struts.back().x) << name;
  }
  EXPECT_THROW(namedVehicle("tank"), std::invalid_argument);
}

double cosineOf(const std::vector<double>& a, const std::vector<double>& b) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) ab += a[i] * b[i], aa += a[i] * a[i], bb += b[i] * b[i];
  return ab / std::sqrt(aa * bb);
}

/// Shares of the cross spectrum of two tracks, in phase, near some spatial frequencies: over bins and seeds.
std::vector<double> coherenceOf(const std::string& tracks, double distance, const std::vector<double>& frequencies) {
  constexpr double kStep = 0.17, kLength = 400.0;  // [m]; the rate of an ISO road has an even density up to 2.83 / m
  Vehicle axle = namedVehicle("half_sedan");
  axle.roll_inertia = 1.0;
  axle.speed = 1.0;
  axle.struts[0].x = axle.struts[1].x = 0.0;
  axle.struts[0].y = distance / 2.0;
  axle.struts[1].y = -distance / 2.0;
  const auto size = static_cast<Eigen::Index>(kLength / kStep);
  const Eigen::VectorXd places = Eigen::VectorXd::LinSpaced(size, 0.0, kStep * static_cast<double>(size - 1));
  const Eigen::ArrayXd window = 1.0 - (2.0 * M_PI / kLength * places.array()).cos();
  Eigen::MatrixXd rates(size, 2 * 24);  // left, right of every seed
  for (Eigen::Index k = 0; k < rates.cols(); k += 2) {
    std::vector<Road> roads = tracksOf(axle, tracks, static_cast<int>(k));
    for (Eigen::Index i = 0; i < size; ++i)
      rates.row(i).segment<2>(k) << roads[0](places[i]).rate, roads[1](places[i]).rate;
  }
  std::vector<double> shares;
  for (const double frequency : frequencies) {
    double cross = 0.0, square = 0.0;
    for (double n = 0.85 * frequency; n < 1.15 * frequency; n += 1.0 / kLength) {
      const Eigen::ArrayXd angle = 2.0 * M_PI * n * places.array();
      const Eigen::RowVectorXd real = (window * angle.cos()).matrix().transpose() * rates;
      const Eigen::RowVectorXd imaginary = (window * angle.sin()).matrix().transpose() * rates;
      for (Eigen::Index k = 0; k < rates.cols(); k += 2) {
        cross += real[k] * real[k + 1] + imaginary[k] * imaginary[k + 1];
        square += 0.5 * (real.segment<2>(k).squaredNorm() + imaginary.segment<2>(k).squaredNorm());
      }
    }
    shares.push_back(cross / square);
  }
  return shares;
}

TEST(Tracks, AreCoherentAsLinesOfAnIsotropicSurface) {
  const std::vector<double> frequencies{0.05, 0.1, 0.3};
  for (const double distance : {0.5, 1.5}) {
    const std::vector<double> shares = coherenceOf("coherent", distance, frequencies);
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const double x = 2.0 * M_PI * frequencies[i] * distance;
      EXPECT_NEAR(shares[i], x * std::cyl_bessel_k(1.0, x), 0.06) << distance << " m, " << frequencies[i] << " / m";
    }
  }
}

TEST(Tracks, AreIndependentOrIdenticalWhenAsked) {
  for (const double share : coherenceOf("independent", 0.5, {0.05, 0.1, 0.3})) EXPECT_NEAR(share, 0.0, 0.08);
  std::vector<Road> same = tracksOf(namedVehicle("sedan"), "identical", 3);
  for (double t = 0.0; t < 2.0; t += 0.01) ASSERT_EQ(same[0](t).height, same[1](t).height);
}

TEST(Tracks, RearFollowsFrontLaterByWheelbaseOverSpeed) {
  for (const char* tracks : {"coherent", "identical", "independent"}) {
    const Vehicle vehicle = namedVehicle("ugv");  // as wide at the rear as in front
    std::vector<Road> roads = tracksOf(vehicle, tracks, 5);
    const double delay = (0.34 + 0.28) / 4.0;
    for (double t = 0.0; t < 5.0; t += 0.01) {
      ASSERT_NEAR(roads[2](t).height, roads[0](t - delay).height, 1e-12) << tracks;
      ASSERT_NEAR(roads[3](t).acceleration, roads[1](t - delay).acceleration, 1e-9) << tracks;
    }
  }
}

/// Where the IMU is, in the world, at one sample.
Vector3d placeOf(const VehicleTruth& truth, const VehicleImu& imu) {
  return Vector3d(0.0, 0.0, truth.body[0]) + Eigen::AngleAxisd(truth.body[1], Vector3d::UnitY()) *
                                                 (Eigen::AngleAxisd(truth.body[2], Vector3d::UnitX()) * imu.position());
}

TEST(BodyImu, ReadsTheAccelerationOfItsPlaceAndGravityInItsOwnAxes) {
  Vehicle vehicle = namedVehicle("ugv");
  vehicle.iso_class = "A";  // angles small enough for their squares not to matter
  vehicle.body_imu = {0.3, -0.2, 0.25, 0.4, -0.3, 1.1};
  const Matrix3d turn = (Eigen::AngleAxisd(1.1, Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.3, Vector3d::UnitY()) *
                         Eigen::AngleAxisd(0.4, Vector3d::UnitX()))
                            .toRotationMatrix();
  VehicleDriveOptions options = vehicleDrive(5.0, 1000.0);
  options.noise = options.gyro_noise = 0.0;
  const std::vector<VehicleInstant> samples = driveVehicle(vehicle, options);
  double largest = 0.0, largest_rate = 0.0;
  for (std::size_t k = 1; k + 1 < samples.size(); ++k) {
    const Vector3d before = placeOf(samples[k - 1].truth, vehicle.body_imu);
    const Vector3d here = placeOf(samples[k].truth, vehicle.body_imu);
    const Vector3d after = placeOf(samples[k + 1].truth, vehicle.body_imu);
    const Vector3d second = (after - 2.0 * here + before) * 1e6;
    const VehicleTruth& truth = samples[k].truth;
    const Matrix3d body =
        (Eigen::AngleAxisd(truth.body[1], Vector3d::UnitY()) * Eigen::AngleAxisd(truth.body[2], Vector3d::UnitX()))
            .toRotationMatrix();
    const Vector3d expected = turn.transpose() * (body.transpose() * (second + Vector3d(0.0, 0.0, 9.81)));
    ASSERT_LT((samples[k].body->acceleration - expected).norm(), 0.005) << k;
    const Vector3d rate(truth.body_rate[2], truth.body_rate[1], 0.0);
    ASSERT_LT((turn * samples[k].body->angular_rate - rate).norm(), 1e-9);
    largest = std::max(largest, second.norm());
    largest_rate = std::max(largest_rate, rate.norm());
  }
  EXPECT_GT(largest, 0.5);
  EXPECT_GT(largest_rate, 0.02);
}

TEST(BodyImu, TellsTheAccelerationOfEveryStrutTop) {
  Vehicle vehicle = namedVehicle("sedan");
  vehicle.iso_class = "A";
  for (const VehicleInstant& sample : driveVehicle(vehicle, vehicleDrive(5.0))) {
    const SixAxisReading reading = readIdeally(sample.truth, vehicle.body_imu, 0.0);
    const Vector3d alpha(sample.truth.body_acceleration[2], sample.truth.body_acceleration[1], 0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      const VehicleStrut& strut = vehicle.struts[i];
      const Vector3d arm = Vector3d(strut.x, strut.y, strut.z) - vehicle.body_imu.position();
      const Vector3d rate = reading.angular_rate;
      const double top = (reading.acceleration + alpha.cross(arm) + rate.cross(rate.cross(arm))).z();
      ASSERT_NEAR(top, sample.truth.struts[i].sprung_acceleration, 0.001);
    }
  }
}

TEST(VehicleSimulator, SensorsHaveTheirNoiseOffsetsAndLosses) {
  Vehicle vehicle = namedVehicle("sedan");
  vehicle.struts[1].sprung_offset = 0.4;
  vehicle.struts[2].unsprung_offset = -0.3;
  vehicle.body_imu.offset_x = 0.2;
  vehicle.body_imu.gyro_offset_y = 0.01;
  vehicle.known_forces = {{"tow_bar", -2.0, 0.0, 500.0, 0.5, 3.0, 7.0}};
  VehicleDriveOptions options = vehicleDrive(60.0);
  options.dropout = 0.1;
  std::vector<double> sprung[4], unsprung[4], force, known, x, y, z, gyro;
  std::size_t lost = 0, samples = 0;
  for (const VehicleInstant& sample : driveVehicle(vehicle, options)) {
    ++samples;
    for (std::size_t i = 0; i < 4; ++i) {
      const DriveTruth& truth = sample.truth.struts[i];
      if (!sample.struts[i].sprung) ++lost;
      if (sample.struts[i].sprung)
        sprung[i].push_back(sample.struts[i].sprung->acceleration - truth.sprung_acceleration);
      if (sample.struts[i].unsprung)
        unsprung[i].push_back(sample.struts[i].unsprung->acceleration - truth.unsprung_acceleration);
    }
    force.push_back(sample.known_forces[0] - sample.truth.known_forces[0]);
    known.push_back(sample.truth.known_forces[0]);
    if (!sample.body) continue;
    const SixAxisReading ideal = readIdeally(sample.truth, vehicle.body_imu, 9.81);
    x.push_back(sample.body->acceleration.x() - ideal.acceleration.x());
    y.push_back(sample.body->acceleration.y() - ideal.acceleration.y());
    z.push_back(sample.body->acceleration.z() - ideal.acceleration.z());
    gyro.push_back(sample.body->angular_rate.y() - ideal.angular_rate.y());
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(standardDeviationOf(sprung[i]), 0.03, 0.0015);
    EXPECT_NEAR(standardDeviationOf(unsprung[i]), 0.03, 0.0015);
    EXPECT_NEAR(meanOf(sprung[i]), i == 1 ? 0.4 : 0.0, 0.002);
    EXPECT_NEAR(meanOf(unsprung[i]), i == 2 ? -0.3 : 0.0, 0.002);
  }
  EXPECT_NEAR(static_cast<double>(lost) / static_cast<double>(4 * samples), 0.1, 0.01);
  for (const std::vector<double>* noise : {&x, &y, &z}) EXPECT_NEAR(standardDeviationOf(*noise), 0.03, 0.0015);
  EXPECT_NEAR(meanOf(x), 0.2, 0.002);
  EXPECT_NEAR(meanOf(z), 0.0, 0.002);
  EXPECT_NEAR(standardDeviationOf(gyro), 0.002, 1e-4);
  EXPECT_NEAR(meanOf(gyro), 0.01, 1e-4);
  EXPECT_NEAR(standardDeviationOf(force), 7.0, 0.4);
  EXPECT_NEAR(standardDeviationOf(known), 500.0, 50.0);
}

TEST(VehicleSimulator, NoTwoSensorsShareTheirNoise) {
  std::vector<std::vector<double>> noises(10);
  for (const VehicleInstant& sample : driveVehicle(namedVehicle("sedan"), vehicleDrive(60.0))) {
    const SixAxisReading ideal = readIdeally(sample.truth, namedVehicle("sedan").body_imu, 9.81);
    for (std::size_t i = 0; i < 4; ++i) {
      noises[i].push_back(sample.struts[i].sprung->acceleration - sample.truth.struts[i].sprung_acceleration);
      noises[4 + i].push_back(sample.struts[i].unsprung->acceleration - sample.truth.struts[i].unsprung_acceleration);
    }
    noises[8].push_back(sample.body->acceleration.z() - ideal.acceleration.z());
    noises[9].push_back(sample.body->acceleration.x() - ideal.acceleration.x());
  }
  for (std::size_t a = 0; a < noises.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_NEAR(cosineOf(noises[a], noises[b]), 0.0, 0.06) << a << ' ' << b;
}

TEST(VehicleSimulator, SameOptionsGiveTheSameDriveAnotherSeedAnother) {
  const auto last = [](int seed) {
    VehicleDriveOptions options = vehicleDrive(2.0);
    options.seed = seed;
    return driveVehicle(namedVehicle("truck"), options).back().struts[3].unsprung->acceleration;
  };
  EXPECT_EQ(last(4), last(4));
  EXPECT_NE(last(4), last(5));
}

TEST(Vehicle, IsRefusedByNameAndValue) {
  const auto complaint = [](auto change) -> std::string {
    Vehicle vehicle = namedVehicle("sedan");
    change(vehicle);
    try {
      validate(vehicle);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const auto expectWords = [](const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << "got: " << message;
  };
  expectWords(complaint([](Vehicle& v) { v.mass = 0.0; }), "mass = 0 [kg]");
  expectWords(complaint([](Vehicle& v) { v.roll_inertia = 0.0; }), "roll_inertia = 0 [kg m^2], must be above 0");
  expectWords(complaint([](Vehicle& v) { v.struts.clear(); }), "no strut");
  expectWords(complaint([](Vehicle& v) { v.struts.resize(2); }), "do not hold the body");
  expectWords(complaint([](Vehicle& v) { v.struts = {v.struts[0], v.struts[3]}; }), "do not hold the body");
  expectWords(complaint([](Vehicle& v) { v.struts[2].stiffness = -1.0; }), "struts/rear_left: stiffness = -1");
  expectWords(complaint([](Vehicle& v) { v.struts[1].ramp_start = 5.0; }), "struts/front_right: ramp_end = 0");
  expectWords(complaint([](Vehicle& v) { v.anti_roll_bars = {{1, 1, 100.0}}; }), "anti_roll_bars/front_right");
  expectWords(complaint([](Vehicle& v) { v.known_forces = {{"bar", 0, 0, 1.0, 5.0, 4.0}}; }), "bar: highest_frequency");
  Vehicle half = namedVehicle("half_sedan");
  half.known_forces = {{"bar", 1.0, 0.5, 1.0}};
  EXPECT_THROW(validate(half), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
