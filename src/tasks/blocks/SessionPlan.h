// The plan of a session: blocks of trials of any task, breaks and demonstrations, as a protocol
// defines them. The engine needs nothing else of a protocol. A library user can add a task as a
// block type.
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "tasks/TaskRun.h"
#include "tasks/blocks/Practice.h"
#include "tasks/blocks/Staircases.h"

namespace heft {

struct DemonstrationBlock {
  std::string name;
  double duration_s = 20;
};

struct BreakBlock {
  std::string name;
  double least_duration_s = 60;
};

/// Limits on when a trial may start and be answered, so that a double tap answers nothing.
struct Onset {
  double gap_s = 0.6;         ///< from a trial's end to the next start
  double min_answer_s = 0.5;  ///< from the cubes' onset to the first accepted answer
};

/// A task's block: its keys as plain data, including `name`, and the type `OfTask` with the task's
/// declaration, Run and Trial.
template <typename Block>
concept BlockOfTask = requires(const Block& block, const TrialPlan& plan) {
  { block.name } -> std::convertible_to<std::string>;
  { block.most_cubes() } -> std::convertible_to<int>;
  { Block::OfTask::task } -> std::convertible_to<TaskDeclaration>;
  typename Block::OfTask::Run;
  typename Block::OfTask::Trial;
};

/// A block whose trials may ask a question of a questionnaire, in the session's language.
template <typename Block>
concept AsksQuestion = requires(Block block,
                                const std::map<std::string, Questionnaire>& questionnaires) {
  { block.questionnaire() } -> std::convertible_to<std::optional<std::string>>;
  block.read_question(questionnaires);
  { block.question.has_value() } -> std::convertible_to<bool>;
};

/// A block of trials of any task.
class TaskBlock {
 public:
  template <BlockOfTask Block>
  TaskBlock(Block block) : of_task_(std::make_shared<Of<Block>>(std::move(block))) {}

  const TaskDeclaration& task() const { return of_task_->task(); }
  const std::string& name() const { return of_task_->name(); }
  /// Largest number of cubes in a trial.
  int most_cubes() const { return of_task_->most_cubes(); }

  std::unique_ptr<TaskRun> run(std::uint64_t seed) const {
    if (!practice) return of_task_->run(seed);
    const std::uint64_t of_practice = RandomStream(seed, "practice/" + name()).bits();
    return std::make_unique<PracticedRun>(*practice, of_task_->practice_run(of_practice),
                                          of_task_->run(seed), of_task_->is_correct());
  }
  /// Whether answers to its trials are correct or incorrect.
  bool has_correct_answers() const { return of_task_->is_correct() != nullptr; }
  /// A new attempt at a trial.
  std::unique_ptr<TaskTrial> trial(const TrialPlan& plan, std::uint64_t seed) const {
    return of_task_->trial(plan, seed);
  }

  /// The questionnaire whose question its trials ask; none: they ask none.
  std::optional<std::string> questionnaire() const { return of_task_->questionnaire(); }
  bool lacks_question() const { return of_task_->lacks_question(); }
  /// Why the question does not suit the block; none: it does.
  std::optional<std::string> mistake_in_question() const { return of_task_->mistake_in_question(); }
  /// Its procedures, if any.
  std::span<const ReferenceStaircase> staircases() const { return of_task_->staircases(); }
  /// Which of the task's wordings its instructions have; empty: the usual one.
  std::string_view wording() const { return of_task_->wording(); }
  /// Names and values of its design choices, for reports.
  std::vector<std::pair<std::string, std::string>> choices() const {
    auto choices = of_task_->choices();
    if (practice) choices.emplace_back("practice in " + name(), practice->in_words());
    return choices;
  }
  /// Expected number of trials with all practice trials; the mean over simulated participants if it
  /// depends on the answers.
  double expected_trials() const {
    return of_task_->expected_trials() + (practice ? practice->trials : 0);
  }
  double trial_s() const { return of_task_->trial_s(); }  ///< assumed duration of a trial
  bool depends_on_answers() const {
    return of_task_->depends_on_answers() || (practice && practice->until_correct > 0);
  }
  /// Copies the question from a questionnaire, if present.
  void read_question(const std::map<std::string, Questionnaire>& questionnaires) {
    if (auto own = of_task_->with_question(questionnaires)) of_task_ = std::move(own);
  }

  std::optional<Practice> practice = {};  ///< before its trials

  /// The block as its own type; null if it is another task's.
  template <BlockOfTask Block>
  const Block* as() const {
    const auto* of = dynamic_cast<const Of<Block>*>(of_task_.get());
    return of ? &of->block : nullptr;
  }
  /// The same for changes, which do not affect copies of this block.
  template <BlockOfTask Block>
  Block* as() {
    const Block* block = std::as_const(*this).as<Block>();
    if (!block) return nullptr;
    auto own = std::make_shared<Of<Block>>(*block);
    of_task_ = own;
    return &own->block;
  }

