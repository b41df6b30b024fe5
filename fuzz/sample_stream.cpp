#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "../test/core/uniform_grid.h"
#include "entry_points.h"
#include "fuzz_bytes.h"
#include "fuzz_law.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr Stamp kNewest = std::chrono::seconds(std::numeric_limits<std::uint32_t>::max());  // a ROS stamp has 32 bit

MonitorSettings takeOptions(FuzzBytes& bytes) {
  constexpr std::array kPeriods{1e-5, 1e-3, 0.005, 0.02, 0.1, 10.0};
  constexpr std::array kForgetting{0.9, 0.98, 0.99, 0.999, 1.0};
  constexpr std::array kRules{IntegrationRule::kTrapezoid, IntegrationRule::kBandLimited};
  MonitorSettings options;
  options.sample_period = kPeriods[bytes.choose(kPeriods.size())];
  options.integration_horizon = static_cast<double>(1 + bytes.choose(60)) * *options.sample_period;
  options.integration_rule = kRules[bytes.choose(kRules.size())];
  options.forgetting_factor = kForgetting[bytes.choose(kForgetting.size())];
  const auto flags = bytes.take<std::uint8_t>();
  if ((flags & 1U) != 0) options.estimators.initial_variance_rule = InitialVariance::kAbsolute;
  if ((flags & 2U) != 0) options.estimators.small_divisor_rule = SmallDivisor::kAbsolute;
  if ((flags & 4U) != 0) options.estimators.small_divisor = 0.0;
  if ((flags & 8U) != 0) options.estimators.scale_covariance_at_start = false;
  if ((flags & 16U) != 0) options.nominal_damping_to_mass = 3.0;
  if ((flags & 32U) != 0) options.nominal_stiffness_to_mass = 13.8;
  if ((flags & 64U) != 0) options.estimators.initial_variance = 1e15;
  if ((flags & 128U) != 0) options.estimators.start_rows = 1;
  bytes.take<std::uint8_t>();  // an option that is no more; inputs that were found keep their meaning
  return options;
}

/// One strut's two sensors and what the monitor says of them.
class Stream {
 public:
  explicit Stream(const MonitorSettings& options)
      : monitor_(options), grid_(*options.sample_period), period_(fromSeconds(*options.sample_period)) {}

  void run(FuzzBytes& bytes) {
    while (!bytes.empty()) {
      switch (bytes.choose(4)) {
        case 0: reading(bytes); break;
        case 1: pair(bytes); break;
        case 2: drive(bytes); break;
        default: setEffects(bytes); break;
      }
    }
  }

 private:
  void reading(FuzzBytes& bytes) {
    const Side side = bytes.choose(2) == 0 ? Side::kSprung : Side::kUnsprung;
    moveClock(bytes);
    push(side, clock_, takeValue(bytes));
  }

  void pair(FuzzBytes& bytes) {
    moveClock(bytes);
    push(Side::kSprung, clock_, takeValue(bytes));
    push(Side::kUnsprung, clock_ + (period_ * bytes.take<std::int8_t>()) / 256, takeValue(bytes));
  }

  /// A stretch of honest driving, so that the estimates come to something.
  void drive(FuzzBytes& bytes) {
    const std::size_t samples = std::min(bytes.choose(256), drive_left_);
    drive_left_ -= samples;
    const double size = std::ldexp(1.0, bytes.take<std::int8_t>() / 8);
    const double dt = std::min(toSeconds(period_), 0.05);
    for (std::size_t i = 0; i < samples; ++i) {
      random_ = random_ * 6364136223846793005U + 1442695040888963407U;
      const double wheel = size * static_cast<double>(static_cast<std::int64_t>(random_) >> 32) * 0x1p-31;
      const double body = 3.0 * rate_ + 13.8 * travel_;
      rate_ += dt * (wheel - body);
      travel_ += dt * rate_;
      clock_ = std::min(clock_ + period_, kNewest);
      push(Side::kSprung, clock_, body);
      push(Side::kUnsprung, clock_, wheel);
    }
  }

  void setEffects(FuzzBytes& bytes) {
    const std::vector<ForceEffect>& catalogue = forceEffects();
    std::vector<ActiveEffect> effects;
    for (std::size_t left = bytes.choose(4); left > 0; --left) {
      ActiveEffect active{catalogue[bytes.choose(catalogue.size())], bytes.take<std::int16_t>() / 64.0, {}};
      for (std::size_t i = 0; i < active.effect.shapes.size(); ++i)
        active.shapes.push_back(std::ldexp(1.0, bytes.take<std::int8_t>() / 4));
      effects.push_back(std::move(active));
    }
    try {
      monitor_.setEffects(effects);
    } catch (const std::invalid_argument&) {
      return;  // refused: the model is as it was
    }
    require(monitor_.effects().size() == effects.size(), "the effects that were set are in the model");
  }

