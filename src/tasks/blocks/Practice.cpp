#include "tasks/blocks/Practice.h"

#include <fmt/format.h>

#include <utility>

namespace heft {

std::string Practice::in_words() const {
  std::string text = fmt::format("at most {} trials", trials);
  if (until_correct > 0) text += fmt::format(", until {} in a row are correct", until_correct);
  return text + (feedback ? ", with feedback" : ", without feedback");
}

PracticedRun::PracticedRun(const Practice& practice, std::unique_ptr<TaskRun> practiced,
                           std::unique_ptr<TaskRun> counted, IsCorrect is_correct)
    : practice_(practice),
      practiced_(std::move(practiced)),
      counted_(std::move(counted)),
      is_correct_(is_correct) {}

bool PracticedRun::is_practicing() const {
  const bool is_enough =
      practice_.until_correct > 0 && n_correct_in_row_ >= practice_.until_correct;
  return n_done_ < practice_.trials && !is_enough && !practiced_->finished();
}

TrialPlan PracticedRun::plan(const TrialKey& key) const {
  if (!is_practicing()) return counted_->plan(key);
  TrialPlan plan = practiced_->plan(key);
  plan.is_practice = true;
  plan.staircase.clear();
  return plan;
}

void PracticedRun::complete(const TrialRow& row, Changes& changes) {
  feedback_.reset();
  if (!is_practicing()) return counted_->complete(row, changes);
  Changes of_practice;  // dropped
  practiced_->complete(row, of_practice);
  ++n_done_;
  const std::optional<bool> correct = is_correct_ ? is_correct_(row) : std::nullopt;
  if (correct) n_correct_in_row_ = *correct ? n_correct_in_row_ + 1 : 0;
  if (practice_.feedback) feedback_ = correct;
}

}  // namespace heft
