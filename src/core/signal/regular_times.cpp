#include "suspension_health_monitor/internal/signal/regular_times.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <complex>

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLossShare = 1e-4, kAstrayShare = 1e-3, kKnown = 1000.0;  // beforehand, as if of so many readings
constexpr double kOneMore = 0.5;      // chance that after a lost reading the next one is lost, too
constexpr double kTakenBack = 1e-5;   // chance that a count turns out to be too high
constexpr double kImpossible = 14.0;  // -ln of a chance that counts for none
constexpr double kFarOff = 3.0;       // usual distances
constexpr double kLeast = 1e-3;       // usual distance, in periods: stamps are no better
constexpr int kRoughly = 20;          // readings whose line is as good as the one to start from
constexpr int kOtherRate = 50;        // readings more that do not follow by a period than do: the period is another one

}  // namespace

double RegularTimes::next(double stamp) {
  if (out_of_step_ > kOtherRate) readings_ = out_of_step_ = 0;
  if (readings_ < kFewest) return begin(stamp);
  follow(stamp, false);
  return time_;
}

// The line that the first readings are the likeliest on, once it has followed them.
double RegularTimes::begin(double stamp) {
  first_[static_cast<std::size_t>(readings_)] = time_ = stamp;
  expected_ = 1.0;
  if (++readings_ < kFewest) return stamp;
  RegularTimes other = *this;
  if (other.startFrom(likeliestPeriod()) > startFrom(noneLost())) *this = other;
  return stamp;
}

double RegularTimes::startFrom(const Line& line) {
  time_ = line.time;
  spacing_ = line.spacing;
  out_of_step_ = in_row_ = 0;
  beSureOfCount();
  losses_ = astray_ = followed_ = 0.0;
  means_ = RunningMeans<kNumMeans>(StreamTiming::kMemory);
  means_.add({line.variance, line.variance});
  readings_ = line.readings;
  double sum = 0.0;
  for (const double stamp : first_) sum += std::log(follow(stamp, true) / spacing_);
  return sum;
}

double RegularTimes::follow(double stamp, bool tells_likelihood) {
  const Count found = count((stamp - time_) / spacing_ - expected_, tells_likelihood);
  const double taken = expected_ + found.short_by;
  in_row_ = taken == 1.0 ? in_row_ + 1 : 1;
  out_of_step_ = std::max(0, out_of_step_ + (found.short_by == 0 && found.astray < 0.5 ? -1 : 1));
  readings_ = std::min(readings_ + 1, static_cast<int>(kMemory));
  const double n = readings_, sum = n * (n + 1.0), most = kFarOff * spacing_ * std::sqrt(usualSquare());
  const double off = std::clamp(stamp - time_ - taken * spacing_, -most, most);
  time_ += taken * spacing_ + 2.0 * (2.0 * n - 1.0) / sum * off;
  spacing_ += 6.0 / sum * off / std::max(1.0, taken);
  means_.add({square(stamp - time_), square(off)});
  expected_ = 1.0;
  return found.likelihood;
}

RegularTimes::Line RegularTimes::noneLost() const {
  Eigen::Matrix<double, kFewest, 2> periods;
  periods.col(0).setLinSpaced(1.0, kFewest);
  periods.col(1).setOnes();
  const Eigen::Map<const Eigen::Matrix<double, kFewest, 1>> stamps(first_.data());
  const Eigen::Vector2d line = (periods.transpose() * periods).ldlt().solve(periods.transpose() * stamps);
  return {line[0], line[1], (stamps - periods * line).squaredNorm() / (kFewest - 2), kRoughly};
}

