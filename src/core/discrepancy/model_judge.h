#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/discrepancy/effect_search.h"
#include "suspension_health_monitor/discrepancy/held_out.h"
#include "suspension_health_monitor/discrepancy/screening.h"

namespace suspension_health_monitor {

/// A model and how it did, or is expected to do, on what was held out.
struct Judged {
  RankedModel ranked;
  std::string added;              ///< what it has and the model before had not
  double training_gain = 0.0;     ///< as ScreenedModel has it
  bool tried = false;             ///< a fit was tried; it may have failed
  ModelFit fit;                   ///< empty unless ranked.fitted
  std::vector<double> stretches;  ///< held-out loss by stretch
  double loss = 0.0;              ///< their sum
  double independent = 0.0;       ///< HeldOut::independentSquares()

  PairedComparison gainOf(const Judged& after) const { return comparePaired(stretches, after.stretches, independent); }
};

/// Free parameters of a model beyond b1 and b0: the simpler of two equal ones is preferred.
std::size_t complexity(const StrutModel& model);

/// Fits models on the training samples of the drives and judges them on the rest.
class ModelJudge {
 public:
  using Tick = std::function<void(double share)>;

  /// @param outlier  residual that begins to count as an outlier [m/s^2].
  /// @param most_forces  force effects that a model may have.  The other arguments must outlive this object.
  ModelJudge(const std::vector<const DriveRecord*>& records, const HeldOut& held_out, double outlier,
             const EffectLibrary& candidates, std::size_t most_forces, int threads)
      : records_(records),
        held_out_(held_out),
        outlier_(outlier),
        candidates_(candidates),
        most_forces_(std::min(most_forces, StrutState::kMostEffects)),
        threads_(threads) {}

  /// @param initial  first guess of the initial states.  @param before  the model to compare with, if any.
  std::optional<Judged> judge(const StrutModel& start, const std::vector<StrutState>& initial,
                              const Judged* before) const;

  /// Every candidate that is not in the model added to it: all screened, those fitted that may be the best.
  /// @return best first, those that were fitted before those that were only screened.
  std::vector<Judged> rankAdditions(const Judged& current, const Tick& tick) const;

  /// The model with one of its effects taken out.
  std::optional<Judged> without(const Judged& judged, const std::string& effect) const;

  /// @return true if `after` is better by enough, and not by chance, correcting for the number of candidates.
  bool isWorthHaving(const Judged& before, const Judged& after) const;

  LinearResponse motionOf(const Judged& judged) const { return {records_, judged.fit}; }
  double surfaceGain(const Judged& judged) const { return Screening(records_, held_out_, judged.fit).surfaceGain(); }
  const HeldOut& heldOut() const { return held_out_; }

 private:
  std::vector<Judged> screenAll(const Judged& current, const Tick& tick) const;
  Judged asScreened(const ScreenedModel& screened, const Judged& before) const;
  void fitAll(const std::vector<std::size_t>& wanted, const Judged& current, std::vector<Judged>& ranking,
              const Tick& tick) const;
  void weigh(const std::vector<std::vector<double>>& residuals, Judged& judged) const;
  void rank(const Judged& before, Judged& judged) const;

  const std::vector<const DriveRecord*>& records_;
  const HeldOut& held_out_;
  double outlier_;
  const EffectLibrary& candidates_;
  std::size_t most_forces_;
  int threads_;
};

}  // namespace suspension_health_monitor
