#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/blocks/block_bins.h"

namespace suspension_health_monitor {

/// Fourier integrals of the channels of one stream over half blocks, by the trapezoid rule on the stream's own stamps:
///     I_k = sum of (x_i - x_0) e^(-j w_k (t_i - a)) (t_(i+1) - t_(i-1)) / 2 over a <= t_i < a + T/2,
/// but that a spacing cut by an end of the half block belongs to either part by the straight line between its readings:
/// H_2 (Modulation) weights the ends by 2 pi^2 / T^2, so that a half spacing there would be an error of first order.
/// Two halves make a block: U_k = I_k + (-1)^k I'_k. Where stamps are even the rule is exact up to aliasing within the
/// block, and H_p up to the second order at its ends. So up to three lost readings in a row are
/// interpolated, by the cubic through the two readings on either side: at the middle of 10 ms it is 0.3 % off a wheel
/// hop of 12 Hz, the straight line 7 %. The reading after a loss waits for the next one. x_0 is the stream's first
/// reading: a constant has no part in any bin that is used, and what is small loses little by stamps that are uneven.
/// Cost per reading: O(bins), no allocation. Source: Shinbrot's modulating functions, with Fourier's (A. E. Pearson, Y.
/// Shen, Weighted least squares / MFT algorithms for linear differential system identification, 1993).
class FourierIntegrals {
 public:
  static constexpr int kHalves = 8;  ///< that are kept: a stream may run four blocks ahead of another

  /// e^(-j w_k t), k = 1 .. last + 1, of the newest time: streams that are read in step share it.
  class Phases {
   public:
    explicit Phases(const BlockBand& band) : length_(band.length), cosines_(band.last + 1), sines_(band.last + 1) {}

    /// @param time  since the start of the half block [s].
    void turnTo(double time);

    const Eigen::ArrayXd& cosines() const { return cosines_; }
    const Eigen::ArrayXd& sines() const { return sines_; }  ///< negative ones

   private:
    double length_;
    std::optional<double> time_;
    Eigen::ArrayXd cosines_, sines_;
  };

  /// @param channels  values per reading.
  FourierIntegrals(const BlockBand& band, std::size_t channels);

  /// Takes in the next reading; stamps increase.
  /// @param time  since the start of half block 0 [s], not negative.
  /// @param phases  of the same band.
  void push(double time, const double* values, Phases& phases);

  /// The next reading is the first one.
  void restart();

  /// @return the first half block that is not complete yet.
  long openHalf() const { return open_; }

  /// @return the integrals over a half block, bins first - 1 .. last + 1 by channels; nullptr if readings are missing.
  const Eigen::ArrayXXcd* half(long index) const;

  /// The integrals of a channel over the block that ends with this half block, which and the one before are complete:
  /// U_k.
  template <class Result>
  void sumHalves(long index, Eigen::Index channel, Result&& result) const {
    const auto &first = *half(index - 1), &second = *half(index);
    for (Eigen::Index i = 0; i < first.rows(); ++i) {
      const bool is_odd = (band_.first - 1 + i) % 2 != 0;
      result[i] = first(i, channel) + (is_odd ? -second(i, channel) : second(i, channel));
    }
  }

 private:
  struct Half {
    long index = -1;  // -1: none, or not complete
    Eigen::ArrayXXcd integrals;
  };

  struct Reading {
    double time = 0.0;
    std::vector<double> values;
  };

  long halfOf(double time) const { return static_cast<long>(std::floor(time / half_length_)); }
  int lostBefore(double time);  // number of readings, since last_
  // Takes in what was lost before held_, and held_.
  void bridge(double next_time, const double* next, Phases& phases);
  void takeHeld();
  void addSpacing(const Reading& left, const Reading& right, Phases& phases);
  void begin(long index);
  void add(const Reading& reading, double weight, Phases& phases);  // to the open half block
  void finishUntil(long index);

  BlockBand band_;
  double half_length_, longest_spacing_;
  std::array<Half, kHalves> halves_;
  Eigen::ArrayXXd real_, imaginary_;   // sums of the open half block
  Reading before_, last_, held_;       // the two newest that are taken in; the next one
  std::vector<Reading> interpolated_;  // in place of lost ones
  int lost_ = 0;                       // readings before held_; 0: none is held
  int spacings_ = 0;                   // without a gap, as far as they count for mean_spacing_
  double mean_spacing_ = 0.0;          // spacing: the mean of the newest ones [s]
  std::vector<double> first_;          // reading
  bool is_empty_ = true;               // there was none
  double spacing_ = 0.0;               // before the last one, as far as it is in the open half block
  long open_ = 0;
  bool is_whole_ = false;  // no reading of the open half block is missing
};

}  // namespace suspension_health_monitor