  void moveClock(FuzzBytes& bytes) {
    switch (bytes.choose(16)) {
      case 0: break;
      case 1: clock_ = Stamp::zero(); break;
      case 2: clock_ -= period_ * bytes.take<std::uint16_t>(); break;
      case 3: clock_ += period_ * bytes.take<std::uint16_t>(); break;
      case 4: clock_ = kNewest; break;
      case 5: clock_ = std::chrono::seconds(bytes.take<std::uint32_t>()); break;
      case 6: clock_ += Stamp(bytes.take<std::int32_t>()); break;
      default: clock_ += period_ + (period_ * bytes.take<std::int8_t>()) / 512; break;
    }
    clock_ = std::max(std::min(clock_, kNewest), Stamp::zero());
  }

  double takeValue(FuzzBytes& bytes) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr std::array kSpecial{0.0,   -0.0, 9.81,      -9.81,      1e59,
                                  -1e59, 1e61, 1e-300,    5e-324,     1e300,
                                  1e6,   -1e9, kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()};
    switch (bytes.choose(8)) {
      case 0: return kSpecial[bytes.choose(kSpecial.size())];
      case 1: return bytes.take<double>();
      default: return bytes.take<std::int16_t>() / 512.0;
    }
  }

  void push(Side side, Stamp stamp, double value) {
    ++readings_;
    const std::optional<CornerSample> sample = grid_.push(side, stamp, value);
    if (sample) {
      ++samples_;
      take(monitor_.addSample(*sample));
    }
    const RejectCounts rejected = grid_.streams().rejected();
    // A stuck sensor is counted once for the pair; a reading that begins a new series is counted and used.
    const std::uint64_t seen = 2 * samples_ + rejected.total() + rejected.count(RejectReason::kStuck);
    require(readings_ <= seen + 2 * kMostWaiting, "every reading waits, is used or is counted");
    require(seen <= readings_ + rejected.count(RejectReason::kTimeWentBack), "no reading is counted twice");
    require(monitor_.input().samples + monitor_.rejected().total() == samples_, "every sample is used or counted");
  }

  void take(const MonitorReport* report) {
    if (report == nullptr) return;
    check(report->estimate);
    check(report->ls);
    check(report->la);
    require(!(report->comparison.predicted && !std::isfinite(*report->comparison.predicted)), "predictions are finite");
    if (monitor_.input().restarts == restarts_)
      require(!(reported_ && report->stamp <= *reported_), "stamps of reports rise until the clock goes back");
    restarts_ = monitor_.input().restarts;
    reported_ = report->stamp;
  }

  static void check(const StrutEstimate& estimate) {
    if (!estimate.valid()) return;
    require(std::isfinite(estimate.damping_to_mass) && std::isfinite(estimate.stiffness_to_mass),
            "a valid estimate is finite");
    require(estimate.damping_to_mass_stddev >= 0.0 && estimate.stiffness_to_mass_stddev >= 0.0,
            "a valid estimate has a standard deviation");
    for (std::size_t j = 0; j < estimate.num_effects; ++j)
      require(std::isfinite(estimate.coefficients[j]), "a valid coefficient is finite");
  }

  SuspensionMonitor monitor_;
  UniformGrid grid_;
  Stamp period_, clock_ = std::chrono::seconds(1000);
  std::uint64_t readings_ = 0, samples_ = 0, restarts_ = 0;
  std::size_t drive_left_ = 3000;  // samples, so that many inputs can be tried
  std::uint64_t random_ = 1;
  double travel_ = 0.0, rate_ = 0.0;
  std::optional<Stamp> reported_;
};

}  // namespace

void feedSampleStream(const std::uint8_t* bytes, std::size_t size) {
  FuzzBytes rest(bytes, size);
  const MonitorSettings options = takeOptions(rest);
  std::optional<Stream> stream;
  try {
    stream.emplace(options);
  } catch (const std::invalid_argument&) {
    return;  // Simpson's rule with an odd number of samples
  }
  stream->run(rest);
}

}  // namespace suspension_health_monitor
