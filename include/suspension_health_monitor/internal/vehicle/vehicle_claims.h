#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

namespace suspension_health_monitor {

/// What a vehicle file says that the data contradict.
struct VehicleMistake {
  enum class Kind {
    kNone,        ///< the data fit the file
    kTooLittle,   ///< of data
    kSameWheels,  ///< the topics of two wheels carry the same data
    kSameTops,    ///< those of two strut tops
    kAlike,       ///< two wheels move alike: no mistake, but the road cannot tell the struts apart
    kSwapped,     ///< the wheels of two struts, or their tops
    kUpsideDown,  ///< the axis of a wheel's sensor
    kAhead,       ///< x of all positions
    kSide,        ///< y of all positions
    kAheadOfOne,  ///< x of one position
    kSideOfOne,   ///< y of one position
    kShiftAhead,  ///< x of the body's IMU
    kShiftSide,   ///< y of the body's IMU
    kWheelDelay,  ///< the stamps of a wheel's sensor
    kTopDelay,    ///< those of the sensor at a strut top
    kTopsDelay,   ///< those of all sensors at strut tops; of all wheels' the other way
    kBodyDelay,   ///< those of the body's IMU
    kDeadGyro,    ///< of the body's IMU, in pitch or roll: it turns less than any body on struts
    kOthers,      ///< no such mistake explains how the tops move
  };
  Kind kind = Kind::kNone;
  StrutPair struts{};        ///< that it is about; of one strut twice the same
  double size = 0.0;         ///< what times the file's positions, what added to them [m], by how much late [s]
  double stddev = 0.0;       ///< of size
  double unexplained = 0.0;  ///< share of the tops' motion that the file as it stands leaves [-]

  bool isDelay() const {
    return kind == Kind::kWheelDelay || kind == Kind::kTopDelay || kind == Kind::kTopsDelay || kind == Kind::kBodyDelay;
  }

  /// @return true: what is estimated of any strut with this file is wrong. A delay is among what is estimated, and what
  /// no mistake explains is an error of the model (fitRigidBody).
  bool isContradiction() const {
    const bool is_mistake =
        kind != Kind::kNone && kind != Kind::kTooLittle && kind != Kind::kAlike && kind != Kind::kOthers;
    return is_mistake && !isDelay();  // which the estimate finds
  }
};

/// Products of all wheels' and tops' spectra, summed over blocks, by which every mistake is judged: for each, the rows
/// (B20) are fitted by least squares to what the sensors would have read without it, and what they leave is compared.
/// Noise in the columns draws all of them alike. Blocks first, then work() until it is done.
class VehicleClaims {
 public:
  /// @param s  of the bins of a block [rad/s].
  /// @param most_blocks  that are added.
  /// @param gyro_died  after them, by VehicleSpectra.
  VehicleClaims(const VehicleChannels& vehicle, const Eigen::ArrayXcd& s, int most_blocks, bool gyro_died);

  /// Adds the next older block.
  /// @param spectra  bins by, for p = 0, 1, 2, H_p of w'' of all struts and of their z''; then H_2 of the known forces.
  void add(const Eigen::ArrayXXcd& spectra);

  /// Does one portion: one bin or one hypothesis, at most 1 ms for four struts.  @return true: all is done.
  bool work();

  /// @pre work() has returned true.
  const VehicleMistake& found() const { return found_; }

  /// @return by strut the relative standard deviation of b1 and b0 that comes of what the rows lack. A delay that
  /// halves the unexplained motion, but is too small to be a clock's (links and rubber turn phases by as much), adds
  /// the change that it makes; kOthers adds the motion that goes with the wheels and stays unexplained.
  const Eigen::ArrayXXd& modelErrors() const { return model_errors_; }

  /// Does all portions.
  const VehicleMistake& find() {
    while (!work()) continue;
    return found_;
  }

 private:
  /// Streams of all wheels, then of all tops, as they would be without a mistake, from those that were measured.
  struct Mapping {
    Eigen::MatrixXd streams;
    Eigen::VectorXd delays;  ///< of these [s]
  };
  /// A mistake of a size that is not known.
  struct Hypothesis {
    VehicleMistake::Kind kind;
    StrutPair struts;
    std::vector<double> sizes;  ///< to begin with; one: there are no others
    std::function<void(double size, Mapping& mapping)> apply;
  };
  /// @return the share of unrelated noise that wheels and known forces, as so many columns, explain by chance in so
  /// many blocks.
  double noiseShare() const { return static_cast<double>(n_ + forces_) / blocks_; }
  bool begins();
  void takeBin(std::size_t bin);
  void judgeAsFiled();
  void judge(const Hypothesis& hypothesis);
  bool hasDeadGyro() const;
  bool isByBody() const { return static_cast<Eigen::Index>(of_body_.size()) == n_; }
  Mapping asFiled() const;
  Eigen::MatrixXd moments(const Eigen::VectorXd& delays) const;
  /// The rows (B20) of the tops by least squares.
  struct Rows {
    double unexplained;   ///< mean over the tops of the share of z'' that they leave
    Eigen::ArrayXXd own;  ///< b1_ii, b0_ii, by strut
    /// Power of the motion that each of these makes of its own column, over that of the top; the columns of other
    /// struts may move the top against it, so that it can be above 1.
    Eigen::ArrayXXd moved;
  };
  Rows fit(const Mapping& mapping, const Eigen::MatrixXd& moments) const;
  Rows fit(const Hypothesis& hypothesis, double size) const;
  VehicleMistake attempt(const Hypothesis& hypothesis) const;
  std::vector<Hypothesis> hypotheses() const;  // delays first
  void addPositions(std::vector<Hypothesis>& all) const;
  VehicleMistake sameOrAlike() const;
  /// @return the mistake that all tops are late.
  VehicleMistake::Kind allTops() const {
    return isByBody() ? VehicleMistake::Kind::kBodyDelay : VehicleMistake::Kind::kTopsDelay;
  }

  Eigen::Index n_, forces_;
  Eigen::ArrayXcd s_;
  std::vector<Eigen::Index> of_body_;  // struts whose tops the body's IMU tells
  StrutPlaces places_;                 // of these tops
  // By bin, in a column per block, newest first: by p the wheels, then the tops; forces; of displacements.
  std::vector<Eigen::MatrixXcd> columns_;
  std::vector<Eigen::MatrixXcd> products_;  // by bin: of columns_, what goes with the wheels
  Eigen::MatrixXd whole_;                   // of H_0 of wheels and tops, all bins
  Eigen::MatrixXd measured_, in_step_;      // sums over bins: of all that was measured, of products_ less late_tops_
  std::vector<Hypothesis> hypotheses_;
  std::size_t next_ = 0;     // bin, then hypothesis
  Rows filed_{1.0, {}, {}};  // of in_step_, by the file
  double noise_ = 0.0;       // share of the tops' motion that does not go with the wheels
  Eigen::ArrayXXd model_errors_;
  double late_tops_ = 0.0;  // delay of all tops that links make [s]
  double least_ = 0.0;      // that a hypothesis leaves
  int blocks_ = 0;
  bool gyro_died_;
  VehicleMistake found_;
};

}  // namespace suspension_health_monitor
