#include "suspension_health_monitor/internal/blocks/fourier_integrals.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/blocks/tuning.h"

namespace suspension_health_monitor {
namespace {

constexpr int kLanes = 8;  // bins that are turned at once

}  // namespace

FourierIntegrals::FourierIntegrals(const BlockBand& band, std::size_t channels)
    : band_(band),
      half_length_(band.length / 2.0),
      longest_spacing_(kBlockTuning.longest_spacing * band.length),
      channels_(channels),
      first_(channels),
      newest_(channels) {
  const int lanes = (band.last + 1 + kLanes - 1) / kLanes * kLanes;
  cosines_.resize(static_cast<std::size_t>(lanes));
  sines_.resize(cosines_.size());
  real_.setZero(lanes, static_cast<Eigen::Index>(channels));
  imaginary_ = real_;
  for (Half& each : halves_) each.integrals.setZero(band.spectrumSize(), static_cast<Eigen::Index>(channels));
}

void FourierIntegrals::push(double time, const double* values) {
  const long half = static_cast<long>(std::floor(time / half_length_));
  if (!time_) {
    std::copy_n(values, channels_, first_.begin());
    begin(half);
    is_whole_ = time - static_cast<double>(half) * half_length_ < longest_spacing_;
  } else {
    const double spacing = time - *time_;
    const bool is_gap = spacing > longest_spacing_;
    if (is_gap) {
      is_whole_ = false;
      finishUntil(half);
      is_whole_ = false;
      spacing_ = 0.0;
    } else if (half == open_) {
      add(*time_, newest_.data(), (spacing_ + spacing) / 2.0);
      spacing_ = spacing;
    } else {
      // The end of the half block cuts the spacing: the rule over either part, on the straight line between readings.
      const double before = (static_cast<double>(half) * half_length_ - *time_) / spacing, after = 1.0 - before;
      add(*time_, newest_.data(), (spacing_ + (1.0 - after * after) * spacing) / 2.0);
      add(time, values, before * before * spacing / 2.0);
      finishUntil(half);
      add(*time_, newest_.data(), after * after * spacing / 2.0);
      spacing_ = (1.0 - before * before) * spacing;
    }
  }
  time_ = time;
  std::copy_n(values, channels_, newest_.begin());
}

void FourierIntegrals::restart() {
  time_.reset();
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

void FourierIntegrals::add(double time, const double* values, double weight) {
  const double phase = -2.0 * M_PI * (time - static_cast<double>(open_) * half_length_) / band_.length;
  const auto count = static_cast<int>(cosines_.size());
  double *c = cosines_.data(), *s = sines_.data();
  c[0] = std::cos(phase);
  s[0] = std::sin(phase);
  for (int k = 1; k < kLanes; ++k) {
    c[k] = c[k - 1] * c[0] - s[k - 1] * s[0];
    s[k] = c[k - 1] * s[0] + s[k - 1] * c[0];
  }
  const double c8 = c[kLanes - 1], s8 = s[kLanes - 1];
  for (int k = kLanes; k < count; ++k) {
    c[k] = c[k - kLanes] * c8 - s[k - kLanes] * s8;
    s[k] = c[k - kLanes] * s8 + s[k - kLanes] * c8;
  }
  for (std::size_t j = 0; j < channels_; ++j) {
    const double x = weight * (values[j] - first_[j]);
    double *real = real_.col(static_cast<Eigen::Index>(j)).data(),
           *imaginary = imaginary_.col(static_cast<Eigen::Index>(j)).data();
    for (int k = 0; k < count; ++k) {
      real[k] += x * c[k];
      imaginary[k] += x * s[k];
    }
  }
}

void FourierIntegrals::finishUntil(long index) {
  if (index == open_) return;
  Half& half = slot(open_);
  half.index = open_;
  half.is_complete = is_whole_;
  const Eigen::Index from = band_.first - 2, size = band_.spectrumSize();  // element i is bin i + 1
  half.integrals.real() = real_.middleRows(from, size);
  half.integrals.imag() = imaginary_.middleRows(from, size);
  begin(index);
}

const Eigen::ArrayXXcd* FourierIntegrals::half(long index) const {
  const Half& half = halves_[static_cast<std::size_t>(index % kHalves)];
  return half.index == index && half.is_complete ? &half.integrals : nullptr;
}

}  // namespace suspension_health_monitor