// The sum of exp(2 pi i f t) over the stamps t is large where f is the rate, whatever the number of readings between
// them. Of nearly equal ones it is the lowest frequency: of readings that come in batches there are several.
RegularTimes::Line RegularTimes::likeliestPeriod() const {
  constexpr double kLowest = 1.0 / 1.05, kHighest = 1.0 / 0.6, kNearly = 0.8;  // of the mean rate; of the highest power
  constexpr double kStep = 1.0 / (4.0 * kFewest);                              // a quarter of a peak's width
  constexpr auto kFrequencies = static_cast<std::size_t>((kHighest - kLowest) / kStep);
  const double mean = (first_.back() - first_.front()) / (kFewest - 1);
  std::array<std::complex<double>, kFewest> now, turn;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double angle = 2.0 * M_PI * (first_[i] - first_.front()) / mean;
    now[i] = std::polar(1.0, kLowest * angle);
    turn[i] = std::polar(1.0, kStep * angle);
  }
  std::array<double, kFrequencies> power;
  for (double& p : power) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      sum += now[i];
      now[i] *= turn[i];
    }
    p = std::norm(sum);
  }
  const double high = kNearly * *std::max_element(power.begin(), power.end());
  std::size_t best = 0;
  while (power[best] < high) ++best;
  while (best + 1 < kFrequencies && power[best + 1] > power[best]) ++best;
  double place = static_cast<double>(best);
  if (best > 0 && best + 1 < kFrequencies) {  // the top of the parabola
    const double before = power[best - 1], after = power[best + 1];
    place += 0.5 * (after - before) / (2.0 * power[best] - before - after);
  }
  const double spacing = mean / (kLowest + place * kStep), radian = spacing / (2.0 * M_PI);
  std::complex<double> sum = 0.0;
  for (const double stamp : first_) sum += std::polar(1.0, (stamp - first_.front()) / radian);
  // Of a normal angle of variance v the mean of exp(i angle) has the size exp(-v / 2).
  const double size = std::min(1.0, std::abs(sum) / kFewest);
  return {spacing, first_.front() + std::arg(sum) * radian - spacing, -2.0 * std::log(size) * square(radian), kFewest};
}

void RegularTimes::beSureOfCount() {
  chances_ = {};
  chances_[kReach] = 1.0;
}

double RegularTimes::lossShare() const { return (kKnown * kLossShare + std::max(0.0, losses_)) / (kKnown + followed_); }

double RegularTimes::astrayShare() const { return (kKnown * kAstrayShare + astray_) / (kKnown + followed_); }

double RegularTimes::usualSquare() const { return std::max(means_.mean(kUsual) / square(spacing_), square(kLeast)); }

RegularTimes::Count RegularTimes::count(double off, bool tells_likelihood) {
  followed_ += 1.0;
  Count found;
  // What is nearer to the next period than to any other, by far, is of that, unless the count was in doubt before.
  const bool is_clear = chances_[kReach] == 1.0 && 1.0 - 2.0 * std::abs(off) > 2.0 * kImpossible * usualSquare();
  if (is_clear && !tells_likelihood) return found;
  if (std::abs(off) <= kReach) {
    found = infer(off);
  } else {  // a pause
    found.short_by = static_cast<int>(std::clamp(std::round(off), -1e9, 1e9));
    found.likelihood = kLossShare;
    beSureOfCount();
  }
  losses_ += found.short_by > 0 ? 1.0 : found.short_by < 0 ? -1.0 : 0.0;
  astray_ += found.astray;
  return found;
}

// chances_ become those of the states relative to the likeliest one.
RegularTimes::Count RegularTimes::infer(double off) {
  const double usual = usualSquare(), lost = lossShare();
  const double anything = astrayShare() / kStates;  // density, per period
  std::array<double, kStates> moved;
  double from_below = 0.0, from_above = 0.0;  // of chances, the farther away the less
  for (std::size_t j = 0; j < kStates; ++j) {
    moved[j] = (1.0 - lost) * chances_[j] + lost * from_below;
    from_below = kOneMore * from_below + (1.0 - kOneMore) * chances_[j];
  }
  for (std::size_t j = kStates; j-- > 0;) {
    moved[j] += kTakenBack * from_above;
    from_above = kOneMore * from_above + (1.0 - kOneMore) * chances_[j];
  }
  double total = 0.0, astray = 0.0;
  for (std::size_t j = 0; j < kStates; ++j) {
    const double away = off - (static_cast<double>(j) - kReach);
    astray += moved[j] * anything;
    moved[j] *= std::exp(-0.5 * square(away) / usual) / std::sqrt(2.0 * M_PI * usual) + anything;
    total += moved[j];
  }
  const auto best = std::max_element(moved.begin(), moved.end()) - moved.begin();
  Count found{static_cast<int>(best) - kReach, astray / total, total};
  chances_ = {};
  for (int j = 0; j < static_cast<int>(kStates); ++j) {
    const double chance = moved[static_cast<std::size_t>(j)] / total;
    if (chance < std::exp(-kImpossible)) continue;
    const int to = j - found.short_by;
    if (to >= 0 && to < static_cast<int>(kStates)) chances_[static_cast<std::size_t>(to)] = chance;
  }
  if (1.0 - chances_[kReach] < std::exp(-kImpossible)) chances_[kReach] = 1.0;
  return found;
}

}  // namespace suspension_health_monitor
