#include "analysis/Json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace heft {

namespace {
using nlohmann::ordered_json;

ordered_json number_json(std::optional<double> value) {
  return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json low_json(const std::optional<Interval>& interval) {
  return interval ? number_json(interval->low) : ordered_json(nullptr);
}

ordered_json high_json(const std::optional<Interval>& interval) {
  return interval ? number_json(interval->high) : ordered_json(nullptr);
}

ordered_json proportion_json(const Proportion& proportion) {
  const bool any = proportion.method != IntervalMethod::none;
  return {{"mean", number_json(proportion.mean_percent)},
          {"sd", number_json(proportion.sd_percent)},
          {"low", low_json(proportion.interval_percent)},
          {"high", high_json(proportion.interval_percent)},
          {"published", number_json(proportion.published_percent)},
          {"published_sd", number_json(proportion.published_sd_percent)},
          {"interval", any ? ordered_json(name_of(proportion.method)) : ordered_json(nullptr)},
          {"pooled", number_json(proportion.pooled_percent)},
          {"n_participants", proportion.n_participants},
          {"n_hits", proportion.trials.n_hits},
          {"n_trials", proportion.trials.n_trials}};
}

ordered_json rate_json(const Rate& rate) {
  return {{"percent", number_json(rate.percent)},
          {"low", low_json(rate.interval_percent)},
          {"high", high_json(rate.interval_percent)},
          {"n_hits", rate.trials.n_hits},
          {"n_trials", rate.trials.n_trials}};
}

ordered_json swaps_json(const ConditionSorting& sorting) {
  ordered_json json = ordered_json::object();
  for (std::size_t i = 0; i < sorting.swaps.size(); ++i)
    json[std::string(EnumNames<Swap>::names.at(i))] = sorting.swaps.at(i);
  return json;
}

ordered_json sorting_json(const ConditionSorting& sorting) {
  return {{"correct", proportion_json(sorting.correct)},
          {"incorrect", proportion_json(sorting.incorrect)},
          {"none", proportion_json(sorting.none)},
          {"answered",
           {{"correct", proportion_json(sorting.answered_correct)},
            {"incorrect", proportion_json(sorting.answered_incorrect)}}},
          {"chance", number_json(sorting.chance_percent())},
          {"swapped", swaps_json(sorting)},
          {"n_trials", sorting.n_trials},
          {"n_participants", sorting.n_participants}};
}

ordered_json introduction_json(const IntroductionSummary& introduction) {
  const Rate& rate = introduction.first_try;
  return {{"first_try",
           {{"percent", number_json(rate.percent)},
            {"low", low_json(rate.interval_percent)},
            {"high", high_json(rate.interval_percent)},
            {"published", number_json(introduction.published_percent)},
            {"published_n", introduction.published_n ? ordered_json(*introduction.published_n)
                                                     : ordered_json(nullptr)}}},
          {"n_first_try", rate.trials.n_hits},
          {"n_participants", rate.trials.n_trials}};
}

ordered_json participants_json(const ReferenceJnd& jnd) {
  ordered_json participants = ordered_json::array();
  for (const ParticipantJnd& one : jnd.participants) {
    const bool exact = one.censored == Censored::none;
    participants.push_back(
        {{"participant", one.participant},
         {"jnd_g", number_json(one.jnd_g)},
         {"censored", exact ? ordered_json(nullptr) : ordered_json(name_of(one.censored))}});
  }
  for (const std::string& one : jnd.missing)
    participants.push_back({{"participant", one}, {"jnd_g", nullptr}, {"censored", "missing"}});
  return participants;
}

ordered_json started_json(const std::optional<StartEffect>& starts,
                          StartedJnds StartEffect::*which) {
  if (!starts) return nullptr;
  const StartedJnds& jnds = (*starts).*which;
  return {{"mean_g", number_json(jnds.mean)},
          {"sd_g", number_json(jnds.sd)},
          {"low_g", low_json(jnds.interval)},
          {"high_g", high_json(jnds.interval)},
          {"summary",
           jnds.kind == MeanKind::none ? ordered_json(nullptr) : ordered_json(name_of(jnds.kind))},
          {"n", jnds.n()},
          {"n_censored_above", jnds.n_censored(Censored::above)},
          {"n_censored_below", jnds.n_censored(Censored::below)},
          {"n_missing", jnds.n_missing}};
}

ordered_json jnd_json(const ReferenceJnd& jnd) {
  const bool any = jnd.n_staircases > 0;
  const auto of_any = [any](auto value) {
    return any ? ordered_json(value) : ordered_json(nullptr);
  };
  return {{"reference_g", number_json(jnd.compared.reference_g)},
          {"condition", jnd.compared.condition},
          {"method", jnd.compared.method},
          {"mean_g", number_json(jnd.mean_g)},
          {"sd_g", number_json(jnd.sd_g)},
          {"low_g", low_json(jnd.interval_g)},
          {"high_g", high_json(jnd.interval_g)},
          {"from_above", started_json(jnd.starts, &StartEffect::from_above_g)},
          {"from_below", started_json(jnd.starts, &StartEffect::from_below_g)},
          {"above_minus_below", started_json(jnd.starts, &StartEffect::difference_g)},
          {"published_g", number_json(jnd.published_g)},
          {"published_sd_g", number_json(jnd.published_sd_g)},
          {"summary", jnd.summary == MeanKind::none ? ordered_json(nullptr)
                                                    : ordered_json(name_of(jnd.summary))},
          {"n", jnd.n()},
          {"n_censored_above", jnd.n_censored(Censored::above)},
          {"n_censored_below", jnd.n_censored(Censored::below)},
          {"n_missing", jnd.missing.size()},
          {"n_participants", jnd.participants.size()},
          {"participants", participants_json(jnd)},
          {"trials",
           {{"mean", of_any(jnd.mean_trials)},
            {"least", of_any(jnd.least_trials)},
            {"most", of_any(jnd.most_trials)}}},
          {"n_staircases", jnd.n_staircases},
          {"n_unfinished", jnd.n_unfinished},
          {"n_without_estimate", jnd.n_without_estimate},
          {"n_trial_limit", jnd.n_trial_limit},
          {"n_floor", jnd.n_floor},
          {"n_floor_staircases", jnd.n_floor_staircases},
          {"n_ceiling", jnd.n_ceiling},
          {"n_ceiling_staircases", jnd.n_ceiling_staircases}};
}

ordered_json sensitivity_json(const ReferenceSensitivity& row) {
  const PooledSensitivity& pooled = row.pooled;
  return {{"reference_g", number_json(row.compared.reference_g)},
          {"condition", row.compared.condition},
          {"n", pooled.n},
          {"n_trials", static_cast<int>(pooled.n_trials)},
          {"identifiable", pooled.identifiable()},
          {"why", pooled.identifiable() ? ordered_json(nullptr) : ordered_json(pooled.why)},
          {"threshold_75_g", number_json(pooled.threshold_75_g)},
          {"low_g", low_json(pooled.threshold_interval_g)},
          {"high_g", high_json(pooled.threshold_interval_g)},
          {"sensitivity_per_g", number_json(pooled.sensitivity)},
          {"sensitivity_low_per_g", low_json(pooled.sensitivity_interval)},
          {"sensitivity_high_per_g", high_json(pooled.sensitivity_interval)},
          {"indecision", number_json(pooled.indecision)},
          {"indecision_low", low_json(pooled.indecision_interval)},
          {"indecision_high", high_json(pooled.indecision_interval)}};
}

ordered_json quality_json(const Quality& quality) {
  ordered_json counted = ordered_json::array(), losses = ordered_json::array(),
               resets = ordered_json::array();
  for (const CountedRow& row : quality.counted)
    counted.push_back({{"what", row.what},
                       {"n", row.n},
                       {"of", row.of ? ordered_json(*row.of) : ordered_json(nullptr)}});
  for (const LossRow& row : quality.losses)
    losses.push_back({{"task", name_of(row.task)},
                      {"condition", row.condition},
                      {"difference", row.difference},
                      {"n_attempts", row.n_attempts},
                      {"n_void", row.n_void},
                      {"n_lost", row.n_lost},
                      {"lost_s", number_json(row.lost_s)},
                      {"n_impossible", row.n_impossible}});
  for (const ResetRow& row : quality.resets)
    resets.push_back({{"mass", row.mass}, {"n_cubes", row.n_cubes}, {"n_reset", row.n_reset}});
  return {{"counted_first", counted}, {"losses", losses}, {"resets", resets}};
}

ordered_json hypotheses_json(const Summary& summary) {
  ordered_json json = ordered_json::object();
  for (const Hypothesis& hypothesis : summary.hypotheses)
    json[hypothesis.name] = {{"verdict", name_of(hypothesis.verdict)},
                             {"declared", hypothesis.declared},
                             {"why", hypothesis.why},
                             {"statement", hypothesis.statement},
                             {"figures", hypothesis.figures}};
  return json;
}

ordered_json choices_json(const ComparisonChoices& choices) {
  ordered_json json;
  json["reference_g"] = number_json(choices.reference_g);
  if (choices.level_g) json["level_g"] = number_json(choices.level_g);
  json["n_trials"] = choices.n_trials;
  json["difference"] = rate_json(choices.difference);
  json["wrong_cube"] = rate_json(choices.wrong_cube);
  if (choices.level_g) return json;
  json["false_alarm"] = rate_json(choices.false_alarm);
  json["at_zero"] = rate_json(choices.at_zero);
  return json;
}

ordered_json times_json(const ResponseTimes& times) {
  return {{"task", name_of(times.task)},
          {"condition", times.condition},
          {"n_trials", times.n_trials},
          {"median_s", number_json(times.median_s)},
          {"lower_quartile_s", number_json(times.lower_quartile_s)},
          {"upper_quartile_s", number_json(times.upper_quartile_s)}};
}

ordered_json session_json(const SessionSummary& session) {
  return {{"session_id", session.session_id},
          {"participant", session.participant},
          {"protocol", session.protocol},
          {"purpose", session.purpose},
          {"responder", session.responder},
          {"state", name_of(session.state)},
          {"n_completed", session.n_completed},
          {"n_void", session.n_void},
          {"n_open", session.n_open}};
}

template <typename Rows, typename Convert>
ordered_json array_of(const Rows& rows, Convert convert) {
  ordered_json array = ordered_json::array();
  for (const auto& row : rows) array.push_back(convert(row));
  return array;
}

ordered_json participant_json(const ParticipantRow& row) {
  return {{"participant", row.participant},
          {"n_sessions", row.n_sessions},
          {"n_finished", row.n_finished},
          {"n_completed", row.n_completed},
          {"n_impossible", row.n_impossible},
          {"excluded_because", row.excluded() ? ordered_json(row.excluded_because) : nullptr}};
}

ordered_json flow_json(const ParticipantFlow& flow) {
  return {{"n_asked", flow.n_asked},       {"n_declined", flow.n_declined},
          {"n_started", flow.n_started},   {"n_finished", flow.n_finished},
          {"n_analyzed", flow.n_analyzed}, {"excluded", flow.excluded},
          {"unfinished", flow.unfinished}};
}

ordered_json threshold_json(const PersonThreshold& person) {
  return {{"reference_g", number_json(person.compared.reference_g)},
          {"condition", person.compared.condition},
          {"participant", person.participant},
          {"identifiable", person.identifiable()},
          {"why", person.identifiable() ? ordered_json(nullptr) : ordered_json(person.why)},
          {"threshold_75_g", number_json(person.threshold_75_g)},
          {"low_g", low_json(person.interval_g)},
          {"high_g", high_json(person.interval_g)}};
}

ordered_json tracking_json(const PersonTracking& person) {
  const FrameCounts& frames = person.counts.frames;
  return {{"participant", person.participant},
          {"in_view_percent", number_json(person.in_view_percent())},
          {"n_lost", person.counts.n_lost},
          {"n_frames", frames.n_frames},
          {"tracked_percent", number_json(person.tracked_percent())},
          {"n_jumps", frames.n_jumps},
          {"mean_quality", number_json(frames.mean_quality)}};
}

ordered_json comparison_json(const ComparisonSummary& comparison) {
  return {{"wrong_cube", rate_json(comparison.wrong_cube)},
          {"false_alarm", rate_json(comparison.false_alarm)},
          {"at_zero", rate_json(comparison.at_zero)},
          {"by_reference", array_of(comparison.by_reference, choices_json)},
          {"by_level", array_of(comparison.by_level, choices_json)}};
}
}  // namespace

std::string as_json(const Summary& summary) {
  const ConditionSorting &c1 = summary.sorting.at(0), &c2 = summary.sorting.at(1);
  const auto void_json = [](const VoidCount& count) -> ordered_json {
    return {{"reason", count.reason}, {"n", count.n}};
  };
  const ordered_json json{
      {"made_by", "heft analyse"},
      {"heft_version", HEFT_VERSION},
      {"command", summary.command},
      {"database", summary.database},
      {"simulated", summary.simulated()},
      {"data", summary.data.empty() ? ordered_json(nullptr) : ordered_json(summary.data)},
      {"confidence", confidence_level},
      {"n_sessions", summary.sessions.size()},
      {"n_participants", summary.n_participants},
      {"analysis", summary.plan ? "declared" : "exploratory"},
      {"n_excluded", std::ranges::count_if(summary.participants, &ParticipantRow::excluded)},
      {"participants", array_of(summary.participants, participant_json)},
      {"participant_flow", flow_json(summary.flow)},
      {"introduction", introduction_json(summary.introduction)},
      {"sorting", {{"C1", sorting_json(c1)}, {"C2", sorting_json(c2)}}},
      {"jnd", array_of(summary.jnd, jnd_json)},
      {"sensitivity", array_of(summary.sensitivity, sensitivity_json)},
      {"thresholds", array_of(summary.thresholds, threshold_json)},
      {"comparison", comparison_json(summary.comparison)},
      {"response_times", array_of(summary.times, times_json)},
      {"voids", array_of(summary.voids, void_json)},
      {"hypotheses", hypotheses_json(summary)},
      {"quality", quality_json(summary.quality)},
      {"tracking", array_of(summary.tracking, tracking_json)},
      {"notes", summary.notes},
      {"sessions", array_of(summary.sessions, session_json)}};
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace heft
