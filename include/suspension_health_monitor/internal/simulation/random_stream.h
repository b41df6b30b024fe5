#pragma once

#include <random>

namespace suspension_health_monitor {

/// What a stream of random numbers is for. Every purpose has its own generator, so that changing one setting of a drive
/// (say, its dropouts) leaves the random numbers of all others as they were.
enum class RandomPurpose : unsigned {
  kRoad,
  kSprungNoise,
  kUnsprungNoise,
  kSprungDelivery,
  kUnsprungDelivery,
  kSway,
  kSwayNoise,
  kSprungTiming,
  kUnsprungTiming,
  kRoadNoise,
  kRoadDelivery,
  kRoadLateral,
  kGyroNoise,
  kKnownForce,
  kKnownForceNoise,
};

/// Reproducible random numbers, the same with every standard library: engine and seeding are fixed by the C++ standard,
/// and the distributions, which it leaves open, are written out here.
class RandomStream {
 public:
  /// @param index  which one of several that serve the same purpose.
  RandomStream(int seed, RandomPurpose purpose, unsigned index = 0);

  /// @return uniform in [0, 1).
  double uniform();

  /// @return normal with mean 0 and standard deviation 1 (Box and Muller).
  double gaussian();

 private:
  std::mt19937_64 engine_;
};

}  // namespace suspension_health_monitor
