#include "suspension_health_monitor/discrepancy/noise_floor.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "median.h"

namespace suspension_health_monitor {
namespace {

constexpr Eigen::Index kReach = 16;  // samples to either side
constexpr Eigen::Index kTerms = 4 * kReach + 1;
constexpr Eigen::Index kMostRows = 20000;  // of long drives every so many
constexpr double kOutlier = 4.0;           // standard deviations
constexpr int kReweightings = 3;

/// What the interpolation of one z'' may use: its neighbours, the wheel's motion during the steps around it (which
/// stands for w''), and a constant. One row per sample.
struct Rows {
  Eigen::MatrixXd neighbours;
  Eigen::VectorXd measured;
};

Rows collectRows(const std::vector<const DriveRecord*>& records) {
  Eigen::Index count = 0;
  for (const DriveRecord* record : records)
    for (const DriveSegment& segment : record->segments())
      count += std::max<Eigen::Index>(0, static_cast<Eigen::Index>(segment.size()) - 2 * kReach);
  const Eigen::Index stride = 1 + count / kMostRows;
  Rows rows;
  rows.neighbours.resize((count + stride - 1) / stride, kTerms);
  rows.measured.resize(rows.neighbours.rows());
  Eigen::Index index = 0;
  for (const DriveRecord* record : records)
    for (const DriveSegment& segment : record->segments())
      for (Eigen::Index k = kReach; k + kReach < static_cast<Eigen::Index>(segment.size()); ++k, ++index) {
        if (index % stride != 0) continue;
        auto row = rows.neighbours.row(index / stride);
        for (Eigen::Index i = 0; i < kReach; ++i) {
          row[i] = segment.sprung[static_cast<std::size_t>(k - 1 - i)];
          row[kReach + i] = segment.sprung[static_cast<std::size_t>(k + 1 + i)];
        }
        for (Eigen::Index i = 0; i < 2 * kReach; ++i) {
          const auto step = static_cast<std::size_t>((k - kReach + i) * record->steps());
          row[2 * kReach + i] = segment.wheel[step].end_velocity / record->period();
        }
        row[kTerms - 1] = 1.0;
        rows.measured[index / stride] = segment.sprung[static_cast<std::size_t>(k)];
      }
  return rows;
}

/// What the interpolation cannot tell, as a standard deviation.
double innovation(const Rows& rows) {
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(rows.measured.size());
  double deviation = 0.0;
  for (int pass = 0; pass <= kReweightings; ++pass) {
    const Eigen::MatrixXd weighted = weight.asDiagonal() * rows.neighbours;
    Eigen::MatrixXd gram = rows.neighbours.transpose() * weighted;
    gram.diagonal() *= 1.0 + 1e-12;
    const Eigen::VectorXd solution = gram.ldlt().solve(weighted.transpose() * rows.measured);
    const Eigen::VectorXd error = (rows.measured - rows.neighbours * solution).cwiseAbs();
    deviation = median({error.data(), error.data() + error.size()}) * kSigmaPerMedian;
    if (deviation == 0.0) return 0.0;
    weight = error.unaryExpr([&](double e) { return 1.0 / (1.0 + std::pow(e / (kOutlier * deviation), 4)); });
  }
  const auto count = static_cast<double>(rows.measured.size());
  return deviation * std::sqrt(count / (count - static_cast<double>(kTerms)));
}

}  // namespace

double estimateNoiseFloor(const std::vector<const DriveRecord*>& records, const StrutModel& model) {
  const Rows rows = collectRows(records);
  if (rows.measured.size() <= 2 * kTerms) return 0.0;
  const double b1 = model.damping_to_mass;
  const double b0 = model.stiffness_to_mass;
  // White noise on w'' through G(s) = (b1 s + b0) / (s^2 + b1 s + b0): its variance grows by T (b1^2 + b0) / (2 b1).
  const double through = records.front()->period() * (b1 * b1 + b0) / (2.0 * b1);
  return innovation(rows) * std::sqrt(1.0 + through);
}

}  // namespace suspension_health_monitor
