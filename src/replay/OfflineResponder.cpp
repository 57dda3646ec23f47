#include "replay/OfflineResponder.h"

#include <algorithm>
#include <memory>
#include <span>
#include <tuple>

#include "base/Error.h"
#include "replay/AttemptReplay.h"
#include "responders/Responder.h"
#include "tasks/SessionPlan.h"
#include "tasks/Task.h"

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

// The responder in question under each of the session's configurations, with the stage of that
// time.
class DecisionModels {
 public:
  DecisionModels(const LoggedSession& session, const WhoAnswers& responder)
      : session_(session), named_(named(responder)) {}

  struct DecisionModel {
    std::unique_ptr<Responder> responder;
    std::shared_ptr<const Protocol> protocol;
  };

  const DecisionModel& in_effect(const TrialRow& trial) {
    DecisionModel& mind = models_[trial.setup_index];
    if (mind.responder) return mind;
    // Without a file it has the logged responder's parameters.
    const auto* logged = std::get_if<Plug>(&session_.setup_of(trial).responder);
    const bool same = logged && named_.named.what.empty() && logged->name == named_.named.name;
    const ResolvedModel model = same ? logged_model(*logged) : named_;
    mind.responder = model.responder(session_.row.header.seed);
    mind.protocol = session_.protocol_of(trial);
    return mind;
  }

 private:
  static ResolvedModel named(const WhoAnswers& responder) {
    const auto* model = std::get_if<Plug>(&responder);
    if (!model)
      throw Error("a person cannot judge a log; expected a model as --responder", ExitCode::usage);
    ResolvedModel resolved = resolve_model(*model);
    resolved.responder(0);  // reports mistakes in its parameters
    return resolved;
  }

  const LoggedSession& session_;
  ResolvedModel named_;
  std::map<int, DecisionModel> models_;
};

// The attempt's actions, and the number of events before its one answer.
std::pair<std::vector<Action>, int> logged_answer(const AttemptFold& attempt) {
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

void judge(const AttemptFold& attempt, const std::vector<FrameRow>& rows,
           const DecisionModels::DecisionModel& mind, std::uint64_t seed,
           OfflineAnswers& judgments) {
  const TrialPlan& plan = attempt.first_plan;
  const auto [actions, before] = logged_answer(attempt);
  const std::vector<DisplayedFrame> frames = seen_frames(attempt, rows, before);
  if (frames.empty()) {
    ++judgments.n_without_frames;
    return;
  }
  const TaskBlock& block = task_block(*mind.protocol, plan.block);
  ScreenState screen;
  block.trial(plan, seed)->show(screen);
  const TrialView view{plan.trial_number, plan.attempt, plan.task,
                       stage_of(*mind.protocol, plan.n_slots()), screen.offer};
  const auto answer = mind.responder->judge(view, frames);
  const auto logged = answered(block, plan, seed, actions);
  const auto judged = answer ? answered(block, plan, seed, answer->actions) : nullptr;
  if (!judged || !logged) {
    ++judgments.n_without_answer;
    return;
  }
  judgments.shown_s += frames.back().t_s;
  judgments.trials.push_back({plan.trial_number, plan.task, plan.condition, plan.reference_g,
                              std::ranges::min(plan.masses_g) < std::ranges::max(plan.masses_g),
                              logged->answer(), judged->answer(), logged->labels(),
                              judged->labels()});
}

void count(const OfflineTrial& trial, const std::string& answer, DetectionCounts& counts) {
  const int yes = answer == "none" ? 0 : 1;
  ++(trial.has_difference ? counts.n_signal : counts.n_noise);
  (trial.has_difference ? counts.n_hits : counts.n_false_alarms) += yes;
}

}  // namespace

OfflineAnswers answer_session(const LogReader& reader, const LoggedSession& session,
                              const WhoAnswers& responder,
                              const std::function<void(double)>& progress) {
  DecisionModels models(session, responder);
  const Projection fold = sound_fold(reader, session);
  OfflineAnswers judgments;
  double n_done = 0;
  for (const auto& [index, attempt] : fold.attempts) {
    if (attempt.row.status == TrialStatus::completed)
      judge(attempt, reader.frames(session.row.session_id, index), models.in_effect(attempt.row),
            session.row.header.seed, judgments);
    progress(++n_done / static_cast<double>(fold.attempts.size()));
  }
  return judgments;
}

int Confusion::n() const {
  int n = 0;
  for (const auto& [pair, count] : n_by_pair) n += count;
  return n;
}

int Confusion::n_agree() const {
  int n = 0;
  for (const auto& [pair, count] : n_by_pair) n += pair.first == pair.second ? count : 0;
  return n;
}

std::vector<Agreement> agreements(const std::vector<OfflineTrial>& trials) {
  struct Counted {
    Agreement agreement;
    DetectionCounts logged, judged;
  };
  std::map<std::tuple<Task, std::string, std::optional<double>>, Counted, InTaskOrder> groups;
  for (const OfflineTrial& trial : trials) {
    auto& [agreement, logged, judged] = groups[{trial.task, trial.condition, trial.reference_g}];
    agreement.task = trial.task;
    agreement.condition = trial.condition;
    agreement.reference_g = trial.reference_g;
    agreement.answers.add(trial.logged, trial.judged);
    for (std::size_t i = 0; i < trial.logged_labels.size(); ++i)
      agreement.labels.add(trial.logged_labels[i], trial.judged_labels[i]);
    count(trial, trial.logged, logged);
    count(trial, trial.judged, judged);
  }
  std::vector<Agreement> agreements;
  for (auto& [key, group] : groups) {
    if (task_named(group.agreement.task).detects) {
      group.agreement.logged = detection(group.logged);
      group.agreement.judged = detection(group.judged);
    }
    agreements.push_back(std::move(group.agreement));
  }
  return agreements;
}

}  // namespace heft
