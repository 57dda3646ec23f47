// Who took part, how well they were tracked, and each one's own threshold, as tables.
#include "analysis/TableParts.h"

namespace heft {

Table flow_table(const Summary& summary) {
  Table table{"participant_flow",
              titled("Participants, from the first page to the figures", summary),
              {{"step", "step"}, {"n", "participants"}, {"meaning", "meaning"}},
              {},
              "how many were planned is not in a log"};
  const ParticipantFlow& flow = summary.flow;
  if (flow.n_asked == 0) return table;
  const auto add = [&](std::string step, int n, std::string meaning) {
    table.rows.push_back({word(std::move(step)), count(n), word(std::move(meaning))});
  };
  add("asked", flow.n_asked, "with a session in the log");
  add("declined", flow.n_declined, "did not agree to take part");
  add("started", flow.n_started, "began a trial");
  for (const auto& [state, n] : flow.unfinished)
    add("finished no session", n, "the last one is " + state);
  add("finished", flow.n_finished, "a session or more");
  for (const auto& [rule, n] : flow.excluded) add("left out", n, rule);
  add("analyzed", flow.n_analyzed, "in the figures");
  return table;
}

Table tracking_table(const Summary& summary) {
  Table table{"tracking_quality",
              titled("How well each participant's effector was tracked", summary),
              {{"participant", "participant"},
               {"in_view_percent", "in view % of the time"},
               {"n_lost", "times out of sight"},
               {"lost_s", "for s"},
               {"n_frames", "frames"},
               {"tracked_percent", "tracked %"},
               {"n_jumps", "jumps"},
               {"mean_quality", "mean quality"},
               {"n_pictures", "camera pictures"},
               {"n_dropped", "dropped"},
               {"n_late", "late"}},
              {},
              "time: from all cubes shown to the answer; frames: where they were kept; jumps: the "
              "effector came back or leapt, and the clone was put where it was"};
  for (const PersonTracking& person : summary.tracking) {
    const FrameCounts& frames = person.counts.frames;
    const auto of_frames = [&](int n) { return frames.n_frames > 0 ? count(n) : Cell(); };
    table.rows.push_back(
        {word(person.participant), number(person.in_view_percent()), count(person.counts.n_lost),
         number(person.counts.lost_s), of_frames(frames.n_frames), number(person.tracked_percent()),
         of_frames(frames.n_jumps), number(frames.mean_quality, 2), count(person.pictures.shown),
         count(person.pictures.dropped), count(person.pictures.late)});
  }
  return table;
}

namespace {
// "> 1136.2" for what is known to lie above.
Cell shown_jnd(const StartedFigure& figure) {
  if (!figure.jnd) return {};
  Cell cell = number(figure.jnd->value);
  cell.text = std::string(beyond_sign(figure.jnd->censored)) + cell.text;
  return cell;
}
}  // namespace

Table threshold_list(const Summary& summary) {
  Table table{"thresholds_by_participant",
              titled("Each participant's own threshold", summary),
              {{"reference_g", "reference g"},
               {"condition", "condition"},
               {"participant", "participant"},
               {"n_trials", "trials"},
               {"threshold_75_g", "threshold g"},
               {"low_g", "95 % low"},
               {"high_g", "high"},
               {"jnd_g", ""},
               {"censored", ""},
               {"start_above_g", "start g"},
               {"jnd_above_g", "its JND"},
               {"start_below_g", "from below g"},
               {"jnd_below_g", "its JND"},
               {"why", "no threshold, because"}},
              {},
              "the difference that is told rightly in 75 %, by this person's trials alone; the "
              "paper's JND of the staircases that began high and low beside, each with its start"};
  for (const PersonThreshold& person : summary.thresholds)
    table.rows.push_back(
        {mass(person.compared.reference_g), word(person.compared.condition),
         word(person.participant), count(person.n_trials), number(person.threshold_75_g),
         low(person.interval_g), high(person.interval_g),
         number(person.jnd ? std::optional(person.jnd->jnd_g) : std::nullopt),
         person.jnd && person.jnd->censored != Censored::none ? named_cell(person.jnd->censored)
                                                              : Cell(),
         number(person.from_above.start_g), shown_jnd(person.from_above),
         number(person.from_below.start_g), shown_jnd(person.from_below),
         word(in_short(person.why))});
  return table;
}

}  // namespace heft
