#include "suspension_health_monitor/internal/simulation/random_stream.h"

#include <cmath>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

std::mt19937_64 seeded(int seed, RandomPurpose purpose) {
  std::seed_seq sequence{static_cast<unsigned>(seed), static_cast<unsigned>(purpose)};
  return std::mt19937_64(sequence);
}

}  // namespace

RandomStream::RandomStream(int seed, RandomPurpose purpose) : engine_(seeded(seed, purpose)) {}

double RandomStream::uniform() {
  // The upper 53 bits fill a double's mantissa exactly.
  return static_cast<double>(engine_() >> 11) * 0x1p-53;
}

double RandomStream::gaussian() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * kPi * uniform());
}

}  // namespace suspension_health_monitor
