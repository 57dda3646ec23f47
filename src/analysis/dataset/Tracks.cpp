#include "analysis/dataset/Tracks.h"

#include <algorithm>
#include <tuple>

#include "psychophysics/ProcedureKinds.h"
#include "tasks/Comparison.h"
#include "tasks/Judgment.h"

namespace heft {

namespace {
// The track of an attempt's staircase, still without points, and the attempt's point.
struct Tracked {
  Track track;
  TrackPoint point;
};

std::optional<Tracked> compared_in(const Attempt& attempt) {
  const TrialRow& trial = attempt.trial;
  if (!trial.plan.reference_g) return std::nullopt;
  const bool chosen = trial.outcome == "difference";
  const bool wrong = chosen && trial.chosen_slot && *trial.plan.level_g != 0 &&
                     !trial.choice_correct.value_or(true);
  Tracked tracked{{trial.plan.staircase, {*trial.plan.reference_g, trial.plan.condition}, {}, {}},
                  {*trial.plan.level_g, wrong, chosen, attempt.is_reversal}};
  Track& track = tracked.track;
  track.answers = attempt.answers_offered;
  track.chooses_cube = track.answers != ComparisonAnswers::same_different;
  if (track.answers != ComparisonAnswers::heavier_or_none) track.compared.block = trial.plan.block;
  return tracked;
}

std::optional<Tracked> judged_in(const Attempt& attempt, const SessionData& data) {
  const TrialRow& trial = attempt.trial;
  const TrialPlan& plan = trial.plan;
  const auto asked = data.judgments.find(plan.block);
  if (asked == data.judgments.end() || !trial.value) return std::nullopt;
  const auto& [question, responses] = asked->second;
  Tracked tracked{{plan.staircase, {plan.reference_g.value_or(0), plan.condition}, {}, {}},
                  {*plan.level_g, false, false, attempt.is_reversal}};
  Track& track = tracked.track;
  track.compared.block = plan.block;
  track.question = question.key;
  track.chooses_cube = false;
  for (const auto& [answer, meaning] : responses) {
    if (meaning == Meaning::negative || meaning == Meaning::none) continue;
    track.positive.push_back(answer);
    track.chooses_cube = meaning != Meaning::positive;
  }
  const auto meaning = meaning_of(responses, Judgment::choice_of(question, *trial.value));
  tracked.point.chosen = meaning && meaning != Meaning::negative && meaning != Meaning::none;
  const bool is_reference = plan.reference_slot == (meaning == Meaning::left ? 1 : 2);
  tracked.point.wrong = tracked.point.chosen && track.chooses_cube && *plan.level_g != 0 &&
                        is_reference == (*plan.level_g > 0);
  return tracked;
}

// Constant stimuli have no course.
bool is_adaptive(const std::string& staircase, const SessionData& data) {
  if (!data.without_jnd.contains(staircase)) return true;
  const auto run = data.staircases.find(staircase);
  return run != data.staircases.end() && ProcedureKinds::estimates_level(*run->second.before);
}

std::optional<Tracked> tracked_in(const Attempt& attempt, const SessionData& data) {
  const TrialPlan& plan = attempt.trial.plan;
  if (!attempt.completed() || plan.staircase.empty() || !plan.level_g ||
      !is_adaptive(plan.staircase, data))
    return std::nullopt;
  std::optional<Tracked> tracked;
  if (plan.task == Comparison::task.name) tracked = compared_in(attempt);
  if (plan.task == Judgment::task.name) tracked = judged_in(attempt, data);
  if (tracked) tracked->track.has_estimate = !data.without_jnd.contains(plan.staircase);
  return tracked;
}

void add_point(std::vector<Track>& tracks, Tracked&& tracked) {
  auto track = std::ranges::find(tracks, tracked.track.staircase, &Track::staircase);
  if (track == tracks.end()) track = tracks.insert(tracks.end(), std::move(tracked.track));
  track->points.push_back(tracked.point);
}

std::vector<Track> tracks_of(const SessionData& data) {
  std::vector<Track> tracks;
  for (const Attempt& attempt : data.attempts)
    if (auto tracked = tracked_in(attempt, data)) add_point(tracks, std::move(*tracked));
  for (const std::string_view task : {Comparison::task.name, Judgment::task.name}) {
    StaircaseCollector staircases(task);
    staircases.add(data);
    for (const StaircaseResult& result : staircases.results())
      for (Track& track : tracks)
        if (track.staircase == result.staircase) {
          track.jnd_g = result.shown_g;
          track.censored = result.censored;
        }
  }
  std::ranges::sort(tracks, {},
                    [](const Track& track) { return std::tie(track.compared, track.staircase); });
  return tracks;
}
}  // namespace

void TracksCollector::add(const SessionData& data) {
  std::vector<Track> tracks = tracks_of(data);
  if (tracks.empty()) return;
  for (Track& track : tracks) track.points.shrink_to_fit();  // many tracks stay in memory
  all_.push_back({data.session.session_id, data.session.header.participant, data.simulated(),
                  data.finished(), std::move(tracks)});
}

void remove_estimates(std::vector<SessionTracks>& all, const Compared& compared) {
  const auto place = [](const Compared& of) {
    return std::tie(of.block, of.reference_g, of.condition);
  };
  for (SessionTracks& session : all)
    for (Track& track : session.tracks)
      if (place(track.compared) == place(compared)) track.jnd_g.reset();
}

const SessionTracks* example_of(const std::vector<SessionTracks>& all) {
  const auto finished = std::ranges::find(all, true, &SessionTracks::finished);
  if (finished != all.end()) return &*finished;
  return all.empty() ? nullptr : &all.front();
}

}  // namespace heft
