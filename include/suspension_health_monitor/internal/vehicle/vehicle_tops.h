#pragma once

#include <Eigen/Core>
#include <algorithm>
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

  std::vector<Top> tops;         ///< by strut
  std::size_t known_forces = 0;  ///< that are measured
  std::size_t effects = 0;       ///< of a strut alone, whose forces are columns; none: dry friction is, of every strut

  /// @param effects  of the strut.
  static VehicleTops ofOne(std::size_t effects = 0) { return {{Top()}, 0, effects}; }

  std::size_t size() const { return tops.size(); }
  bool looksForFriction() const { return effects == 0; }
  /// @return x, y by strut; empty unless every strut has a position.
  std::vector<std::array<double, 2>> places() const {
    std::vector<std::array<double, 2>> result;
    for (const Top& top : tops)
      if (top.position) result.push_back({top.position->x(), top.position->y()});
    if (result.size() < tops.size()) result.clear();
    return result;
  }
  bool needsBody() const {
    return std::any_of(tops.begin(), tops.end(), [](const Top& top) { return !top.has_own; });
  }
  /// @return true: the body's IMU tells of all.
  bool areOfBody() const {
    return std::none_of(tops.begin(), tops.end(), [](const Top& top) { return top.has_own; });
  }
};

}  // namespace suspension_health_monitor
