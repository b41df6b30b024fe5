#include <pybind11/eigen.h>

#include "bindings.h"
#include "suspension_health_monitor/residual_views.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

/// Bins as arrays, one entry per bin.
template <class Bin>
py::class_<std::vector<Bin>> bindBins(py::module& module, const char* class_name, const char* text) {
  py::class_<std::vector<Bin>> bins(module, class_name, text);
  const auto add = [&](const char* name, auto member) {
    bins.def_property_readonly(name, [member](const std::vector<Bin>& self) {
      return arrayOf(self, [member](const Bin& bin) { return bin.*member; });
    });
  };
  bins.def("__len__", [](const std::vector<Bin>& self) { return self.size(); });
  add("from_", &Bin::from);
  add("to", &Bin::to);
  add("mean", &Bin::mean);
  add("standard_error", &Bin::standard_error);
  add("rms", &Bin::rms);
  add("count", &Bin::count);
  return bins;
}

void bindTimeBins(py::module& module) {
  py::class_<std::vector<TimeBin>> bins = bindBins<TimeBin>(
      module, "TimeBins", "Residual over stretches of time [s], with what b1 and b0 seem to be off by in each.");
  const auto add = [&](const char* name, auto member, const char* text) {
    bins.def_property_readonly(
        name,
        [member](const std::vector<TimeBin>& self) {
          return arrayOf(self, [member](const TimeBin& bin) { return bin.*member; });
        },
        text);
  };
  add("drive", &TimeBin::record, "which of the drives, from 0");
  add("damping_error", &TimeBin::damping_error, "to be added to b1 [1/s]");
  add("damping_error_stddev", &TimeBin::damping_error_stddev, "[1/s]");
  add("stiffness_error", &TimeBin::stiffness_error, "to be added to b0 [1/s^2]");
  add("stiffness_error_stddev", &TimeBin::stiffness_error_stddev, "[1/s^2]");
}

void bindSurface(py::module& module) {
  py::class_<ForceSurface> surface(module, "ForceSurface",
                                   "Mean missing force over travel (rows) and travel rate (columns) [m/s^2].");
  defArray(surface, "travel_edges", &ForceSurface::travel_edges, "[m], one more than rows");
  defArray(surface, "rate_edges", &ForceSurface::rate_edges, "[m/s], one more than columns");
  surface.def_readonly("mean", &ForceSurface::mean, "[m/s^2], (rows, columns)")
      .def_readonly("standard_error", &ForceSurface::standard_error, "of the mean [m/s^2]")
      .def_readonly("rms", &ForceSurface::rms, "of the residual [m/s^2]")
      .def_readonly("count", &ForceSurface::count, "samples in each cell; where 0, the others say nothing")
      .def_readonly("explained_share", &ForceSurface::explained_share);
}

void bindFrequency(py::module& module) {
  py::class_<ResidualSpectrum> spectrum(module, "ResidualSpectrum", "Power spectral densities, one-sided.");
  defArray(spectrum, "frequency", &ResidualSpectrum::frequency, "[Hz]");
  defArray(spectrum, "residual", &ResidualSpectrum::residual, "[(m/s^2)^2/Hz]");
  defArray(spectrum, "measured", &ResidualSpectrum::measured, "of z'' [(m/s^2)^2/Hz]");
  defArray(spectrum, "noise", &ResidualSpectrum::noise, "what the sensors' noise leaves [(m/s^2)^2/Hz]");
  defArray(spectrum, "coherence", &ResidualSpectrum::coherence, "of residual and w'', 0 .. 1");
  spectrum.def_readonly("coherence_threshold", &ResidualSpectrum::coherence_threshold);
  py::class_<ResidualCorrelation> correlation(module, "ResidualCorrelation", "A correlation coefficient against lag.");
  defArray(correlation, "lag", &ResidualCorrelation::lag, "[s]");
  defArray(correlation, "value", &ResidualCorrelation::value, "-1 .. 1");
  defArray(correlation, "lower", &ResidualCorrelation::lower, "end of the 95 % band");
  defArray(correlation, "upper", &ResidualCorrelation::upper, "end of the 95 % band");
  correlation.def_readonly("share_outside", &ResidualCorrelation::share_outside, "of the lags")
      .def_readonly("within", &ResidualCorrelation::within, "no more lags outside than chance puts there");
}

}  // namespace

void bindViews(py::module& module) {
  bindBins<ResidualBin>(module, "ResidualBins", "Mean missing force over ranges of travel [m] or rate [m/s].");
  bindTimeBins(module);
  bindSurface(module);
  bindFrequency(module);
  py::class_<DirectionLoop>(module, "DirectionLoop", "Missing force against travel, apart for the two directions.")
      .def_readonly("compressing", &DirectionLoop::compressing)
      .def_readonly("extending", &DirectionLoop::extending)
      .def_readonly("gap", &DirectionLoop::gap, "[m/s^2]")
      .def_readonly("gap_standard_error", &DirectionLoop::gap_standard_error, "[m/s^2]")
      .def_readonly("area", &DirectionLoop::area, "[m^2/s^2]");
  py::class_<ResidualViews>(module, "ResidualViews", "The residual seen from all sides.")
      .def_readonly("offset", &ResidualViews::offset, "mean residual, taken off in all views [m/s^2]")
      .def_readonly("offset_standard_error", &ResidualViews::offset_standard_error, "[m/s^2]")
      .def_readonly("rms", &ResidualViews::rms, "of what is left [m/s^2]")
      .def_readonly("num_samples", &ResidualViews::num_samples)
      .def_readonly("time", &ResidualViews::time)
      .def_readonly("travel", &ResidualViews::travel)
      .def_readonly("travel_rate", &ResidualViews::travel_rate)
      .def_readonly("surface", &ResidualViews::surface)
      .def_readonly("direction", &ResidualViews::direction)
      .def_readonly("spectrum", &ResidualViews::spectrum, "None if no segment is long enough")
      .def_readonly("whiteness", &ResidualViews::whiteness, "residual against itself")
      .def_readonly("cross_correlation", &ResidualViews::cross_correlation, "residual against w''");
}

}  // namespace suspension_health_monitor
