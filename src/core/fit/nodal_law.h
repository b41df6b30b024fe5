#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

inline constexpr int kFirstNodes = 8;  // per side: half an rms apart, as the extremes of a drive are some four

/// A piecewise linear function of one variable that is 0 at 0, and goes on straight beyond its ends.
struct NodalLaw {
  std::vector<double> nodes, values;

  /// @return a law with even nodes on either side of 0, up to `most`.
  template <class Law>
  static NodalLaw sampled(double most, const Law& law) {
    NodalLaw sampled;
    for (int i = -kFirstNodes; i <= kFirstNodes; ++i) {
      sampled.nodes.push_back(most * i / kFirstNodes);
      sampled.values.push_back(i == 0 ? 0.0 : law(sampled.nodes.back()));
    }
    return sampled;
  }

  /// @return the node at 0.
  std::size_t zero() const {
    return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), 0.0) - nodes.begin());
  }

  /// Calls take(node, weight) for the two nodes that decide f(x).
  template <class Take>
  void forNodesAt(double x, const Take& take) const {
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    const auto i = static_cast<std::size_t>(above - nodes.begin());
    const double share = (x - nodes[i - 1]) / (nodes[i] - nodes[i - 1]);
    take(i - 1, 1.0 - share);
    take(i, share);
  }

  double at(double x) const {
    double sum = 0.0;
    forNodesAt(x, [&](std::size_t i, double weight) { sum += weight * values[i]; });
    return sum;
  }

  /// Weights of three neighbours' values in the change of slope at the middle one.
  Eigen::Vector3d bendWeights(std::size_t i) const {
    const double before = 1.0 / (nodes[i] - nodes[i - 1]), after = 1.0 / (nodes[i + 1] - nodes[i]);
    return {before, -before - after, after};
  }

  double bend(std::size_t i) const {
    const Eigen::Vector3d weights = bendWeights(i);
    return weights[0] * values[i - 1] + weights[1] * values[i] + weights[2] * values[i + 1];
  }

  /// The same function with more nodes: in the middle of cells that have an end where splits(node).
  template <class Splits>
  NodalLaw refined(const Splits& splits) const {
    NodalLaw finer;
    const auto add = [&](double x, double value) {
      finer.nodes.push_back(x);
      finer.values.push_back(value);
    };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (i > 0 && (splits(i - 1) || splits(i)))
        add(0.5 * (nodes[i - 1] + nodes[i]), 0.5 * (values[i - 1] + values[i]));
      add(nodes[i], values[i]);
    }
    return finer;
  }
};

}  // namespace suspension_health_monitor
