// The parts of a session that are no trials, and when trials may begin. Blocks of trials are the
// tasks' own (src/tasks).
// What a session consists of: blocks of trials of any task, breaks and demonstrations, as a
// protocol says. The engine folds over these and needs nothing else of a protocol; a task that is
// on no list can be brought to it as a block of its own.
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "tasks/TaskRun.h"

namespace heft {

struct DemonstrationBlock {
  std::string name;
  double duration_s = 20;
};

struct BreakBlock {
  std::string name;
  double least_duration_s = 60;
};

/// When a trial may begin and be answered: the second tap of two must meet nothing that it could
/// answer. The values in effect are recorded in the session's setup.
struct Onset {
  double gap_s = 0.6;         ///< from a trial's end to the next one's start
  double min_answer_s = 0.5;  ///< from a trial's cubes to the first answer that is taken
};

/// The block of a task: its keys as plain data, `name` among them, and `OfTask`, which has the
/// task's declaration, its Run and its Trial.
template <typename Block>
concept BlockOfTask = requires(const Block& block, const TrialPlan& plan) {
  { block.name } -> std::convertible_to<std::string>;
  { block.most_cubes() } -> std::convertible_to<int>;
  { Block::OfTask::task } -> std::convertible_to<TaskDeclaration>;
  typename Block::OfTask::Run;
  typename Block::OfTask::Trial;
};

/// A block whose trials may ask a question of a questionnaire, in the words of a session's texts.
template <typename Block>
concept AsksQuestion = requires(Block block,
                                const std::map<std::string, Questionnaire>& questionnaires) {
  { block.questionnaire() } -> std::convertible_to<std::optional<std::string>>;
  block.read_question(questionnaires);
  { block.question.has_value() } -> std::convertible_to<bool>;
};

/// A block of trials of any one task.
class TaskBlock {
 public:
  template <BlockOfTask Block>
  TaskBlock(Block block) : of_task_(std::make_shared<Of<Block>>(std::move(block))) {}

  const TaskDeclaration& task() const { return of_task_->task(); }
  const std::string& name() const { return of_task_->name(); }
  /// Cubes that the largest of its trials shows.
  int most_cubes() const { return of_task_->most_cubes(); }

  std::unique_ptr<TaskRun> run(std::uint64_t seed) const { return of_task_->run(seed); }
  /// An attempt at a trial of it, before any answer.
  std::unique_ptr<TaskTrial> trial(const TrialPlan& plan, std::uint64_t seed) const {
    return of_task_->trial(plan, seed);
  }

  /// The questionnaire that its trials ask a question of; none: they ask none.
  std::optional<std::string> questionnaire() const { return of_task_->questionnaire(); }
  bool lacks_question() const { return of_task_->lacks_question(); }
  /// What its keys choose, for people: (what, which). Empty for a task that names none.
  std::vector<std::pair<std::string, std::string>> choices() const { return of_task_->choices(); }
  /// The mean over simulated participants where its length depends on the answers.
  double expected_trials() const { return of_task_->expected_trials(); }
  bool depends_on_answers() const { return of_task_->depends_on_answers(); }
  /// Takes the question from the texts' questionnaires, where it is there.
  void read_question(const std::map<std::string, Questionnaire>& questionnaires) {
    if (auto own = of_task_->with_question(questionnaires)) of_task_ = std::move(own);
  }

  /// The task's own keys; null: it is another task's.
  template <BlockOfTask Block>
  const Block* as() const {
    const auto* of = dynamic_cast<const Of<Block>*>(of_task_.get());
    return of ? &of->block : nullptr;
  }
  /// The same, to be changed: of this block alone, not of its copies.
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
    virtual std::unique_ptr<TaskTrial> trial(const TrialPlan& plan, std::uint64_t seed) const = 0;
    virtual std::optional<std::string> questionnaire() const = 0;
    virtual bool lacks_question() const = 0;
    virtual std::vector<std::pair<std::string, std::string>> choices() const = 0;
    virtual double expected_trials() const = 0;
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
    std::vector<std::pair<std::string, std::string>> choices() const override {
      if constexpr (requires { block.choices(); }) return block.choices();
      return {};
    }
    double expected_trials() const override {
      if constexpr (requires { block.expected_trials(); }) return block.expected_trials();
      return 0;
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

/// The keys of a block of a task's trials; null: it is no such block.
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

/// All that decides which trial comes next and which answers are taken.
struct SessionPlan {
  std::vector<Block> blocks;
  bool require_contact = false;  ///< refuse answers until every cube was touched
};

/// The block of trials of that name.
/// @throws std::out_of_range where there is none
inline const TaskBlock& task_block(const SessionPlan& plan, const std::string& name) {
  for (const Block& block : plan.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block); trials && trials->name() == name)
      return *trials;
  throw std::out_of_range("there is no block of trials \"" + name + "\"");
}

}  // namespace heft
