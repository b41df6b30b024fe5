// What the block estimates of a vehicle's struts are worth: linear half and full cars and six wheels of
// vehicle_drive.h, with own accelerometers at the tops or one body IMU; and records of others, as CSV.
//   tables vehicle_blocks [seeds]            the linear vehicles
// `seen`: seconds until the worn strut is seen, how many others are, too, and by how much any other moves beyond its
// interval.
//   tables vehicle_blocks FILE.csv ... [-b]  records; -b: by their body IMU
// A record begins with a line "# NAME x y z b1 b0" for every strut, its top's position from the body's IMU [m] and the
// truth; then lines of time [s], the body's acceleration (3) and angular rate (3), and by strut the vertical
// acceleration of the tops, then of the wheels. A strut "wears" at 205 s in such a record (column `seen`), if it is
// that long.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"
#include "tables.h"
#include "vehicle_drive.h"

namespace suspension_health_monitor {
namespace {

constexpr double kInterval = 1.96;  // standard deviations
constexpr double kWarns = 0.15;     // relative change
constexpr double kSettled = 30.0;   // [s] from which healthy windows count
constexpr double kWornAt = 205.0;   // [s] of a record

/// One instant of all sensors.
struct Instant {
  double time;
  Eigen::Vector3d acceleration, rate;
  std::vector<double> tops, wheels;
  double force = 0.0;
};

struct Case {
  std::string name;
  StrutPlaces places;
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<double, 2>> truth;  // b1, b0, with the strut's share of bars
  std::vector<Instant> instants;
  bool by_body = false, has_force = false;
  double change_at = 1e9, change = 0.0;  // of b1 of strut 1
};

struct Told {
  double time;
  std::array<double, 2> value, stddev;
  double friction_damping;
};

struct Run {
  std::vector<std::vector<Told>> told;  // by strut
  std::vector<std::optional<WindowEstimate>> all;
  std::optional<BodyFitResult> body;
  double worst = 0.0, total = 0.0;  // CPU [us]
  long readings = 0;
};

double cpuMicroseconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

Run run(const Case& test) {
  using Sensor = VehicleReading::Sensor;
  const std::size_t n = test.places.size();
  VehicleChannels vehicle = VehicleChannels::ofAccelerometers(n, test.has_force ? 1 : 0);
  for (std::size_t i = 0; i < n; ++i) {
    vehicle.struts[i].position = test.positions[i];
    if (test.by_body) vehicle.struts[i].sprung.reset();
  }
  VehicleBlocks blocks(vehicle, test.instants[1].time - test.instants[0].time);
  Run result;
  result.told.resize(n);
  const auto taken = [&](const VehicleReading& reading, double time) {
    const double before = cpuMicroseconds();
    const TopEstimate* estimate = blocks.push(reading);
    const double cost = cpuMicroseconds() - before;
    result.worst = std::max(result.worst, cost);
    result.total += cost;
    ++result.readings;
    if (estimate == nullptr) return;
    const auto stddev = [&](int i) { return std::sqrt(estimate->covariance(i, i)); };
    result.told[estimate->strut].push_back(
        {time, {estimate->theta[0], estimate->theta[1]}, {stddev(0), stddev(1)}, estimate->frictionDamping()});
  };
  bool has_body = false;
  for (const Instant& now : test.instants) {
    const Stamp stamp = fromSeconds(1.0 + now.time);
    for (std::size_t i = 0; i < n; ++i) {
      if (!test.by_body) taken({Sensor::kSprung, i, stamp, {now.tops[i]}}, now.time);
      taken({Sensor::kUnsprung, i, stamp, {now.wheels[i]}}, now.time);
    }
    if (test.by_body) {
      VehicleReading reading{Sensor::kBody, 0, stamp, {}};
      std::copy_n(now.acceleration.data(), 3, reading.values.begin());
      std::copy_n(now.rate.data(), 3, reading.values.begin() + 3);
      taken(reading, now.time);
    }
    if (test.has_force) taken({Sensor::kForce, 0, stamp, {now.force}}, now.time);
    if (has_body || now.time < std::min(test.change_at - 1.0, test.instants.back().time - 1.0)) continue;
    has_body = true;
    for (std::size_t i = 0; i < n; ++i) result.all.push_back(blocks.overTheDrive(i));
    if (BodyRows rows; blocks.rows(rows)) result.body = fitRigidBody(rows, test.places, blocks.rowsOfHalves());
  }
  return result;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Seconds from the change to a strut's first estimate that is `kWarns` below its healthy ones, proven; -1: never.
double seenAfter(const Run& run, const Case& test, std::size_t strut, double& largest) {
  std::vector<double> healthy;
  for (const Told& each : run.told[strut])
    if (each.time > kSettled && each.time < test.change_at) healthy.push_back(each.value[0]);
  const double base = median(healthy);
  double seen = -1.0;
  largest = 0.0;
  for (const Told& each : run.told[strut]) {
    if (each.time < test.change_at) continue;
    const double change = each.value[0] / base - 1.0, stddev = each.stddev[0] / base;
    largest = std::max(largest, std::max(0.0, std::abs(change) - kInterval * stddev));
    if (seen < 0.0 && change < -kWarns && change + kInterval * stddev < -kWarns / 2.0)
      seen = each.time - test.change_at;
  }
  return seen;
}

void print(const Case& test, const Run& run) {
  const std::size_t n = test.places.size();
  std::array<double, 2> error{}, over{};
  std::array<int, 2> inside{}, inside_absolute{};
  int count = 0, wide = 0;
  std::array<std::vector<double>, 2> absolute;
  for (std::size_t i = 0; i < n; ++i) {
    for (const Told& each : run.told[i]) {
      if (each.time > test.change_at) continue;
      const bool is_valid = each.stddev[0] < kWarns * each.value[0] && each.stddev[1] < kWarns * each.value[1];
      if (!is_valid) {
        ++wide;
        continue;
      }
      ++count;
      Eigen::Array2d variances = Eigen::Array2d(each.stddev[0], each.stddev[1]).square();
      if (run.body) variances += run.body->modelVariances(i, {each.value[0], each.value[1]}, each.friction_damping);
      for (std::size_t p : {0, 1}) {
        const double off = each.value[p] - test.truth[i][p];
        const double stddev = std::sqrt(variances[static_cast<Eigen::Index>(p)]);
        inside[p] += std::abs(off) < kInterval * each.stddev[p] ? 1 : 0;
        inside_absolute[p] += std::abs(off) < kInterval * stddev ? 1 : 0;
        absolute[p].push_back(100.0 * stddev / each.value[p]);
        error[p] += off / test.truth[i][p] * off / test.truth[i][p];
      }
    }
    for (std::size_t p : {0, 1})
      if (run.all[i])
        over[p] = std::max(over[p], std::abs(run.all[i]->theta[static_cast<Eigen::Index>(p)] / test.truth[i][p] - 1.0));
  }
  const auto percent = [&](double value) { return count > 0 ? 100.0 * value / count : std::nan(""); };
  std::printf("%-22s %5d %4d | %5.2f %5.2f | %5.2f %5.2f | %3.0f %3.0f |", test.name.c_str(), count, wide,
              100.0 * over[0], 100.0 * over[1], count > 0 ? 100.0 * std::sqrt(error[0] / count) : std::nan(""),
              count > 0 ? 100.0 * std::sqrt(error[1] / count) : std::nan(""), percent(inside[0]), percent(inside[1]));
  if (run.body)
    std::printf(" %5.2f %zu | %3.0f %3.0f | %4.1f %4.1f |", 100.0 * run.body->phi, run.body->found.size(),
                percent(inside_absolute[0]), percent(inside_absolute[1]), median(absolute[0]), median(absolute[1]));
  else
    std::printf("     - - |   -   - |    -    - |");
  if (test.change_at < test.instants.back().time) {
    double largest = 0.0, others = 0.0;
    const double seen = seenAfter(run, test, 1, largest);
    int falsely = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == 1) continue;
      falsely += seenAfter(run, test, i, largest) >= 0.0 ? 1 : 0;
      others = std::max(others, largest);
    }
    std::printf(" %4.1f %d %4.1f |", seen, falsely, 100.0 * others);
  } else {
    std::printf("    - -    - |");
  }
  std::printf(" %4.2f %5.0f\n", run.total / static_cast<double>(run.readings), run.worst);
  std::fflush(stdout);
}

vehicle_drive::Vehicle sixWheels(unsigned seed) {
  vehicle_drive::Vehicle truck = vehicle_drive::made("truck", seed);
  truck.name = "six";
  const vehicle_drive::Strut left = truck.struts[2], right = truck.struts[3];
  for (vehicle_drive::Strut strut : {left, right}) {
    strut.x += 1.4;
    strut.damping *= 1.1;
    truck.struts.push_back(strut);
  }
  return truck;
}

Case linear(const std::string& kind, unsigned seed, bool by_body, const vehicle_drive::Drive& how, double change) {
  vehicle_drive::Drive drive = how;
  drive.seed = seed;
  const vehicle_drive::Vehicle vehicle = kind == "six" ? sixWheels(seed) : vehicle_drive::made(kind, seed);
  const std::size_t n = vehicle.struts.size();
  if (by_body) drive.imu = vehicle_drive::BodyImu{-0.3 * vehicle.struts[0].x, 0.2 * vehicle.struts[0].y};
  Case test;
  test.name = kind + " " + std::to_string(seed) + (by_body ? " body" : " own");
  test.by_body = by_body;
  test.has_force = drive.pull > 0.0;
  if (change > 0.0) {
    test.change = change;
    test.change_at = 60.0;
    drive.hidden.resize(n);
    const double c = change * vehicle.struts[1].damping;
    drive.hidden[1] = [c](double, double rate, double time) { return time > 60.0 ? -c * rate : 0.0; };
  }
  for (std::size_t i = 0; i < n; ++i) {
    const vehicle_drive::Strut& strut = vehicle.struts[i];
    test.places.push_back({strut.x, strut.y});
    const double x = drive.imu ? drive.imu->x : 0.0, y = drive.imu ? drive.imu->y : 0.0;
    test.positions.emplace_back(strut.x - x, strut.y - y, 0.0);
    const double bar = i < 2 ? drive.anti_roll * (vehicle.mobility(i, i) - vehicle.mobility(i, 1 - i)) : 0.0;
    test.truth.push_back({vehicle.b1(i), vehicle.b0(i) + bar});
  }
  const vehicle_drive::Record record = vehicle_drive::drive(vehicle, drive);
  constexpr double kGravity = 9.81;
  for (std::size_t k = 0; k < record.wheel.front().size(); ++k) {
    Instant now{static_cast<double>(k) / drive.rate, {}, {}, {}, {}};
    for (std::size_t i = 0; i < n; ++i) {
      now.tops.push_back(kGravity + record.body[i][k]);
      now.wheels.push_back(kGravity + record.wheel[i][k]);
    }
    if (by_body) {
      now.acceleration = {0.0, 0.0, kGravity + record.imu[0][k]};
      now.rate = {record.imu[1][k], record.imu[2][k], 0.0};
    }
    if (test.has_force) now.force = record.pull[k];
    test.instants.push_back(std::move(now));
  }
  return test;
}

Case record(const std::string& file, bool by_body) {
  Case test;
  test.name = file.substr(file.find_last_of('/') + 1) + (by_body ? " body" : "");
  test.by_body = by_body;
  test.change_at = kWornAt;
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line)) {
    std::istringstream text(line);
    if (line[0] == '#') {
      std::string hash, name;
      double x, y, z, b1, b0;
      text >> hash >> name >> x >> y >> z >> b1 >> b0;
      test.places.push_back({x, y});
      test.positions.emplace_back(x, y, z);
      test.truth.push_back({b1, b0});
      continue;
    }
    Instant now{};
    text >> now.time;
    for (Eigen::Vector3d* each : {&now.acceleration, &now.rate}) text >> (*each)[0] >> (*each)[1] >> (*each)[2];
    for (std::vector<double>* each : {&now.tops, &now.wheels}) {
      each->resize(test.places.size());
      for (double& value : *each) text >> value;
    }
    test.instants.push_back(std::move(now));
  }
  return test;
}

