#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "entry_points.h"
#include "fuzz_bytes.h"
#include "fuzz_law.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kMostDrives = 3;

/// Drives made of readings, of repeated readings, of gaps, and of stretches of honest driving, so that a search gets
/// as far as its last step.
class DriveMaker {
 public:
  explicit DriveMaker(FuzzBytes& bytes) : bytes_(bytes) {
    constexpr std::array kPeriods{1e-6, 1e-3, 0.005, 0.01, 0.02, 0.1, 100.0};
    const std::size_t chosen = bytes.choose(kPeriods.size() + 1);
    period_ = chosen < kPeriods.size() ? kPeriods[chosen] : std::ldexp(1.0, bytes.take<std::int8_t>() / 4);
    damping_ = std::ldexp(1.0, bytes.take<std::int8_t>() / 16);
    stiffness_ = std::ldexp(1.0, bytes.take<std::int8_t>() / 8);
    // One after the other: in which order arguments are evaluated is for the compiler to say.
    const double part = bytes.take<std::int8_t>() / 128.0;
    friction_ = std::ldexp(part, bytes.take<std::int8_t>() / 8);
    // The strut of a drive is told in time constants where the period is far from any.
    step_ = std::min(period_, 0.1 / (damping_ + std::sqrt(stiffness_)));
  }

  double period() const { return period_; }

  std::vector<Drive> drives() {
    std::vector<Drive> all(1 + bytes_.choose(kMostDrives));
    for (Drive& drive : all) {
      const std::size_t parts = 1 + bytes_.choose(12);
      const bool has_body = bytes_.choose(3) == 0;
      for (std::size_t i = 0; i < parts && !bytes_.empty(); ++i) addPart(drive);
      if (has_body) addBody(drive);
    }
    return all;
  }

 private:
  void addPart(Drive& drive) {
    const std::size_t kind = bytes_.choose(6), samples = std::min<std::size_t>(bytes_.choose(256), samples_left_);
    samples_left_ -= samples;
    const double size = std::ldexp(1.0, bytes_.take<std::int8_t>() / (kind == 5 ? 1 : 8));
    const double offset = size * bytes_.take<std::int8_t>() / 128.0;
    for (std::size_t i = 0; i < samples; ++i) {
      if (kind == 0) {
        const double sprung = takeReading();
        push(drive, sprung, takeReading());
      }
      if (kind == 1) push(drive, offset, offset);
      if (kind == 2) push(drive, size * random(), size * random());
      if (kind >= 3) drive_on(drive, size, offset);
    }
    if (kind == 1) clock_ += toStamp(period_ * bytes_.take<std::uint8_t>());
  }

  void drive_on(Drive& drive, double size, double offset) {
    const double wheel = size * random(), body = damping_ * rate_ + stiffness_ * travel_ + friction_ * std::tanh(rate_);
    rate_ += step_ * (wheel - body);
    travel_ += step_ * rate_;
    push(drive, body + offset, wheel);
  }

  void addBody(Drive& drive) {
    for (const CornerSample& sample : drive.samples)
      drive.body.push_back({sample.stamp, {random(), bytes_.empty() ? 0.0 : takeReading()}, {random(), std::nan("")}});
  }

  double takeReading() {
    if (bytes_.choose(8) != 0) return bytes_.take<std::int16_t>() / 512.0;
    const double any = bytes_.take<double>();
    return std::isnan(any) ? 0.0 : any;
  }

  double random() {
    random_ = random_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(static_cast<std::int64_t>(random_) >> 32) * 0x1p-31;
  }

  static Stamp toStamp(double seconds) { return fromSeconds(std::min(seconds, 1e6)); }

  void push(Drive& drive, double sprung, double unsprung) {
    drive.samples.push_back({clock_, sprung, unsprung});
    clock_ += toStamp(period_);
  }

  FuzzBytes& bytes_;
  double period_ = 0.0, damping_ = 0.0, stiffness_ = 0.0, friction_ = 0.0, step_ = 0.0;
  double travel_ = 0.0, rate_ = 0.0;
  Stamp clock_ = std::chrono::seconds(1000);
  std::size_t samples_left_ = 900;  // so that many inputs can be tried
  std::uint64_t random_ = 1;
};

double takeNumber(FuzzBytes& bytes) {
  const double part = bytes.take<std::int8_t>() / 16.0;
  return std::ldexp(part, bytes.take<std::int8_t>());
}

