#include "replay/OfflineResponder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "base/Error.h"
#include "base/Random.h"
#include "replay/AttemptReplay.h"
#include "responders/Responder.h"
#include "responders/decision/KnownPlan.h"
#include "responders/perception/SeenGeometry.h"
#include "tasks/Task.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {

namespace {

// The actions of one answer: up to the first action that is not part of it.
std::span<const Action> one_answer(std::span<const Action> actions, const TaskDeclaration& task) {
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (const ActionSpec* spec = task.action(actions[i].kind); spec && !spec->is_step)
      return actions.first(i + 1);
  return {};
}

// The trial with the answer taken by its task's rules. @return null: the answer is refused
std::unique_ptr<TaskTrial> answered(const TaskBlock& block, const TrialPlan& plan,
                                    std::uint64_t seed, std::span<const Action> actions) {
  auto trial = block.trial(plan, seed);
  const auto answer = one_answer(actions, block.task());
  for (const Action& action : answer) {
    if (trial->refusal(action)) return nullptr;
    trial->take(action);
  }
  return answer.empty() ? nullptr : std::move(trial);
}

// One of the models under each of the session's configurations: a responder for each draw.
class Model {
 public:
  using Draws = std::vector<std::unique_ptr<Responder>>;

  Model(const LoggedSession& session, const ResponderChoice& responder, const JudgeRequest& request)
      : session_(session), named_(named(responder)), name_(to_text(responder)), request_(request) {}

  const std::string& name() const { return name_; }

  const Draws& in_effect(const TrialRow& trial) {
    Draws& draws = by_setup_[trial.setup_index];
    if (!draws.empty()) return draws;
    const auto* logged = std::get_if<Plug>(&session_.setup_of(trial).responder);
    const bool same = logged && named_.named.what.empty() && logged->name == named_.named.name;
    const ResolvedModel model = same ? as_it_was(*logged) : named_;
    for (int draw = 0; draw < request_.repeats; ++draw)
      draws.push_back(model.responder(RandomStream(request_.seed, "judge " + named_.named.name,
                                                   static_cast<std::uint64_t>(session_id()),
                                                   static_cast<std::uint64_t>(draw))
                                          .bits()));
    return draws;
  }

 private:
  std::int64_t session_id() const { return session_.row.session_id; }

  static ResolvedModel named(const ResponderChoice& responder) {
    const auto* model = std::get_if<Plug>(&responder);
    if (!model)
      throw Error("a person cannot judge a log; expected a model as --responder", ExitCode::usage);
    ResolvedModel resolved = resolve_model(*model);
    resolved.responder(0);  // reports mistakes in its parameters
    return resolved;
  }

  // The simulated person of this session, and not another one of the same population.
  ResolvedModel as_it_was(const Plug& logged) const {
    ResolvedModel model = logged_model(logged);
    const auto drawn = model.drawn(session_.row.header.seed);
    auto& given = model.options.parameters;
    std::erase_if(given, [&](const Parameter& one) { return drawn.contains(one.name); });
    for (const auto& [name, value] : drawn)
      given.push_back({name, name == "participant_spread" ? 0.0 : value, {}});
    return model;
  }

  const LoggedSession& session_;
  ResolvedModel named_;
  std::string name_;  ///< as given
  const JudgeRequest& request_;
  std::map<int, Draws> by_setup_;
};

// The attempt's actions, and the number of events before its one answer.
std::pair<std::vector<Action>, int> logged_answer(const ProjectedAttempt& attempt) {
  const TaskDeclaration& task = task_named(attempt.first_plan.task);
  std::vector<Action> actions;
  for (const AttemptEvent& event : attempt.events) {
    const auto* action = event.event.as<Action>();
    if (!action) continue;
    actions.push_back(*action);
    if (!one_answer(actions, task).empty()) return {actions, event.before};
  }
  return {actions, 0};
}

// The logged hand's frames under another protocol's physics.
std::vector<FrameRow> changed_rows(std::vector<FrameRow> rows, const ProjectedAttempt& attempt,
                                   const Protocol& protocol) {
  AttemptReplay replay(protocol, attempt);
  for (FrameRow& row : rows) {
    const ShownFrame shown = replay.advance(row);
    row.clone = shown.frame.clone;
    row.cubes = shown.frame.cubes;
  }
  return rows;
}

std::string word_of(const TaskTrial& trial) {
  const std::vector<std::string> labels = trial.labels();
  return labels.empty() ? trial.answer() : fmt::format("{}", fmt::join(labels, " "));
}

class SessionJudge {
 public:
  SessionJudge(const LoggedSession& session, const JudgeRequest& request, const Protocol* what_if)
      : session_(session), what_if_(what_if) {
    for (const ResponderChoice& responder : request.responders)
      models_.emplace_back(session, responder, request);
  }

