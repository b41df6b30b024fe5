#include "suspension_health_monitor/internal/simulation/random_stream.h"

#include <cmath>
#include <vector>

namespace suspension_health_monitor {
namespace {

std::mt19937_64 seeded(int seed, RandomPurpose purpose, unsigned index) {
  std::vector<unsigned> numbers{static_cast<unsigned>(seed), static_cast<unsigned>(purpose)};
  if (index != 0) numbers.push_back(index);
  std::seed_seq sequence(numbers.begin(), numbers.end());
  return std::mt19937_64(sequence);
}

}  // namespace

RandomStream::RandomStream(int seed, RandomPurpose purpose, unsigned index) : engine_(seeded(seed, purpose, index)) {}

double RandomStream::uniform() {
  // The upper 53 bits fill a double's mantissa exactly.
  return static_cast<double>(engine_() >> 11) * 0x1p-53;
}

double RandomStream::gaussian() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * M_PI * uniform());
}

}  // namespace suspension_health_monitor
