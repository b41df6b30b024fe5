#include <pybind11/eigen.h>

#include "bindings.h"
#include "suspension_health_monitor/residual_views.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

template <class Bin>
using BinsClass = ResultClass<std::vector<Bin>>;

/// Bins: of each field an array, one entry per bin.
template <class Bin>
void bindBins(py::module& module, const char* class_name, const char* text) {
  BinsClass<Bin> bins(module, class_name, text);
  bins.def("__len__", [](const std::vector<Bin>& self) { return self.size(); });
  boost::hana::for_each(boost::hana::accessors<Bin>(), [&](const auto& field) {
    const std::string_view name = boost::hana::to<const char*>(boost::hana::first(field));
    bins.addColumn(
        name == "from" ? "from_" : name.data(),  // from is a keyword of Python
        [](const std::vector<Bin>& self) -> const auto& { return self; }, boost::hana::second(field));
  });
}

}  // namespace

void bindViews(py::module& module) {
  bindBins<ResidualBin>(module, "ResidualBins", "Mean missing force over ranges of travel [m] or rate [m/s].");
  bindBins<TimeBin>(module, "TimeBins",
                    "Residual over stretches of time [s], with what b1 and b0 seem to be off by in each.");
  ResultClass<ForceSurface>(module, "ForceSurface",
                            "Mean missing force over travel (rows) and travel rate (columns) [m/s^2].");
  ResultClass<ResidualSpectrum>(module, "ResidualSpectrum", "Power spectral densities, one-sided.");
  ResultClass<ResidualCorrelation>(module, "ResidualCorrelation", "A correlation coefficient against lag.");
  ResultClass<DirectionLoop>(module, "DirectionLoop", "Missing force against travel, apart for the two directions.");
  ResultClass<ResidualViews>(module, "ResidualViews", "The residual seen from all sides.");
}

}  // namespace suspension_health_monitor
