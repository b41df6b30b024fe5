#pragma once

#include <suspension_health_monitor/Diagnose.h>

#include "suspension_health_monitor/discrepancy/body_motion.h"
#include "suspension_health_monitor/discrepancy/effect_search.h"
#include "suspension_health_monitor/discrepancy/search_drives.h"

namespace suspension_health_monitor {

/// What a live search works on.
struct SearchTask {
  DriveSamples samples;
  std::vector<BodyMotion> body;  ///< what else the body's IMU measured meanwhile
  MonitorOptions options;        ///< with sample_period given
  EffectLibrary library;
  std::optional<StrutModel> model;  ///< whose effects stay; nothing: the linear strut
};

/// What it found, and in which samples.
struct Diagnosis {
  SearchResult result;
  Stamp from{}, to{};
};

/// Searches one drive for the effects that a model lacks, as `suspension_bag diagnose` does.
/// @param progress  called in the calling thread now and then; what it throws ends the search.
/// @throws std::runtime_error  in words for people, if the samples are too short or too poor.
Diagnosis searchEffects(const SearchTask& task, const SearchOptions& options, const EffectSearch::Progress& progress);

/// The answer of ~diagnose: the whole result as plain fields.
DiagnoseResponse toResponse(const SearchResult& result);

}  // namespace suspension_health_monitor