 private:
  struct OfAny {
    virtual ~OfAny() = default;
    virtual const TaskDeclaration& task() const = 0;
    virtual const std::string& name() const = 0;
    virtual int most_cubes() const = 0;
    virtual std::unique_ptr<TaskRun> run(std::uint64_t seed) const = 0;
    virtual std::unique_ptr<TaskRun> practice_run(std::uint64_t seed) const = 0;
    virtual IsCorrect is_correct() const = 0;
    virtual std::unique_ptr<TaskTrial> trial(const TrialPlan& plan, std::uint64_t seed) const = 0;
    virtual std::optional<std::string> questionnaire() const = 0;
    virtual bool lacks_question() const = 0;
    virtual std::optional<std::string> mistake_in_question() const = 0;
    virtual std::span<const ReferenceStaircase> staircases() const = 0;
    virtual std::string_view wording() const = 0;
    virtual std::vector<std::pair<std::string, std::string>> choices() const = 0;
    virtual double expected_trials() const = 0;
    virtual double trial_s() const = 0;
    virtual bool depends_on_answers() const = 0;
    virtual std::shared_ptr<const OfAny> with_question(
        const std::map<std::string, Questionnaire>& questionnaires) const = 0;
  };
  template <typename Block>
  struct Of : OfAny {
    using Its = typename Block::OfTask;
    explicit Of(Block its) : block(std::move(its)) {}
    const TaskDeclaration& task() const override { return Its::task; }
    const std::string& name() const override { return block.name; }
    int most_cubes() const override { return block.most_cubes(); }
    std::unique_ptr<TaskRun> run(std::uint64_t seed) const override {
      return std::make_unique<typename Its::Run>(block, seed);
    }
    std::unique_ptr<TaskRun> practice_run(std::uint64_t seed) const override {
      if constexpr (requires { block.for_practice(); })
        return std::make_unique<typename Its::Run>(block.for_practice(), seed);
      return run(seed);
    }
    IsCorrect is_correct() const override {
      if constexpr (requires { &Its::is_correct; }) return &Its::is_correct;
      return nullptr;
    }
    std::unique_ptr<TaskTrial> trial(const TrialPlan& plan, std::uint64_t seed) const override {
      return std::make_unique<typename Its::Trial>(block, plan, seed);
    }
    std::optional<std::string> questionnaire() const override {
      if constexpr (AsksQuestion<Block>) return block.questionnaire();
      return std::nullopt;
    }
    bool lacks_question() const override {
      if constexpr (AsksQuestion<Block>) return block.questionnaire() && !block.question;
      return false;
    }
    std::optional<std::string> mistake_in_question() const override {
      if constexpr (requires { block.mistake_in_question(); }) return block.mistake_in_question();
      return std::nullopt;
    }
    std::span<const ReferenceStaircase> staircases() const override {
      if constexpr (requires { block.staircases; }) return block.staircases;
      return {};
    }
    std::string_view wording() const override {
      if constexpr (requires { block.wording(); }) return block.wording();
      return {};
    }
    std::vector<std::pair<std::string, std::string>> choices() const override {
      if constexpr (requires { block.choices(); }) return block.choices();
      return {};
    }
    double expected_trials() const override {
      if constexpr (requires { block.expected_trials(); }) return block.expected_trials();
      return 0;
    }
    double trial_s() const override {
      if constexpr (requires { block.trial_s(); }) return block.trial_s();
      return Its::task.trial_s;
    }
    bool depends_on_answers() const override {
      if constexpr (requires { block.depends_on_answers(); }) return block.depends_on_answers();
      return false;
    }
    std::shared_ptr<const OfAny> with_question(
        const std::map<std::string, Questionnaire>& questionnaires) const override {
      if constexpr (AsksQuestion<Block>) {
        Block own = block;
        own.read_question(questionnaires);
        return std::make_shared<Of>(std::move(own));
      }
      return nullptr;
    }

    Block block;
  };

  std::shared_ptr<const OfAny> of_task_;
};

using Block = std::variant<DemonstrationBlock, BreakBlock, TaskBlock>;

inline const std::string& block_name(const Block& block) {
  if (const auto* trials = std::get_if<TaskBlock>(&block)) return trials->name();
  if (const auto* shown = std::get_if<DemonstrationBlock>(&block)) return shown->name;
  return std::get<BreakBlock>(block).name;
}

/// A block as a given task's block type; null if it is another block.
template <BlockOfTask Of>
const Of* block_as(const Block& block) {
  const auto* trials = std::get_if<TaskBlock>(&block);
  return trials ? trials->as<Of>() : nullptr;
}
template <BlockOfTask Of>
Of* block_as(Block& block) {
  auto* trials = std::get_if<TaskBlock>(&block);
  return trials ? trials->as<Of>() : nullptr;
}

/// Determines which trial is next and which answers are accepted.
struct SessionPlan {
  std::vector<Block> blocks;
  bool require_contact = false;  ///< refuse answers until every cube was touched
};

/// The block of trials with that name.
/// @throws std::out_of_range if there is none
inline const TaskBlock& task_block(const SessionPlan& plan, const std::string& name) {
  for (const Block& block : plan.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block); trials && trials->name() == name)
      return *trials;
  throw std::out_of_range("there is no block of trials \"" + name + "\"");
}

}  // namespace heft
