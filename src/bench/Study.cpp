#include "bench/Study.h"

#include <array>

#include "base/PlugTable.h"
#include "bench/physics/PhysicsStudy.h"
#include "bench/pipeline/PipelineStudy.h"
#include "bench/tracking/TrackingStudy.h"

namespace heft {

namespace {
constexpr auto table = std::to_array<StudyEntry>({
    {"physics", "simulators: error against CPU time, where they fail, input, lag against mass",
     run_physics_study},
    {"tracking", "trackers: error against time, where they fail, filters' jitter against lag",
     run_tracking_study},
    {"effectors", "the shipped effectors over random grips: how many faces they show, how exactly",
     run_effector_study},
    {"pipeline", "what each stage of a picture costs, and memory over an hour", run_pipeline_study},
});
}  // namespace

std::span<const StudyEntry> studies() {
  return table;
}

const StudyEntry& study_named(std::string_view name) {
  return entry_named("study", name, studies());
}

}  // namespace heft
