#pragma once

#include <gtest/gtest.h>

#include "paper_drive.h"
#include "suspension_health_monitor/internal/model/free_run.h"

namespace suspension_health_monitor {

constexpr double kPaperPeriod = 0.02;  // [s]

// Of the paper's model at this period: (sqrt(b0) T)^4 / 24 = 1.3e-6 per unit of w''.
constexpr double kPaperStepError = 1.5e-6;

inline FreeRun paperFreeRun() {
  FreeRun run(kPaperPeriod);
  EXPECT_TRUE(run.trySetModel(kPaperB1, kPaperB0));
  return run;
}

}  // namespace suspension_health_monitor
