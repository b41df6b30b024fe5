#include "suspension_health_monitor/internal/signal/stream_clock.h"

#include <algorithm>
#include <complex>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/tuning.h"

namespace suspension_health_monitor {

constexpr std::array kDifference{1.0, -4.0, 6.0, -4.0, 1.0};  // D
const double kConvincing = std::log(1e3);                     // likelihood ratio, its logarithm

// Distances count from their mean: an error that the regular times of all these readings share displaces none of them
// against another.
void SamplingTest::add(double value, double off) {
  values_.push(value);
  off_.push(off);
  if (!values_.full()) return;
  double mean = 0.0, e = 0.0, r = 0.0;
  for (std::size_t i = 0; i < kDifference.size(); ++i) mean += off_.window()[kReach + i];
  mean /= kDifference.size();
  for (std::size_t i = 0; i < kDifference.size(); ++i) {
    const double* x = values_.window() + kReach + i;
    e += kDifference[i] * *x;
    r += kDifference[i] * 0.5 * (x[1] - x[-1]) * (off_.window()[kReach + i] - mean);
  }
  products_.add({r * r, r * e, e * e});
}

// The logarithm of the likelihood ratio is half the difference of the sums of squares over the variance of e.
bool SamplingTest::isCertainlyRegular() const {
  const double difference = products_.mean(0) - 2.0 * products_.mean(1);
  return products_.weight() * difference > 2.0 * kWindow * kConvincing * products_.mean(2);
}

void StreamClock::interrupt() {
  origin_.reset();
  last_.reset();
  num_first_ = 0;
}

Stamp StreamClock::add(Stamp stamp, double value) {
  if (!origin_) origin_ = stamp;
  const double now = toSeconds(stamp - *origin_);
  Stamp taken = stamp, apart(1);
  if (num_first_ < kFirst) {
    begin(now);
    settled_ = stamp;
  } else {
    follow(now);
    const double off = (now - time_) / period_;
    sampling_.add(value, off);
    if (isLearning() && !sampling_.isRegular()) settled_ = stamp;
    // A reading that is off by periods follows several lost ones, unless its message waited.
    const bool is_far = std::abs(off) > kSignalTuning.near, waited = is_far && waits_ > 0;
    if (sampling_.isRegular() || (waited && !sampling_.isAsStamped())) {
      taken = *origin_ + fromSeconds(time_ + (is_far && !waited ? std::round(off) * period_ : 0.0));
      apart = fromSeconds(0.5 * period_);  // one that was counted too far before: a curve through the readings holds
    }
  }
  if (last_) taken = std::max(taken, *last_ + apart);
  last_ = taken;
  return taken;
}

// Of the first readings. It is that of stretches without a loss or a pause, unless half of them have one.
double StreamClock::medianSpacing(std::size_t over) const {
  std::array<double, kFirst> spacings;
  const auto end = spacings.begin() + static_cast<std::ptrdiff_t>(num_first_ - over);
  for (std::size_t i = 0; i + over < num_first_; ++i) spacings[i] = first_[i + over] - first_[i];
  const auto middle = spacings.begin() + (end - spacings.begin()) / 2;
  std::nth_element(spacings.begin(), middle, end);
  return *middle / static_cast<double>(over);
}

// The sum of exp(2 pi i f t) over the stamps t is largest where f is the rate, however many readings are lost.
double StreamClock::likeliestPeriod(double rough) const {
  // A quarter of a peak's width; one loss in each stretch.
  constexpr double kStep = 0.25 / kFirst, kMost = 1.0 / kSignalTuning.longest_batch;
  std::array<std::complex<double>, kFirst> now, turn;
  for (std::size_t i = 0; i < kFirst; ++i) {
    const double angle = 2.0 * M_PI * (first_[i] - first_[0]) / rough;
    now[i] = std::polar(1.0, (1.0 - kMost) * angle);
    turn[i] = std::polar(1.0, kStep * angle);
  }
  double best = 1.0, highest = 0.0;
  for (double rate = 1.0 - kMost; rate <= 1.0 + kMost; rate += kStep) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < kFirst; ++i) {
      sum += now[i];
      now[i] *= turn[i];
    }
    if (std::norm(sum) <= highest) continue;
    highest = std::norm(sum);
    best = rate;
  }
  return rough / best;
}

