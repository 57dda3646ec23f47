#include "analysis/dataset/Tracks.h"

#include <algorithm>
#include <tuple>

namespace heft {

namespace {
Track& track_of(std::vector<Track>& tracks, const TrialPlan& plan) {
  const auto found = std::ranges::find(tracks, plan.staircase, &Track::staircase);
  if (found != tracks.end()) return *found;
  return tracks.emplace_back(Track{plan.staircase, {*plan.reference_g, plan.condition}, {}, {}});
}

std::vector<Track> tracks_of(const SessionData& data) {
  std::vector<Track> tracks;
  for (const Attempt& attempt : data.attempts) {
    const TrialPlan& plan = attempt.trial.plan;
    if (!attempt.completed() || plan.task != "comparison" || plan.staircase.empty() ||
        !plan.reference_g || !plan.level_g || data.without_jnd.contains(plan.staircase))
      continue;
    track_of(tracks, plan)
        .points.push_back({*plan.level_g,
                           attempt.trial.outcome == "difference" && *plan.level_g != 0 &&
                               !attempt.trial.choice_correct.value_or(true),
                           attempt.trial.outcome == "difference", attempt.is_reversal});
  }
  StaircaseFold staircases;
  staircases.add(data);
  for (const StaircaseResult& result : staircases.results())
    for (Track& track : tracks)
      if (track.staircase == result.staircase) {
        track.jnd_g = result.shown_g;
        track.censored = result.censored;
      }
  std::ranges::sort(tracks, {},
                    [](const Track& track) { return std::tie(track.compared, track.staircase); });
  return tracks;
}
}  // namespace

void TracksFold::add(const SessionData& data) {
  std::vector<Track> tracks = tracks_of(data);
  if (tracks.empty()) return;
  for (Track& track : tracks) track.points.shrink_to_fit();  // of a thousand, what is spare is much
  all_.push_back({data.session.session_id, data.session.header.participant, data.simulated(),
                  data.finished(), std::move(tracks)});
}

const SessionTracks* example_of(const std::vector<SessionTracks>& all) {
  const auto finished = std::ranges::find(all, true, &SessionTracks::finished);
  if (finished != all.end()) return &*finished;
  return all.empty() ? nullptr : &all.front();
}

}  // namespace heft
