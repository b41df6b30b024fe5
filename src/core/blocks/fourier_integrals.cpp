#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"

#include <algorithm>
#include <utility>

#include "suspension_health_monitor/internal/blocks/tuning.h"

namespace suspension_health_monitor {
namespace {

// Lagrange: weights of the values at four times in that of their polynomial at t.
std::array<double, 4> lagrange(const std::array<double, 4>& at, double t) {
  std::array<double, 4> weights{1.0, 1.0, 1.0, 1.0};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      if (i != j) weights[i] *= (t - at[j]) / (at[i] - at[j]);
  return weights;
}

}  // namespace

void FourierIntegrals::Phases::turnTo(double time) {
  if (time == time_) return;
  time_ = time;
  const double phase = -2.0 * M_PI * time / length_;
  cosines_[0] = std::cos(phase);
  sines_[0] = std::sin(phase);
  for (Eigen::Index n = 1; n < cosines_.size(); n *= 2) {  // those of n bins, turned by the last of them, are n more
    const Eigen::Index more = std::min(n, cosines_.size() - n);
    const double c = cosines_[n - 1], s = sines_[n - 1];
    cosines_.segment(n, more) = cosines_.head(more) * c - sines_.head(more) * s;
    sines_.segment(n, more) = cosines_.head(more) * s + sines_.head(more) * c;
  }
}

FourierIntegrals::FourierIntegrals(const BlockBand& band, std::size_t channels)
    : band_(band),
      half_length_(band.length / 2.0),
      longest_spacing_(kBlockTuning.longest_spacing * band.length),
      interpolated_(kBlockTuning.most_lost),
      first_(channels) {
  real_.setZero(band.last + 1, channels);
  imaginary_ = real_;
  for (Reading* each : {&before_, &last_, &held_}) each->values.resize(channels);
  for (Reading& each : interpolated_) each.values.resize(channels);
  for (Half& each : halves_) each.integrals.setZero(band.spectrumSize(), channels);
}

void FourierIntegrals::push(double time, const double* values, Phases& phases) {
  if (lost_ > 0) bridge(time, values, phases);
  held_.time = time;
  std::copy_n(values, held_.values.size(), held_.values.begin());
  lost_ = is_empty_ ? 0 : lostBefore(time);
  if (lost_ > 0) return;
  if (is_empty_) {
    first_ = held_.values;
    begin(halfOf(time));
    is_whole_ = time - static_cast<double>(open_) * half_length_ < longest_spacing_;
    is_empty_ = false;
  } else {
    addSpacing(last_, held_, phases);
  }
  takeHeld();
}

void FourierIntegrals::takeHeld() {
  std::swap(before_, last_);
  std::swap(last_, held_);
}

int FourierIntegrals::lostBefore(double time) {
  const double spacing = time - last_.time;
  if (spacing > longest_spacing_) {
    spacings_ = 0;
    return 0;
  }
  const bool is_regular = spacings_ < 2 || spacing < 1.5 * mean_spacing_;
  const long lost = is_regular ? 0 : std::lround(spacing / mean_spacing_) - 1;
  spacings_ = std::min(spacings_ + 1, kBlockTuning.spacings_of_mean);
  mean_spacing_ += (spacing - mean_spacing_) / spacings_;
  return lost <= kBlockTuning.most_lost ? static_cast<int>(lost) : 0;
}

void FourierIntegrals::bridge(double next_time, const double* next, Phases& phases) {
  const std::array<double, 4> at{before_.time, last_.time, held_.time, next_time};
  const double spacing = (at[2] - at[1]) / (lost_ + 1);
  // Beside a spacing that is much shorter the cubic would follow the noise of its two readings.
  const bool is_even = 2.0 * std::min(at[1] - at[0], at[3] - at[2]) > spacing;
  const Reading* left = &last_;
  for (int k = 1; is_even && k <= lost_; ++k) {
    Reading& between = interpolated_[k - 1];
    between.time = at[1] + k * spacing;
    const std::array<double, 4> weights = lagrange(at, between.time);
    for (std::size_t j = 0; j < first_.size(); ++j)
      between.values[j] = weights[0] * before_.values[j] + weights[1] * last_.values[j] + weights[2] * held_.values[j] +
                          weights[3] * next[j];
    addSpacing(*left, between, phases);
    left = &between;
  }
  addSpacing(*left, held_, phases);
  takeHeld();
}

void FourierIntegrals::addSpacing(const Reading& left, const Reading& right, Phases& phases) {
  const long half = halfOf(right.time);
  const double spacing = right.time - left.time;
  if (spacing > longest_spacing_) {
    is_whole_ = false;
    finishUntil(half);
    is_whole_ = false;
    spacing_ = 0.0;
  } else if (half == open_) {
    add(left, (spacing_ + spacing) / 2.0, phases);
    spacing_ = spacing;
  } else {
    // The end of the half block cuts the spacing: the rule over either part, on the straight line between readings.
    const double before = (static_cast<double>(half) * half_length_ - left.time) / spacing, after = 1.0 - before;
    add(left, (spacing_ + (1.0 - after * after) * spacing) / 2.0, phases);
    add(right, before * before * spacing / 2.0, phases);
    finishUntil(half);
    add(left, after * after * spacing / 2.0, phases);
    spacing_ = (1.0 - before * before) * spacing;
  }
}

void FourierIntegrals::restart() {
  is_empty_ = true;
  lost_ = spacings_ = 0;
  spacing_ = 0.0;
  for (Half& each : halves_) each.index = -1;
  begin(0);
}

void FourierIntegrals::begin(long index) {
  open_ = index;
  is_whole_ = true;
  real_.setZero();
  imaginary_.setZero();
}

void FourierIntegrals::add(const Reading& reading, double weight, Phases& phases) {
  phases.turnTo(reading.time - static_cast<double>(open_) * half_length_);
  for (std::size_t j = 0; j < first_.size(); ++j) {
    const double x = weight * (reading.values[j] - first_[j]);
    real_.col(j) += x * phases.cosines();
    imaginary_.col(j) += x * phases.sines();
  }
}

void FourierIntegrals::finishUntil(long index) {
  if (index == open_) return;
  Half& half = halves_[open_ % kHalves];
  half.index = is_whole_ ? open_ : -1;
  const Eigen::Index from = band_.first - 2, size = band_.spectrumSize();  // element i is bin i + 1
  half.integrals.real() = real_.middleRows(from, size);
  half.integrals.imag() = imaginary_.middleRows(from, size);
  begin(index);
}

const Eigen::ArrayXXcd* FourierIntegrals::half(long index) const {
  const Half& half = halves_[index % kHalves];
  return half.index == index ? &half.integrals : nullptr;
}

}  // namespace suspension_health_monitor
