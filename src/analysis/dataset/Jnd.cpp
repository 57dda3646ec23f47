#include "analysis/dataset/Jnd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "analysis/dataset/Dataset.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Judgment.h"

namespace heft {

namespace {
// Reference, technique and method of each of a session's staircases that estimate a JND, from its
// trials. One that did not finish has not logged its method: most likely it is the paper's.
std::map<std::string, Compared> compared_by(const SessionData& data, std::string_view task) {
  std::map<std::string, Compared> staircases;
  const bool is_judgment = task == Judgment::task.name;
  for (const Attempt& attempt : data.attempts) {
    const TrialPlan& plan = attempt.trial.plan;
    if (plan.task != task || plan.staircase.empty() || !(plan.reference_g || is_judgment) ||
        data.without_jnd.contains(plan.staircase))
      continue;
    Compared compared{plan.reference_g.value_or(0), plan.condition};
    if (is_judgment) compared.block = plan.block;
    staircases.emplace(plan.staircase, std::move(compared));
  }
  for (auto row = data.estimates.rbegin(); row != data.estimates.rend(); ++row)  // keeps the first
    if (const auto found = staircases.find(row->staircase); found != staircases.end())
      found->second.method = row->method;
  return staircases;
}

// None for an infinite JND, which a damaged log may contain.
std::optional<double> finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// The levels of a staircase's completed trials, in order.
struct Course {
  std::vector<double> levels_g;

