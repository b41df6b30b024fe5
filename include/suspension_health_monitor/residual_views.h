#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// The samples where some quantity x lies between two values. Means over all drives are taken off before: an offset of
/// a sensor would be everywhere.
struct ResidualBin {
  double from = 0.0, to = 0.0;  ///< of x
  double mean = 0.0;  ///< of the missing force (ComparedSegment::missing_force); over time, of the residual [m/s^2]
  double standard_error = 0.0;  ///< of the mean, correlation over time counted in [m/s^2]
  double rms = 0.0;             ///< of the residual, about 0 and not about the mean [m/s^2]
  std::size_t count = 0;
};

/// A stretch of time of one drive, and by how much the strut's own numbers seem to differ from the model's in it:
/// least squares of the missing force on (v, d). A drift shows as a slope over the stretches.
struct TimeBin : ResidualBin {
  std::size_t drive = 0;
  double damping_error = 0.0, damping_error_stddev = 0.0;      ///< to be added to b1 [1/s]
  double stiffness_error = 0.0, stiffness_error_stddev = 0.0;  ///< to be added to b0 [1/s^2]
};

/// Mean missing force over the plane of travel and travel rate. Row i, column j: travel in travel_edges[i, i + 1], rate
/// in rate_edges[j, j + 1]. The outermost edges take in the extremes. A cell without samples has count 0; its other
/// entries say nothing.
struct ForceSurface {
  std::vector<double> travel_edges;  ///< [m], one more than rows
  std::vector<double> rate_edges;    ///< [m/s], one more than columns
  Eigen::MatrixXd mean;              ///< [m/s^2]
  Eigen::MatrixXd standard_error;    ///< of the mean [m/s^2]
  Eigen::MatrixXd rms;               ///< of the residual [m/s^2]
  Eigen::MatrixXi count;
  double explained_share = 0.0;  ///< of the missing force's mean square (its noise is in there), by these means
};

/// Missing force against travel, apart for the two directions of motion. For a force of travel alone both curves are
/// one.
struct DirectionLoop {
  std::vector<ResidualBin> compressing, extending;  ///< v > 0, v < 0; over the same travel
  double gap = 0.0;                 ///< mean of (compressing - extending), every bin counting by its samples [m/s^2]
  double gap_standard_error = 0.0;  ///< [m/s^2]
  double area = 0.0;                ///< integral of (compressing - extending) over travel [m^2/s^2]: the work per unit
                                    ///< mass and cycle that the model does not take out of the motion
};

/// Power spectral densities, one-sided (Welch, Hann window, half overlapping).
struct ResidualSpectrum {
  std::vector<double> frequency;     ///< [Hz], from the first above 0 to Nyquist's
  std::vector<double> residual;      ///< [(m/s^2)^2/Hz]
  std::vector<double> measured;      ///< of z'' [(m/s^2)^2/Hz]
  std::vector<double> noise;         ///< what the noise of both sensors leaves, see noise_floor [(m/s^2)^2/Hz]
  std::vector<double> coherence;     ///< of residual and w'', 0 .. 1 (magnitude squared)
  double coherence_threshold = 0.0;  ///< unrelated signals stay below it in 95 % of the frequencies
  double num_averages = 0.0;         ///< independent spectra that were averaged
};

/// A correlation coefficient against lag. Bands: 95 % of the lags lie within if the model is right; where noise on w''
/// can leave a correlation (it comes through the model), the band is wide enough for none and for all of it.
struct ResidualCorrelation {
  std::vector<double> lag;           ///< [s]
  std::vector<double> value;         ///< -1 .. 1
  std::vector<double> lower, upper;  ///< band
  double share_outside = 0.0;        ///< of the lags
  bool within = true;                ///< no more lags outside than chance puts there in 99 of 100 cases, and none far
};

/// The residual seen from all sides.
struct ResidualViews {
  double offset = 0.0;                 ///< mean residual [m/s^2], taken off in all views
  double offset_standard_error = 0.0;  ///< [m/s^2]
  double rms = 0.0;                    ///< of what is left [m/s^2]
  std::size_t num_samples = 0;
  double independent_share = 1.0;        ///< independent samples per sample, by the residual's autocorrelation
  std::vector<TimeBin> time;             ///< even, drive after drive [s]
  std::vector<ResidualBin> travel;       ///< [m], by quantiles, finer towards the ends
  std::vector<ResidualBin> travel_rate;  ///< [m/s], likewise
  ForceSurface surface;
  DirectionLoop direction;
  std::optional<ResidualSpectrum> spectrum;  ///< nothing if no segment is long enough
  ResidualCorrelation whiteness;             ///< autocorrelation of the residual, lags above 0
  ResidualCorrelation cross_correlation;     ///< residual against w''; positive lag: the wheel moved before
};

/// What a force may be a function of.
enum class ForceVariable { kTravel, kTravelRate, kTime };

/// Force per unit mass where its variable lies in a narrow range.
struct PartialResidualBin {
  double at = 0.0;         ///< middle of the range [m], [m/s] or [s]
  double mean = 0.0;       ///< seen [m/s^2]
  double deviation = 0.0;  ///< standard deviation of what was seen [m/s^2]
  double law = 0.0;        ///< mean by the law, c f, at the same samples [m/s^2]
  std::size_t count = 0;   ///< samples
};

/// The same over a plane: cell (i, j) between first_edges[i, i + 1] and second_edges[j, j + 1]; without samples count
/// 0.
struct PartialResidualGrid {
  std::vector<double> first_edges, second_edges;
  std::vector<std::vector<PartialResidualBin>> cells;
};

/// One effect's force as the measurement shows it, beside what the law says.
///
/// Its mean is that of what the model lacks (ComparedSegment::missing_force) plus the effect's own part c f: the force
/// that is there beside everything else in the model. It does not depend on c being right. A law that is right lies in
/// the middle of what is seen, over the whole range; one that only helps does not. After W. A. Larsen, S. J. McCleary,
/// Technometrics 14 (1972), 781-790 (partial residual plots).
struct PartialResidual {
  ActiveEffect effect;
  std::vector<ForceVariable> variables;   ///< that decide the force: one or two; of a law with memory the travel
  std::vector<PartialResidualBin> curve;  ///< over the only variable; of a law with memory while compressing
  std::vector<PartialResidualBin> back;   ///< of a law with memory while extending, else empty
  PartialResidualGrid grid;               ///< over two variables, else empty

  bool hasMemory() const { return static_cast<bool>(effect.effect.memory_rate); }

  /// c f at a value of the only variable [m/s^2].  @pre variables.size() == 1 and no memory.
  double lawAt(double value) const;
};

}  // namespace suspension_health_monitor