void StreamClock::begin(double stamp) {
  first_[num_first_++] = stamp;
  if (num_first_ > 1) period_ = medianSpacing(std::min<std::size_t>(kSignalTuning.longest_batch, num_first_ / 2));
  if (num_first_ < kFirst) return;
  period_ = likeliestPeriod(period_);
  stamp_ = time_ = first_[0];
  readings_ = kFirst / 4;  // the step of rates
  miscount_ = evidence_ = whole_before_ = 0.0;
  out_of_step_ = 0;
  square_ = jitter_ = RunningMean(kMemory);
  square_.add(square(0.5 * period_));
  for (std::size_t i = 1; i < kFirst; ++i) follow(first_[i]);
}

// The count of periods is wrong by n once the likelihood of the newest stamps is kConvincing times as high with n as
// without (Page's cumulative sum). One stamp alone shows one lost reading at the most, and none behind one that was off
// itself: messages wait, and those behind them.
int StreamClock::periodsSinceLast(double stamp) {
  const double off = (stamp - time_) / period_ - 1.0, whole = std::round(off);
  if (whole != 0.0 && whole != miscount_) {
    miscount_ = whole;
    evidence_ = 0.0;
  }
  const double ratio = miscount_ * (2.0 * off - miscount_) * square(period_) / (2.0 * square_.mean());
  const double most =
      (std::abs(whole) > 1.0 || whole_before_ != 0.0) ? kSignalTuning.of_one_stamp * kConvincing : kConvincing;
  evidence_ = std::max(0.0, evidence_ + std::min(ratio, most));
  // After a message that waited the next is less late; after lost readings it is as late, or later.
  const bool is_less_late = whole < whole_before_ && std::max(std::abs(whole), std::abs(whole_before_)) > 1.0;
  if (is_less_late) waits_ = kSignalTuning.miscount;
  whole_before_ = whole;
  const bool is_pause = std::abs(whole) > kSignalTuning.longest_batch;
  if (!is_pause && evidence_ < kConvincing) {
    out_of_step_ = std::max(0, out_of_step_ - 1);
    return 1;
  }
  out_of_step_ += kSignalTuning.miscount;
  if (!is_pause) lost_ += static_cast<std::int64_t>(miscount_);
  if (!is_pause && std::abs(miscount_) > 1.0) waits_ = std::max(0, waits_ - 1);
  sampling_.interrupt();
  evidence_ = whole_before_ = 0.0;
  return 1 + static_cast<int>(std::clamp(whole, -1e9, 1e9));
}

// What a stamp is off by counts from the mean of the periods that it may be of (probabilistic data association).
void StreamClock::follow(double stamp) {
  const int periods = periodsSinceLast(stamp);
  const double step = period_ * periods, miscounted = 1.0 / (1.0 + std::exp(kConvincing - evidence_));
  double off = stamp - time_ - step;
  off = std::abs(off) > kSignalTuning.near * period_ ? std::remainder(off, period_)
                                                     : off - miscounted * miscount_ * period_;
  if (evidence_ == 0.0 && periods == 1) jitter_.add(square(stamp - stamp_ - step));
  if (isLearning()) readings_ += 1.0;
  const double sum = readings_ * (readings_ + 1.0);
  time_ += step + 2.0 * (2.0 * readings_ - 1.0) / sum * off;
  period_ += 6.0 / sum * off;
  square_.add(off * off);
  stamp_ = stamp;
  if (out_of_step_ < kSignalTuning.other_period) return;
  num_first_ = 0;
  lost_ -= out_of_step_ / kSignalTuning.miscount;  // it was the period that changed
}

}  // namespace suspension_health_monitor
