#include <pybind11/eigen.h>

#include "bindings.h"
#include "suspension_health_monitor/residual_views.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

template <class Bin>
using BinsClass = ResultClass<std::vector<Bin>>;

/// Adds an attribute of bins: an array, one entry per bin.
template <class Bin, class What>
void addTo(BinsClass<Bin>& bins, const char* name, const char* text, const What& what) {
  bins.addColumn(
      name, text, [](const std::vector<Bin>& self) -> const auto& { return self; }, what);
}

template <class Bin>
BinsClass<Bin> bindBins(py::module& module, const char* class_name, const char* text) {
  BinsClass<Bin> bins(module, class_name, text);
  bins.def("__len__", [](const std::vector<Bin>& self) { return self.size(); });
  addTo(bins, "from_", "", &Bin::from);
  addTo(bins, "to", "", &Bin::to);
  addTo(bins, "mean", "", &Bin::mean);
  addTo(bins, "standard_error", "", &Bin::standard_error);
  addTo(bins, "rms", "", &Bin::rms);
  addTo(bins, "count", "", &Bin::count);
  return bins;
}

void bindTimeBins(py::module& module) {
  BinsClass<TimeBin> bins = bindBins<TimeBin>(
      module, "TimeBins", "Residual over stretches of time [s], with what b1 and b0 seem to be off by in each.");
  addTo(bins, "drive", "which of the drives, from 0", &TimeBin::record);
  addTo(bins, "damping_error", "to be added to b1 [1/s]", &TimeBin::damping_error);
  addTo(bins, "damping_error_stddev", "[1/s]", &TimeBin::damping_error_stddev);
  addTo(bins, "stiffness_error", "to be added to b0 [1/s^2]", &TimeBin::stiffness_error);
  addTo(bins, "stiffness_error_stddev", "[1/s^2]", &TimeBin::stiffness_error_stddev);
}

void bindParts(py::module& module) {
  ResultClass<ForceSurface>(module, "ForceSurface",
                            "Mean missing force over travel (rows) and travel rate (columns) [m/s^2].")
      .addArray("travel_edges", "[m], one more than rows", &ForceSurface::travel_edges)
      .addArray("rate_edges", "[m/s], one more than columns", &ForceSurface::rate_edges)
      .add("mean", "[m/s^2], (rows, columns)", &ForceSurface::mean)
      .add("standard_error", "of the mean [m/s^2]", &ForceSurface::standard_error)
      .add("rms", "of the residual [m/s^2]", &ForceSurface::rms)
      .add("count", "samples in each cell; where 0, the others say nothing", &ForceSurface::count)
      .add("explained_share", "", &ForceSurface::explained_share);
  ResultClass<ResidualSpectrum>(module, "ResidualSpectrum", "Power spectral densities, one-sided.")
      .addArray("frequency", "[Hz]", &ResidualSpectrum::frequency)
      .addArray("residual", "[(m/s^2)^2/Hz]", &ResidualSpectrum::residual)
      .addArray("measured", "of z'' [(m/s^2)^2/Hz]", &ResidualSpectrum::measured)
      .addArray("noise", "what the sensors' noise leaves [(m/s^2)^2/Hz]", &ResidualSpectrum::noise)
      .addArray("coherence", "of residual and w'', 0 .. 1", &ResidualSpectrum::coherence)
      .add("coherence_threshold", "", &ResidualSpectrum::coherence_threshold);
  ResultClass<ResidualCorrelation>(module, "ResidualCorrelation", "A correlation coefficient against lag.")
      .addArray("lag", "[s]", &ResidualCorrelation::lag)
      .addArray("value", "-1 .. 1", &ResidualCorrelation::value)
      .addArray("lower", "end of the 95 % band", &ResidualCorrelation::lower)
      .addArray("upper", "end of the 95 % band", &ResidualCorrelation::upper)
      .add("share_outside", "of the lags", &ResidualCorrelation::share_outside)
      .add("within", "no more lags outside than chance puts there", &ResidualCorrelation::within);
}

}  // namespace

void bindViews(py::module& module) {
  bindBins<ResidualBin>(module, "ResidualBins", "Mean missing force over ranges of travel [m] or rate [m/s].");
  bindTimeBins(module);
  bindParts(module);
  ResultClass<DirectionLoop>(module, "DirectionLoop", "Missing force against travel, apart for the two directions.")
      .add("compressing", "", &DirectionLoop::compressing)
      .add("extending", "", &DirectionLoop::extending)
      .add("gap", "[m/s^2]", &DirectionLoop::gap)
      .add("gap_standard_error", "[m/s^2]", &DirectionLoop::gap_standard_error)
      .add("area", "[m^2/s^2]", &DirectionLoop::area);
  ResultClass<ResidualViews>(module, "ResidualViews", "The residual seen from all sides.")
      .add("offset", "mean residual, taken off in all views [m/s^2]", &ResidualViews::offset)
      .add("offset_standard_error", "[m/s^2]", &ResidualViews::offset_standard_error)
      .add("rms", "of what is left [m/s^2]", &ResidualViews::rms)
      .add("num_samples", "", &ResidualViews::num_samples)
      .add("time", "", &ResidualViews::time)
      .add("travel", "", &ResidualViews::travel)
      .add("travel_rate", "", &ResidualViews::travel_rate)
      .add("surface", "", &ResidualViews::surface)
      .add("direction", "", &ResidualViews::direction)
      .add("spectrum", "None if no segment is long enough", &ResidualViews::spectrum)
      .add("whiteness", "residual against itself", &ResidualViews::whiteness)
      .add("cross_correlation", "residual against w''", &ResidualViews::cross_correlation);
}

}  // namespace suspension_health_monitor