  void leave_out(const ProjectedAttempt& attempt, std::string_view why) {
    judgments_.left_out.push_back(
        {session_.row.session_id, attempt.first_plan.trial_number, std::string(why)});
  }

  void judge(const ProjectedAttempt& attempt, const std::vector<FrameRow>& rows) {
    const TrialPlan& plan = attempt.first_plan;
    const auto logged_protocol = session_.protocol_of(attempt.row);
    const Protocol& protocol = what_if_ ? *what_if_ : *logged_protocol;
    const TaskBlock& block = task_block(protocol, plan.block);
    const auto [actions, before] = logged_answer(attempt);
    const auto logged = answered(block, plan, seed(), actions);
    const std::optional<bool> last_differed = std::exchange(last_differed_, std::nullopt);
    if (logged) last_differed_ = logged->answered_different();
    if (plan.is_practice) return leave_out(attempt, is_practice);
    if (rows.empty()) return leave_out(attempt, lacks_frames);
    if (!logged || !logged->n_answers()) return leave_out(attempt, is_a_number);
    const Stage stage = stage_of(protocol, plan.n_slots());
    const auto frames =
        seen_frames(attempt, what_if_ ? changed_rows(rows, attempt, protocol) : rows, before);
    const auto seen = frames_with_touches(frames, stage);
    if (seen.empty()) return leave_out(attempt, is_untouched);
    ScreenState screen;
    block.trial(plan, seed())->show(screen);
    JudgedTrial trial = judged_trial(plan, *logged);
    const TrialView displayed{plan.trial_number, plan.attempt, plan.task, stage,
                              screen.offer,      last_differed};
    for (std::size_t i = 0; i < models_.size(); ++i) {
      const Model::Draws& responders = models_[i].in_effect(attempt.row);
      TrialView view = displayed;
      view.lifted_g = plan.real_reference_g();
      if (responders.front()->knows_plan()) view.truth = truth_of(protocol, plan);
      const auto draws = draws_of(responders, view, seen, block, plan);
      if (!draws) return leave_out(attempt, no_answer_of(models_[i].name()));
      trial.models.push_back(*draws);
    }
    judgments_.shown_s += frames.back().t_s;
    judgments_.trials.push_back(std::move(trial));
  }

  Judgments take() { return std::move(judgments_); }

 private:
  std::uint64_t seed() const { return session_.row.header.seed; }

  JudgedTrial judged_trial(const TrialPlan& plan, const TaskTrial& logged) const {
    return {session_.row.header.participant,
            session_.row.session_id,
            plan.trial_number,
            plan.task,
            plan.condition,
            plan.reference_g,
            plan.level_g,
            plan.real_reference_g()
                ? plan.level_g != 0
                : std::ranges::min(plan.masses_g) < std::ranges::max(plan.masses_g),
            *logged.n_answers(),
            logged.detects(),
            word_of(logged),
            logged.labels(),
            {}};
  }

  std::optional<AnswerDraws> draws_of(const Model::Draws& responders, const TrialView& view,
                                      const std::vector<DisplayedFrame>& frames,
                                      const TaskBlock& block, const TrialPlan& plan) const {
    AnswerDraws draws;
    for (const auto& responder : responders) {
      const auto answer = responder->judge(view, frames);
      const auto judged = answer ? answered(block, plan, seed(), answer->actions) : nullptr;
      if (!judged) return std::nullopt;
      draws.add(word_of(*judged), judged->labels());
    }
    return draws;
  }

  const LoggedSession& session_;
  const Protocol* what_if_;
  std::vector<Model> models_;
  Judgments judgments_;
  std::optional<bool> last_differed_;  ///< the logged answer to the trial before
};

}  // namespace

void Judgments::add(Judgments more) {
  std::ranges::move(more.trials, std::back_inserter(trials));
  std::ranges::move(more.left_out, std::back_inserter(left_out));
  shown_s += more.shown_s;
}

std::string no_answer_of(std::string_view responder) {
  return fmt::format("without an answer of {}", responder);
}

Judgments judge_session(const LogReader& reader, const LoggedSession& session,
                        const JudgeRequest& request, const Protocol* what_if,
                        const std::function<void(double)>& progress) {
  SessionJudge judge(session, request, what_if);
  const Projection fold = sound_fold(reader, session);
  double n_done = 0;
  for (const auto& [index, attempt] : fold.attempts) {
    if (attempt.row.status == TrialStatus::completed)
      judge.judge(attempt, reader.frames(session.row.session_id, index));
    else
      judge.leave_out(attempt, attempt.row.status == TrialStatus::voided ? is_voided : is_open);
    progress(++n_done / static_cast<double>(fold.attempts.size()));
  }
  return judge.take();
}

}  // namespace heft
