// Against reference/make_block_reference.py, which is written from the printed equations in NumPy alone.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "block_drive.h"
#include "csv.h"
#include "suspension_health_monitor/internal/blocks/sliding_friction.h"

namespace suspension_health_monitor {
namespace {

enum Kind { kWheel, kForce, kBody, kInformation = 5, kScore, kMoments, kPowers, kTheta, kCovariance, kNoise, kRest };
enum MedianKind { kMedian = 13, kThetaMedian, kCovarianceMedian, kRestMedian };
constexpr int kSummed = 3;           // block whose bands are stored
constexpr double kTolerance = 1e-9;  // relative; what it is relative to is said where it stands

using Values = std::vector<double>;

// By drive, kind and index.
std::map<std::tuple<int, int, int>, Values> referenceValues() {
  std::map<std::tuple<int, int, int>, Values> result;
  for (const Values& line : readCsv("block_reference.csv"))
    result[{static_cast<int>(line[0]), static_cast<int>(line[1]), static_cast<int>(line[2])}] =
        Values(line.begin() + 3, line.end());
  return result;
}

struct Stream {
  Values values, times;
};

Stream streamOf(const std::vector<Values>& readings, int drive, int wheel, double period_us) {
  Stream stream;
  for (const Values& line : readings) {
    if (line[0] != drive) continue;
    long stamp = 0;
    for (auto each = line.begin() + 2; each != line.end(); ++each) {
      if (line[1] == wheel) stream.values.push_back(1e-3 * *each);
      if (line[1] == wheel + 2) stream.times.push_back(1e-6 * static_cast<double>(stamp += static_cast<long>(*each)));
    }
  }
  for (std::size_t i = 0; stream.times.size() < stream.values.size(); ++i)
    stream.times.push_back(1e-6 * (period_us * static_cast<double>(i)));
  return stream;
}

// One drive of the reference, brought as far as its linearised blocks.
class ReferenceDrive {
 public:
  explicit ReferenceDrive(const Values& settings, const std::vector<Values>& readings)
      : number(static_cast<int>(settings[0])),
        equations(BlockBand(settings[1], settings[2]), BlockColumns{}),
        theta(Eigen::Map<const Eigen::VectorXd>(settings.data() + 5, 6)) {
    const BlockBand& band = equations.band();
    const Stream body = streamOf(readings, number, 0, settings[3]), wheel = streamOf(readings, number, 1, settings[4]);
    SlidingFriction friction(band.length / 4096.0, 2.0 * band.length);
    friction.setStrut(theta[0], theta[1], theta[kNumBlockParameters]);
    FourierIntegrals wheels(band, 2), bodies(band, 1);
    FourierIntegrals::Phases phases(band);
    std::size_t next = 0;
    for (std::size_t i = 0; i < wheel.values.size(); ++i) {
      const double values[] = {wheel.values[i], friction.push(wheel.times[i], wheel.values[i])};
      wheels.push(wheel.times[i], values, phases);
      for (; next < body.values.size() && body.times[next] <= wheel.times[i]; ++next)
        bodies.push(body.times[next], &body.values[next], phases);
      take(wheels, bodies);
    }
    for (; next < body.values.size(); ++next) bodies.push(body.times[next], &body.values[next], phases);
    take(wheels, bodies);
  }

  std::vector<const StrutBlock*> newest(int count) const {
    std::vector<const StrutBlock*> result;
    for (std::size_t b = blocks.size() - static_cast<std::size_t>(count); b < blocks.size(); ++b)
      result.push_back(&blocks[b]);
    return result;
  }

  int number;
  StrutEquations equations;
  BlockVector theta;
  std::vector<StrutBlock> blocks;

 private:
  void take(const FourierIntegrals& wheels, const FourierIntegrals& bodies) {
    for (auto half = static_cast<long>(blocks.size()) + 1; wheels.openHalf() > half && bodies.openHalf() > half;
         ++half) {
      const BlockBand& band = equations.band();
      blocks.push_back(equations.makeBlock());
      StrutBlock& block = blocks.back();
      block.end = 0.5 * band.length * static_cast<double>(half + 1);
      fillBlock(equations, wholeBlock(band, wheels, half), wholeBlock(band, bodies, half), block);
      block.forces.col(0) = wholeBlock(band, wheels, half, 1);
      equations.linearise(theta, block);
    }
  }
};

// R'R with the residual at theta as the last column; a band has that of b1 = b0 = 0 there, without columns.
Eigen::MatrixXd momentsAt(const StrutBlock::Band& band, const BlockVector& theta) {
  Eigen::MatrixXd change = Eigen::MatrixXd::Identity(7, 7);
  change.col(6).head(6) = -theta;
  change(kBlockWheelShare, 6) = 0.0;
  return change.transpose() * band.moments * change;
}

class BlockReference : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    values_ = referenceValues();
    const std::vector<Values> readings = readCsv("block_readings.csv");
    for (const Values& settings : readCsv("block_drives.csv")) drives_.emplace_back(settings, readings);
  }

  static const Values& expected(const ReferenceDrive& drive, int kind, int index) {
    return values_.at({drive.number, kind, index});
  }

  static Values counts(const ReferenceDrive& drive) { return {3.0, 8.0, static_cast<double>(drive.blocks.size())}; }