void printHead() {
  std::printf(
      "                       valid wide | drive: worst | windows: rms |  in 95 | phi bars |abs. in | abs. sd   |"
      " seen others  | us, worst us\n");
}

void linearTables(unsigned seeds) {
  vehicle_drive::Drive drive;
  const auto all = [&](const char* title, const vehicle_drive::Drive& how, double change) {
    std::printf("\n%s\n", title);
    printHead();
    for (const char* kind : {"half", "sedan", "robot", "truck", "six"})
      for (const bool by_body : {false, true})
        for (unsigned seed = 1; seed <= seeds; ++seed) {
          if (by_body && std::string(kind) == "half" && how.tracks == vehicle_drive::Tracks::kIdentical) continue;
          const Case test = linear(kind, seed, by_body, how, change);
          print(test, run(test));
        }
  };
  all("healthy", drive, 0.0);
  all("strut 1 loses 40 % of its damping at 60 s", drive, 0.4);
  vehicle_drive::Drive other = drive;
  other.anti_roll = 15000.0;
  std::printf("\na bar of 15 kN/m in front; a measured pull\n");
  printHead();
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    for (const char* kind : {"sedan", "truck"}) {
      const Case test = linear(kind, seed, false, other, 0.0);
      print(test, run(test));
    }
    vehicle_drive::Drive pulled = drive;
    pulled.pull = 600.0;
    pulled.pull_x = 0.8;
    pulled.pull_y = 0.2;
    const Case test = linear("sedan", seed, false, pulled, 0.0);
    print(test, run(test));
  }
  other = drive;
  other.tracks = vehicle_drive::Tracks::kIdentical;
  all("identical tracks", other, 0.0);
}

int command(const Arguments& arguments) {
  std::vector<std::string> files;
  bool by_body = false;
  unsigned seeds = 3;
  for (const std::string& argument : arguments.words) {
    if (argument == "-b")
      by_body = true;
    else if (argument.find('.') != std::string::npos)
      files.push_back(argument);
    else
      seeds = static_cast<unsigned>(std::atoi(argument.c_str()));
  }
  if (files.empty()) {
    linearTables(seeds);
    return 0;
  }
  printHead();
  for (const std::string& file : files) {
    const Case test = record(file, by_body);
    print(test, run(test));
  }
  return 0;
}

const AddTable kAdded("vehicle_blocks", {"[SEEDS | FILE.csv... [-b]]", command});

}  // namespace
}  // namespace suspension_health_monitor
