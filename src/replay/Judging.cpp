#include "replay/Judging.h"

#include <algorithm>
#include <tuple>

#include "base/Error.h"
#include "engine/tasks/TaskRules.h"
#include "replay/LoggedFrames.h"
#include "responders/Responder.h"

namespace heft {

namespace {

// What a trial's actions came to, by the rules of its task.
struct Answered {
  TaskState state;
  std::optional<Outcome> outcome;
};

Answered answered(const TrialPlan& plan, const std::vector<Action>& actions) {
  Answered answered;
  answered.state.plan = plan;
  answered.state.labels.resize(plan.masses_g.size());
  for (const Action& action : actions)
    answered.outcome = rules_of(plan.task).act(answered.state, action);
  return answered;
}

std::vector<Action> actions_for(const Answer& answer, Task task) {
  if (answer.slot) return {{ActionKind::select, answer.slot, {}}};
  if (answer.labels.empty())
    return {{task == Task::sorting ? ActionKind::dont_know : ActionKind::no_difference}};
  std::vector<Action> actions;
  for (std::size_t i = 0; i < answer.labels.size(); ++i)
    actions.push_back({ActionKind::label, static_cast<int>(i) + 1, answer.labels[i]});
  actions.push_back({ActionKind::validate});
  return actions;
}

std::string name_of_answer(const Answered& answer) {
  const TrialPlan& plan = answer.state.plan;
  switch (plan.task) {
    case Task::introduction:
      return answer.outcome == Outcome::correct ? "heaviest" : "other";
    case Task::comparison:
      if (!answer.state.chosen_slot) return "none";
      return answer.state.chosen_slot == plan.reference_slot ? "reference" : "comparison";
    case Task::sorting:
      break;
  }
  return std::string(name_of(answer.outcome.value()));
}

// Somebody who doesn't know says nothing of any cube, whatever labels were tried before.
std::vector<std::string> label_names(const Answered& answer) {
  std::vector<std::string> names;
  for (const auto& label : answer.state.labels)
    names.emplace_back(label && answer.outcome != Outcome::dont_know ? name_of(*label) : "none");
  return names;
}

// The responder of the question under each of the session's setups, with the stage as it was then.
class Minds {
 public:
  Minds(const LoggedSession& session, const std::string& responder)
      : session_(session), named_(named(responder)) {}

  struct Mind {
    std::unique_ptr<Responder> responder;
    std::shared_ptr<const Protocol> protocol;
  };

  const Mind& in_force(const TrialRow& trial) {
    Mind& mind = minds_[trial.setup_index];
    if (mind.responder) return mind;
    const SessionConfig& logged = session_.setup_of(trial);
    const bool same = split_name(named_.responder).file.empty() &&
                      split_name(logged.responder).name == named_.responder;
    mind.responder = make_responder(same ? logged : named_, session_.row.header.seed);
    mind.protocol = session_.protocol_of(trial);
    return mind;
  }

 private:
  static SessionConfig named(const std::string& responder) {
    SessionConfig setup;
    setup.responder = responder;
    if (has_person(setup))
      throw Error("a person can't judge a log; expected a model as --responder", ExitCode::usage);
    complete(setup);
    return setup;
  }

  const LoggedSession& session_;
  SessionConfig named_;
  std::map<int, Mind> minds_;
};

// The attempt's actions that make its one answer, and after how many events the last of them came.
std::pair<std::vector<Action>, int> logged_answer(const AttemptFold& attempt) {
  std::vector<Action> actions;
  int before = 0;
  for (const AttemptEvent& event : attempt.events) {
    const auto* action = event.event.as<Action>();
    if (!action) continue;
    actions.push_back(*action);
    before = event.before;
    if (attempt.first_plan.task == Task::introduction) break;
  }
  return {actions, before};
}

void judge(const AttemptFold& attempt, const std::vector<FrameRow>& rows, const Minds::Mind& mind,
           Judgments& judgments) {
  const TrialPlan& plan = attempt.first_plan;
  const auto [actions, before] = logged_answer(attempt);
  const std::vector<DisplayedFrame> frames = seen_frames(attempt, rows, before);
  if (frames.empty()) {
    ++judgments.n_without_frames;
    return;
  }
  const TrialView view{plan.trial_number, plan.attempt, plan.task,
                       stage_of(*mind.protocol, plan.n_slots())};
  const auto answer = mind.responder->judge(view, frames);
  if (!answer) {
    ++judgments.n_without_answer;
    return;
  }
  judgments.shown_s += frames.back().t_s;
  const Answered logged = answered(plan, actions);
  const Answered judged = answered(plan, actions_for(*answer, plan.task));
  JudgedTrial trial{plan.trial_number,
                    plan.task,
                    plan.condition,
                    plan.reference_g,
                    std::ranges::min(plan.masses_g) < std::ranges::max(plan.masses_g),
                    name_of_answer(logged),
                    name_of_answer(judged),
                    {},
                    {}};
  if (plan.task == Task::sorting) {
    trial.logged_labels = label_names(logged);
    trial.judged_labels = label_names(judged);
  }
  judgments.trials.push_back(std::move(trial));
}

void count(const JudgedTrial& trial, const std::string& answer, DetectionCounts& counts) {
  const int yes = answer == "none" ? 0 : 1;
  ++(trial.has_difference ? counts.n_signal : counts.n_noise);
  (trial.has_difference ? counts.n_hits : counts.n_false_alarms) += yes;
}

}  // namespace

Judgments judge_session(const LogReader& reader, const LoggedSession& session,
                        const std::string& responder, const std::function<void(double)>& progress) {
  Minds minds(session, responder);
  const Projection fold = sound_fold(reader, session);
  Judgments judgments;
  double n_done = 0;
  for (const auto& [index, attempt] : fold.attempts) {
    if (attempt.row.status == TrialStatus::completed)
      judge(attempt, reader.frames(session.row.session_id, index), minds.in_force(attempt.row),
            judgments);
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

std::vector<Agreement> agreements(const std::vector<JudgedTrial>& trials) {
  struct Counted {
    Agreement agreement;
    DetectionCounts logged, judged;
  };
  std::map<std::tuple<Task, std::string, std::optional<double>>, Counted> groups;
  for (const JudgedTrial& trial : trials) {
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
    if (group.agreement.task == Task::comparison) {
      group.agreement.logged = detection(group.logged);
      group.agreement.judged = detection(group.judged);
    }
    agreements.push_back(std::move(group.agreement));
  }
  return agreements;
}

}  // namespace heft