  double lowest() const { return levels_g.empty() ? 0 : *std::ranges::min_element(levels_g); }
  double highest() const { return levels_g.empty() ? 0 : *std::ranges::max_element(levels_g); }
};

std::map<std::string, Course> courses_of(const SessionData& data) {
  std::map<std::string, Course> courses;
  for (const Attempt& attempt : data.attempts) {
    const TrialPlan& plan = attempt.trial.plan;
    if (!attempt.completed() || plan.staircase.empty() || !plan.level_g) continue;
    courses[plan.staircase].levels_g.push_back(*plan.level_g);
  }
  return courses;
}

// Direction of an indeterminate staircase: towards the bound that it hit, or from its first to its
// last level.
Censored direction_of(const EstimateRow& row, const Course& course) {
  if ((row.n_ceiling > 0) != (row.n_floor > 0))
    return row.n_ceiling > 0 ? Censored::above : Censored::below;
  if (row.n_ceiling > 0 || course.levels_g.empty()) return Censored::indeterminate;
  const double first_g = course.levels_g.front(), last_g = course.levels_g.back();
  if (first_g == last_g) return Censored::indeterminate;
  return last_g > first_g ? Censored::above : Censored::below;
}

// JND of a posterior distribution: missing if it is not identifiable; if it is censored, one end of
// its interval is known.
void judge_posterior(StaircaseResult& result) {
  if (result.censored == Censored::none) {
    result.shown_g = result.jnd_g;
  } else {
    result.why = result.censored == Censored::above   ? "beyond the largest threshold of the grid"
                 : result.censored == Censored::below ? "below the smallest threshold of the grid"
                                                      : "not identifiable";
    result.shown_g = result.censored == Censored::above ? result.low_g : result.high_g;
  }
}

std::string why_censored(const EstimateRow& row, Censored censored) {
  if (censored == Censored::above) return "at the ceiling";
  if (censored == Censored::below) return "at the floor";
  if (row.method != jnd_method) return censored == Censored::indeterminate ? "indeterminate" : "";
  if (row.n_reversals < least_reversals) return fmt::format("{} reversals", row.n_reversals);
  if (row.reason == StopReason::trials) return "trial limit";
  return censored == Censored::indeterminate ? "at both bounds" : "";
}

void judge(StaircaseResult& result, const EstimateRow& row, const Course& course) {
  result.start_g = course.levels_g.empty() ? 0 : course.levels_g.front();
  result.censored = row.censored.value_or(Censored::none);
  if (ProcedureKinds::is_bayesian(row.method)) return judge_posterior(result);
  result.why = why_censored(row, result.censored);
  if (result.why.empty()) {
    result.shown_g = result.jnd_g;
    return;
  }
  if (result.censored == Censored::none || result.censored == Censored::indeterminate)
    result.censored = direction_of(row, course);
  if (result.censored == Censored::indeterminate) return;
  const bool above = result.censored == Censored::above;
  if (result.jnd_g || !course.levels_g.empty())
    result.shown_g = result.jnd_g.value_or(above ? course.highest() : course.lowest());
}

std::vector<StaircaseResult> results_of(const SessionData& data, std::string_view task) {
  const auto staircases = compared_by(data, task);
  auto courses = courses_of(data);
  std::vector<StaircaseResult> results;
  for (const EstimateRow& row : data.estimates) {
    const auto compared = staircases.find(row.staircase);
    if (compared == staircases.end() || row.method != compared->second.method) continue;
    StaircaseResult result{
        data.session.session_id, data.participant(), row.staircase,      compared->second,
        finite(row.jnd_g),       finite(row.low_g),  finite(row.high_g), row.n_trials,
        row.n_reversals,         row.n_floor,        row.n_ceiling,      row.reason};
    judge(result, row, courses[row.staircase]);
    results.push_back(std::move(result));
  }
  return results;
}

using Began = StaircaseCollector::Began;
using AboveAndBelow = StaircaseCollector::AboveAndBelow;
using Results = std::vector<const StaircaseResult*>;

JndFigure figure_of(const StaircaseResult& result) {
  JndFigure figure{censored_value(result), std::nullopt};
  if (result.jnd_g) figure.as_logged = CensoredValue{*result.jnd_g};
  return figure;
}

std::optional<CensoredValue> mean_of(std::span<const JndFigure> parts,
                                     std::optional<CensoredValue> JndFigure::*which,
                                     bool leave_out_unknown) {
  std::vector<std::optional<CensoredValue>> values;
  for (const JndFigure& part : parts)
    if (part.*which || !leave_out_unknown) values.push_back(part.*which);
  return mean_figure(values);
}

JndFigure mean_of(std::span<const JndFigure> parts, bool leave_out_unknown = false) {
  return {mean_of(parts, &JndFigure::censored, leave_out_unknown),
          mean_of(parts, &JndFigure::as_logged, leave_out_unknown)};
}

// Means over the staircases of each session, then over a participant's sessions, so that a
// participant counts once. Staircases that began without a result are unknown. Sessions without a
// figure are ignored where another one has one.
Jnds overall_of(const Results& results, const Began& began) {
  Jnds jnds;
  for (const auto& [participant, sessions] : began) {
    std::vector<JndFigure> of_sessions;
    for (const auto& [session_id, n_began] : sessions) {
      std::vector<JndFigure> figures;
      for (const StaircaseResult* result : results)
        if (result->participant == participant && result->session_id == session_id)
          figures.push_back(figure_of(*result));
      figures.resize(std::max(figures.size(), static_cast<std::size_t>(n_began)));
      of_sessions.push_back(mean_of(figures));
    }
    jnds.add(participant, mean_of(of_sessions, true));
  }
  jnds.put_means(FigureModel::log_normal);
  return jnds;
}

void put_session(AboveAndBelow& figures, const Results& results) {
  const auto [low, high] = std::ranges::minmax(results, {}, &StaircaseResult::start_g);
  const double middle_g = (low->start_g + high->start_g) / 2;
  if (low->start_g == high->start_g) return;
  for (const StaircaseResult* result : results)
    (result->start_g > middle_g ? figures.above : figures.below).push_back(figure_of(*result));
}

// None where no session has staircases of both kinds.
std::optional<StartEffect> start_effect(const std::map<std::string, AboveAndBelow>& participants,
                                        const Began& began) {
  if (participants.empty()) return std::nullopt;
  StartEffect effect;
  for (const auto& [participant, sessions] : began) {
    const auto figures = participants.find(participant);
    const bool any = figures != participants.end();
    const JndFigure above = any ? mean_of(figures->second.above) : JndFigure{};
    const JndFigure below = any ? mean_of(figures->second.below) : JndFigure{};
    effect.from_above_g.add(participant, above);
    effect.from_below_g.add(participant, below);
    effect.difference_g.add(participant, {difference(above.censored, below.censored),
                                          difference(above.as_logged, below.as_logged)});
  }
  effect.from_above_g.put_means(FigureModel::log_normal);
  effect.from_below_g.put_means(FigureModel::log_normal);
  effect.difference_g.put_means(FigureModel::normal);  // of either sign
  return effect;
}

void add_staircase(ReferenceJnd& jnd, const StaircaseResult& result) {
  jnd.n_staircases += 1;
  jnd.n_without_estimate += result.jnd_g ? 0 : 1;
  jnd.mean_trials += (result.n_trials - jnd.mean_trials) / jnd.n_staircases;
  jnd.least_trials = std::min(jnd.least_trials, result.n_trials);
  jnd.most_trials = std::max(jnd.most_trials, result.n_trials);
  jnd.n_trial_limit += result.reason == StopReason::trials ? 1 : 0;
  jnd.n_floor += result.n_floor;
  jnd.n_ceiling += result.n_ceiling;
  jnd.n_floor_staircases += result.n_floor > 0 ? 1 : 0;
  jnd.n_ceiling_staircases += result.n_ceiling > 0 ? 1 : 0;
}

ReferenceJnd jnd_at(const Compared& compared, const Results& results, const Began& began) {
  ReferenceJnd jnd;
  jnd.compared = compared;
  jnd.least_trials = results.empty() ? 0 : std::numeric_limits<int>::max();
  for (const StaircaseResult* result : results) add_staircase(jnd, *result);
  int n_began = 0;
  for (const auto& [participant, sessions] : began)
    for (const auto& [session_id, n] : sessions) n_began += n;
  jnd.n_unfinished = n_began - jnd.n_staircases;
  jnd.overall = overall_of(results, began);
  return jnd;
}
}  // namespace

std::optional<CensoredValue> censored_value(const StaircaseResult& result) {
  if (!result.shown_g) return std::nullopt;
  return CensoredValue{*result.shown_g, result.censored};
}

void ReferenceJnd::withhold(const std::string& why) {
  overall.withhold(why);
  if (starts)
    for (Jnds* jnds : {&starts->from_above_g, &starts->from_below_g, &starts->difference_g})
      jnds->withhold(why);
}

const Jnds& ReferenceJnd::as_published() const {
  return starts ? starts->from_above_g : overall;
}

StaircaseCollector::StaircaseCollector(std::string_view task) : task_(task) {}

void StaircaseCollector::add_starts(const std::string& participant,
                                    std::span<const StaircaseResult> of_session) {
  std::map<Compared, Results> by_compared;
  for (const StaircaseResult& result : of_session) by_compared[result.compared].push_back(&result);
  for (const auto& [compared, same] : by_compared) {
    AboveAndBelow& of_person = starts_[compared][participant];
    put_session(of_person, same);
    if (of_person.above.empty()) starts_[compared].erase(participant);
  }
}

void StaircaseCollector::add(const SessionData& data) {
  const std::string participant = data.participant();
  const std::map<std::string, Compared> staircases = compared_by(data, task_);
  answers_.add(data, staircases);
  for (const auto& [staircase, compared] : staircases) {
    began_[compared][participant][data.session.session_id] += 1;
    comparable_[compared].add(data.published_condition(compared.condition), true);
  }
  std::vector<StaircaseResult> of_session = results_of(data, task_);
  add_starts(participant, of_session);
  std::ranges::move(of_session, std::back_inserter(results_));
}

std::vector<ReferenceJnd> StaircaseCollector::jnds() const {
  std::map<Compared, Results> finished;
  for (const StaircaseResult& result : results_) finished[result.compared].push_back(&result);
  std::vector<ReferenceJnd> jnds;
  for (const auto& [compared, participants] : began_) {
    jnds.push_back(jnd_at(compared, finished[compared], participants));
    if (compared.method == jnd_method && compared.block.empty() &&
        comparable_.at(compared).condition() == published::Condition::decoupled)
      jnds.back().published = published::jnd_at(compared.reference_g);
    if (const auto starts = starts_.find(compared); starts != starts_.end())
      jnds.back().starts = start_effect(starts->second, participants);
    if (const std::string why = answers_.why_random(compared); !why.empty())
      jnds.back().withhold(why);
  }
  return jnds;
}

void Jnds::add(const std::string& participant, const JndFigure& figure) {
  if (figure.censored)
    participants.push_back({participant, figure.censored->value, figure.censored->censored});
  else
    missing.push_back(participant);
  if (figure.as_logged) as_logged_g_.push_back(figure.as_logged->value);
}

void Jnds::put_means(FigureModel model) {
  model_ = model;
  std::vector<CensoredValue> values;
  for (const ParticipantJnd& one : participants) values.push_back({one.jnd_g, one.censored});
  static_cast<FigureSummary&>(*this) =
      summarize_figures(values, static_cast<int>(missing.size()), model);
  by_paper = {heft::mean(as_logged_g_), sample_sd(as_logged_g_),
              static_cast<int>(as_logged_g_.size())};
}

void Jnds::withhold(const std::string& why) {
  for (const ParticipantJnd& one : participants) missing.push_back(one.participant);
  participants.clear();
  as_logged_g_.clear();
  put_means(model_);
  why_withheld = why;
}

namespace {
std::string why_no_mean(const Jnds& jnds) {
  if (!jnds.why_withheld.empty()) return jnds.why_withheld;
  const int n_above = jnds.n_censored(Censored::above), n_below = jnds.n_censored(Censored::below);
  const int n_missing = static_cast<int>(jnds.missing.size());
  const std::vector<double> exact_g = jnds.exact_g();
  const int n_exact = static_cast<int>(exact_g.size());
  const int n_zero = jnds.n() - n_above - n_below - n_missing - n_exact;
  const std::set<double> different(exact_g.begin(), exact_g.end());
  const bool most_are_exact = 2 * n_exact > jnds.n();
  if (most_are_exact && n_exact > 2 && different.size() > 1)
    return "the limits of its interval are more than a factor of 100 000 apart";
  std::string others;
  for (const auto& [n, what] : {std::pair{n_above, "above a limit"},
                                {n_below, "below a limit"},
                                {n_zero, "0 g"},
                                {n_missing, "indeterminate"}})
    if (n > 0) others += fmt::format(", {} in {}", what, n);
  return fmt::format("exact in {} of {} participants{}; a mean needs {}", n_exact, jnds.n(), others,
                     most_are_exact ? "at least three that are not all equal" : "more than half");
}
}  // namespace

void set_mean(StudyEstimate& estimate, const Jnds& jnds) {
  estimate.value = jnds.mean;
  if (!jnds.mean) estimate.why = why_no_mean(jnds);
  estimate.sd = jnds.sd;
  estimate.set(jnds.interval);
  estimate.n = jnds.n();
  if (jnds.kind != MeanKind::none) estimate.method = name_of(jnds.kind);
}

void put_participants(Estimates& all, StudyEstimate of, const Jnds& jnds) {
  of.published = nullptr;
  const auto put = [&](const std::string& participant) -> StudyEstimate& {
    of.participant = participant;
    return all.emplace_back(of);
  };
  for (const ParticipantJnd& one : jnds.participants) {
    StudyEstimate& estimate = put(one.participant);
    estimate.value = one.jnd_g;
    estimate.censored = one.censored;
    estimate.n = 1;
  }
  for (const std::string& participant : jnds.missing)
    put(participant).why = jnds.why_withheld.empty() ? "indeterminate" : jnds.why_withheld;
}

std::vector<double> Jnds::exact_g() const {
  std::vector<double> exact_g;
  for (const ParticipantJnd& one : participants)
    if (one.censored == Censored::none && (one.jnd_g > 0 || model_ == FigureModel::normal))
      exact_g.push_back(one.jnd_g);
  return exact_g;
}

int Jnds::n_censored(Censored direction) const {
  return static_cast<int>(std::ranges::count(participants, direction, &ParticipantJnd::censored));
}

}  // namespace heft
