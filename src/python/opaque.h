#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "suspension_health_monitor/residual_views.h"

// Seen by every file that has to do with them: classes of their own in Python, not lists.
PYBIND11_MAKE_OPAQUE(std::vector<suspension_health_monitor::ResidualBin>)
PYBIND11_MAKE_OPAQUE(std::vector<suspension_health_monitor::TimeBin>)
