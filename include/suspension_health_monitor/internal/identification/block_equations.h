#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace suspension_health_monitor {

/// Sums over a block of successive rows of psi = phi' theta + c + e with instruments z: theta and the constant c solve
/// sum (z, 1) (psi - phi' theta - c) = 0.
struct EquationBlock {
  using Rates = Eigen::Matrix<double, 3, 2>;

  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< sum of (z, 1) (phi, 1)'
  Eigen::Vector3d outputs = Eigen::Vector3d::Zero();      ///< sum of (z, 1) psi
  Rates rates = Rates::Zero();                            ///< sum of (z, 1) phi_t'
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();  ///< sum of the squares of (z, 1): the third is the number of rows

  /// @param rate  phi_t: by how much phi differs per second that it is taken late.
  void add(const Eigen::Vector2d& instrument, const Eigen::Vector2d& regressor, double output,
           const Eigen::Vector2d& rate = Eigen::Vector2d::Zero());
  EquationBlock& operator+=(const EquationBlock& other);
  EquationBlock scaled(double factor) const {
    return {factor * information, factor * outputs, factor * rates, factor * squares};
  }
  /// @return (theta, c); none if the rows do not determine it.
  std::optional<Eigen::Vector3d> solution() const;
  double rows() const { return squares[2]; }
};

/// The solution of a series of blocks.
struct BlockSolution {
  Eigen::Vector2d theta;   ///< (b1 [1/s], b0 [1/s^2])
  Eigen::Vector2d stddev;  ///< likewise
  double rows;             ///< that count: of blocks that stand out only a part
  Eigen::Vector2d rate;    ///< by how much theta differs per second that phi is taken late

  /// @param error  of theta, either way, that the scatter of the rows does not show.
  void addError(const Eigen::Vector2d& error) { stddev = (stddev.cwiseAbs2() + error.cwiseAbs2()).cwiseSqrt(); }
};

/// Equations of the instrumental-variable method over a whole drive, in blocks of equal length, so that at its end it
/// shows how much the blocks contradict each other. Blocks are joined by twos when there are too many: memory does not
/// grow with the drive.
/// - The variance of theta is that of the blocks' scores s_b = sum (z, 1) e, neighbours included, as each reading of a
///   sensor is in many rows: the sandwich R^-1 G R^-T with G from sums over overlapping runs of blocks (Newey and West,
///   Econometrica 55 (1987)). No assumption on noise or road enters.
/// - Blocks of which the scores are far larger than most, lost data or an end stop, count as much less.
class BlockEquations {
 public:
  /// @param rows_per_block  at first, >= 1: at least as many as are correlated.
  explicit BlockEquations(int rows_per_block) : rows_per_block_(rows_per_block) {}

  /// As EquationBlock::add().
  void add(const Eigen::Vector2d& instrument, const Eigen::Vector2d& regressor, double output,
           const Eigen::Vector2d& rate = Eigen::Vector2d::Zero());

  /// @param noise  what of the moments of a row is noise's, and is taken off.
  /// @return none with fewer than kFewestBlocks complete blocks, or if they do not determine theta.
  std::optional<BlockSolution> solution(const EquationBlock& noise) const;

  static constexpr std::size_t kFewestBlocks = 8;

 private:
  void halve();

  int rows_per_block_;
  EquationBlock open_;
  std::vector<EquationBlock> blocks_;
};

}  // namespace suspension_health_monitor
