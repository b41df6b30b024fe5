#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {

/// What a vehicle file says that the data contradict.
struct VehicleMistake {
  enum class Kind {
    kNone,           ///< the data fit the file
    kTooLittle,      ///< of data
    kSameWheels,     ///< the topics of two wheels carry the same data
    kSameTops,       ///< those of two strut tops
    kAlike,          ///< two wheels move alike: no mistake, but the road cannot tell the struts apart
    kSwapped,        ///< the wheels of two struts, or their tops
    kUpsideDown,     ///< the axis of a wheel's sensor
    kMirroredAhead,  ///< all positions, x for -x
    kMirroredSides,  ///< y for -y
    kSignAhead,      ///< x of one position
    kSignSide,       ///< y of one position
    kOthers,         ///< no such mistake explains how the tops move
  };
  Kind kind = Kind::kNone;
  StrutPair struts{};        ///< that it is about; of one strut twice the same
  double unexplained = 0.0;  ///< share of the tops' motion that the file as it stands leaves [-]
};

/// Sums over blocks and bins of the products of all wheels' and tops' motions, by which every mapping of topics and
/// positions is judged at once: for each, the rows (B20) are fitted by least squares, and what they leave is compared.
/// Noise in the columns draws all mappings alike.
class VehicleClaims {
 public:
  using Spectra = std::array<Eigen::ArrayXXcd, 3>;  ///< H_p of p = 0, 1, 2, bins by struts

  explicit VehicleClaims(std::size_t struts);

  /// Adds one block.
  /// @param wheels, tops  of w'' and z''.  @param s  of the bins.
  void add(const Spectra& wheels, const Spectra& tops, const Eigen::ArrayXcd& s);

  /// @param places  of struts whose tops the body's IMU tells; empty: tops have sensors of their own.
  VehicleMistake find(const StrutPlaces& places) const;

 private:
  /// Streams of all struts as the file would have them, from those that were measured.
  struct Mapping {
    Eigen::MatrixXd wheels, tops;
  };
  Mapping asFiled() const;
  double unexplained(const Mapping& mapping) const;
  VehicleMistake sameOrAlike(bool has_own_tops) const;

  Eigen::Index n_;
  Eigen::MatrixXd moments_;  // by p, then wheels, then tops
  Eigen::MatrixXd whole_;    // of H_0 of wheels and tops, unweighted
  int blocks_ = 0;
};

}  // namespace suspension_health_monitor
