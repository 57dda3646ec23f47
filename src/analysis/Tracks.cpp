#include "analysis/Tracks.h"

#include <algorithm>
#include <tuple>

#include "analysis/Jnd.h"

namespace heft {

namespace {
Track& track_of(std::vector<Track>& tracks, const TrialPlan& plan) {
  const auto found = std::ranges::find(tracks, plan.staircase, &Track::staircase);
  if (found != tracks.end()) return *found;
  return tracks.emplace_back(Track{plan.staircase, *plan.reference_g, {}, {}});
}

std::vector<Track> tracks_of(const SessionData& data) {
  std::vector<Track> tracks;
  for (const Attempt& attempt : data.attempts) {
    const TrialPlan& plan = attempt.trial.plan;
    if (!attempt.completed() || plan.staircase.empty() || !plan.reference_g || !plan.level_g ||
        data.without_jnd.contains(plan.staircase))
      continue;
    track_of(tracks, plan)
        .points.push_back({*plan.level_g,
                           attempt.trial.outcome == Outcome::difference && *plan.level_g != 0 &&
                               !attempt.trial.choice_correct.value_or(true),
                           attempt.trial.outcome == Outcome::difference, attempt.is_reversal});
  }
  for (const StaircaseResult& result : staircase_results({&data, 1}))
    for (Track& track : tracks)
      if (track.staircase == result.staircase) {
        track.jnd_g = result.shown_g;
        track.censored = result.censored;
      }
  std::ranges::sort(
      tracks, {}, [](const Track& track) { return std::tie(track.reference_g, track.staircase); });
  return tracks;
}
}  // namespace

std::vector<SessionTracks> all_tracks(std::span<const SessionData> sessions) {
  std::vector<SessionTracks> all;
  for (const SessionData& data : sessions)
    if (std::vector<Track> tracks = tracks_of(data); !tracks.empty())
      all.push_back({data.session.session_id, data.session.header.participant, data.simulated(),
                     std::move(tracks)});
  return all;
}

std::optional<SessionTracks> example_tracks(std::span<const SessionData> sessions) {
  std::optional<SessionTracks> unfinished;
  for (const SessionData& data : sessions) {
    if (unfinished && !data.finished()) continue;
    std::vector<Track> tracks = tracks_of(data);
    if (tracks.empty()) continue;
    SessionTracks found{data.session.session_id, data.session.header.participant, data.simulated(),
                        std::move(tracks)};
    if (data.finished()) return found;
    unfinished = std::move(found);
  }
  return unfinished;
}

}  // namespace heft