std::optional<StrutModel> takeModel(FuzzBytes& bytes) {
  if (bytes.choose(3) != 0) return std::nullopt;
  StrutModel model{takeNumber(bytes), takeNumber(bytes), {}, {}};
  for (std::size_t left = bytes.choose(3); left > 0; --left) {
    const ForceEffect& effect = forceEffects()[bytes.choose(forceEffects().size())];
    ActiveEffect& active = model.effects.emplace_back(ActiveEffect{effect, takeNumber(bytes), {}});
    for (std::size_t i = 0; i < effect.shapes.size(); ++i) active.shapes.push_back(std::abs(takeNumber(bytes)));
  }
  if (bytes.choose(3) == 0) {
    const MeasurementEffect& effect = measurementEffects()[bytes.choose(measurementEffects().size())];
    ActiveMeasurementEffect& reading = model.reading.emplace_back(ActiveMeasurementEffect{effect, {}});
    for (std::size_t i = 0; i < effect.coefficients.size(); ++i) reading.coefficients.push_back(takeNumber(bytes));
  }
  return model;
}

/// A few of the catalogue, or all.
EffectLibrary takeCandidates(FuzzBytes& bytes) {
  EffectLibrary library = builtInEffects();
  const auto mask = bytes.take<std::uint32_t>();
  std::size_t i = 0;
  const auto unwanted = [&](const auto&) { return (mask >> (i++ % 32) & 1U) != 0; };
  library.forces.erase(std::remove_if(library.forces.begin(), library.forces.end(), unwanted), library.forces.end());
  library.readings.erase(std::remove_if(library.readings.begin(), library.readings.end(), unwanted),
                         library.readings.end());
  return library;
}

void check(const StrutModel& model) {
  for (const ModelNumber& number : numbersOf(model)) require(std::isfinite(number.value), "a fitted model is finite");
}

void check(const Comparison& comparison) {
  require(static_cast<bool>(comparison) == comparison.reason.empty(), "a shortcoming has a reason");
  if (!comparison) return;
  check(comparison.model);
  require(std::isfinite(comparison.free_run.rmse), "a comparison has an error");
  require(comparison.noise_floor >= 0.0 && comparison.noise_floor <= comparison.free_run.rmse,
          "the noise floor is not above the error");
  require(!comparison.where.empty(), "a comparison says where");
}

void check(const Diagnosis& diagnosis) {
  require(static_cast<bool>(diagnosis) == diagnosis.reason.empty(), "a shortcoming has a reason");
  if (!diagnosis) return;
  require(std::isfinite(diagnosis.base.held_out_rmse) && !diagnosis.summary.empty(), "a diagnosis says something");
  require(diagnosis.noise_floor >= 0.0 && diagnosis.noise_floor <= diagnosis.base.held_out_rmse,
          "the noise floor is not above the error");
  const bool named = diagnosis.verdict == Verdict::kEffectFound || diagnosis.verdict == Verdict::kSuspect;
  require(named != diagnosis.selected.empty(), "a verdict that names has names");
  require(named == (diagnosis.extended && diagnosis.final_fit), "what is named has a model");
  check(diagnosis.model());
  for (const RankedModel& ranked : diagnosis.ranking)
    require(ranked.fitted || !ranked.significant, "what was not fitted is not significant");
}

template <class Work>
void unlessRefused(const Work& work) {
  try {
    check(work());
  } catch (const std::invalid_argument&) {  // settings that cannot be
  }
}

}  // namespace

void searchDriveRecords(const std::uint8_t* bytes, std::size_t size) {
  FuzzBytes rest(bytes, size);
  const auto flags = rest.take<std::uint8_t>();
  DiagnoseOptions searching;
  CompareOptions comparing;
  searching.threads = 1;
  searching.most_effects = 1 + static_cast<int>(rest.choose(3));
  searching.candidates = takeCandidates(rest);
  searching.model = comparing.model = takeModel(rest);
  comparing.fit = (flags & 1U) != 0;
  if ((flags & 2U) != 0) searching.horizon_samples = comparing.horizon_samples = rest.take<std::uint8_t>();
  DriveMaker maker(rest);
  if ((flags & 4U) != 0) searching.sample_period = comparing.sample_period = maker.period();
  const std::vector<Drive> drives = maker.drives();
  unlessRefused([&] { return compare(drives, comparing); });
  unlessRefused([&] { return diagnose(drives, searching); });
}

}  // namespace suspension_health_monitor
