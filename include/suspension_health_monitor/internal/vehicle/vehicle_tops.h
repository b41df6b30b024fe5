#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace suspension_health_monitor {

/// What is measured of a body on N struts.
struct VehicleTops {
  struct Top {
    bool has_own = true;  ///< an accelerometer of its own; else the body's IMU tells what it does, by its position
    std::optional<Eigen::Vector3d> position;  ///< from the body's IMU, x ahead, y to the left, z up [m]
  };

  std::vector<Top> tops;           ///< by strut, two or more
  std::size_t known_forces = 0;    ///< that are measured
  bool looks_for_friction = true;  ///< of every strut; else it has no such column

  std::size_t size() const { return tops.size(); }
  /// @return x, y by strut; empty unless every strut has a position.
  std::vector<std::array<double, 2>> places() const {
    std::vector<std::array<double, 2>> result;
    for (const Top& top : tops)
      if (top.position) result.push_back({top.position->x(), top.position->y()});
    if (result.size() < tops.size()) result.clear();
    return result;
  }
  bool needsBody() const {
    for (const Top& top : tops)
      if (!top.has_own) return true;
    return false;
  }
};

}  // namespace suspension_health_monitor