  static void expectSpectrum(const ReferenceDrive& drive, int kind, int block, const Eigen::ArrayXcd& found) {
    const Values& both = expected(drive, kind, block);
    const auto n = static_cast<Eigen::Index>(both.size()) / 2;
    ASSERT_EQ(found.size(), n);
    Eigen::ArrayXcd known(n);
    known.real() = Eigen::Map<const Eigen::ArrayXd>(both.data(), n);
    known.imag() = Eigen::Map<const Eigen::ArrayXd>(both.data() + n, n);
    EXPECT_LT((found - known).abs().maxCoeff(), kTolerance * known.abs().maxCoeff())
        << "drive " << drive.number << ", kind " << kind << ", block " << block;
  }

  // Relative to the product of its row's and its column's size.
  static void expectMatrix(const ReferenceDrive& drive, int kind, int index, const Eigen::MatrixXd& found,
                           const Eigen::VectorXd& rows, const Eigen::VectorXd& columns) {
    const Values& known = expected(drive, kind, index);
    ASSERT_EQ(static_cast<Eigen::Index>(known.size()), found.size());
    for (Eigen::Index i = 0; i < found.rows(); ++i)
      for (Eigen::Index j = 0; j < found.cols(); ++j)
        EXPECT_NEAR(found(i, j), known[static_cast<std::size_t>(i * found.cols() + j)],
                    kTolerance * rows[i] * columns[j])
            << "drive " << drive.number << ", kind " << kind << ", index " << index << ", at " << i << ", " << j;
  }

  static void expectEstimate(const ReferenceDrive& drive, const WindowEstimate& found, int theta, int covariance,
                             int rest) {
    const int m = found.blocks;
    const Eigen::VectorXd stddev = found.covariance.diagonal().cwiseSqrt();
    const Values &known = expected(drive, theta, m), &others = expected(drive, rest, m);
    for (Eigen::Index i = 0; i < 6; ++i) {
      const double value = known[static_cast<std::size_t>(i)];
      EXPECT_NEAR(found.theta[i], value, kTolerance * (std::abs(value) + stddev[i]))
          << "drive " << drive.number << ", " << m << " blocks, parameter " << i;
    }
    expectMatrix(drive, covariance, m, found.covariance, stddev, stddev);
    const double rests[] = {found.explained, found.inflation, found.rate, found.age};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(rests[i], others[i], kTolerance * others[i]) << "drive " << drive.number << ", " << m << ", " << i;
  }

  static WindowEstimate fit(const ReferenceDrive& drive, int count, const Eigen::VectorXd& median = {}) {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    const BlockPrior prior{blockTheta(0.0, 0.0), blockTheta(kUnknown, kUnknown, 0.005, 0.29, 0.3, 0.1)};
    WindowFit window_fit(drive.equations.band(), drive.equations.columns(), 64);
    WindowEstimate result;
    window_fit.fit(drive.newest(count), prior, drive.theta, median, 0.0, result);
    return result;
  }

  inline static std::vector<ReferenceDrive> drives_;
  inline static std::map<std::tuple<int, int, int>, Values> values_;
};

TEST_F(BlockReference, HasTheSameSpectraOfAnyStamps) {
  ASSERT_EQ(drives_.size(), 10u);
  for (const ReferenceDrive& drive : drives_)
    for (const int b : {1, 4}) {
      const StrutBlock& block = drive.blocks[static_cast<std::size_t>(b)];
      expectSpectrum(drive, kWheel, b, block.wheel);
      expectSpectrum(drive, kForce, b, block.forces.col(0));
      for (int p = 0; p < 3; ++p) expectSpectrum(drive, kBody + p, b, block.body.col(p));
    }
}

TEST_F(BlockReference, HasTheSameSumsOfEveryBand) {
  for (const ReferenceDrive& drive : drives_)
    for (int i = 0; i < drive.equations.noiseBands().count(); ++i) {
      const StrutBlock::Band& band = drive.blocks[kSummed].bands[static_cast<std::size_t>(i)];
      const Eigen::VectorXd sizes = momentsAt(band, drive.theta).diagonal().cwiseSqrt();
      // An instrument is as large as its regressor or somewhat larger, by noise.
      const Eigen::VectorXd regressors = sizes.head(6), residual = sizes.tail(1);
      expectMatrix(drive, kInformation, i, band.information, regressors, regressors);
      expectMatrix(drive, kScore, i, scoreOf(band, drive.theta, 1.0), regressors, residual);
      expectMatrix(drive, kMoments, i, momentsAt(band, drive.theta), sizes, sizes);
      const Eigen::Vector3d powers(band.powers[StrutBlock::Band::kWheel], band.powers[StrutBlock::Band::kBody],
                                   band.powers[StrutBlock::Band::kRate]);
      expectMatrix(drive, kPowers, i, powers, powers, Eigen::VectorXd::Ones(1));
    }
}

TEST_F(BlockReference, HasTheSameEstimateOfFewAndOfAllBlocks) {
  for (const ReferenceDrive& drive : drives_)
    for (const double count : counts(drive)) {
      const WindowEstimate found = fit(drive, static_cast<int>(count));
      expectEstimate(drive, found, kTheta, kCovariance, kRest);
      expectMatrix(drive, kNoise, found.blocks, found.noise, found.noise, Eigen::VectorXd::Ones(1));
    }
}

TEST_F(BlockReference, CountsUnusualBlocksForTheSameLess) {
  for (const ReferenceDrive& drive : drives_) {
    const int count = static_cast<int>(drive.blocks.size());
    const Values& median = expected(drive, kMedian, count);
    const Eigen::Map<const Eigen::VectorXd> powers(median.data(), static_cast<Eigen::Index>(median.size()));
    expectEstimate(drive, fit(drive, count, powers), kThetaMedian, kCovarianceMedian, kRestMedian);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
