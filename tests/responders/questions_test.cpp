// Answers of models to questionnaires: valid for each question, and the same each time.
#include <gmock/gmock.h>

#include <set>

#include "responders/Responder.h"
#include "responders/decision/Decision.h"

namespace heft {
namespace {

FormQuestion question(QuestionKind kind) {
  FormQuestion made;
  made.key = "q";
  made.kind = kind;
  made.text = "Q?";
  made.choices = {{"a", "A"}, {"b", "B"}, {"c", "C"}};
  made.from = 0;
  made.to = 4;
  made.least = -2;
  made.most = 2.5;
  return made;
}

TEST(AnyAnswer, IsOneThatTheQuestionTakesAndEachComes) {
  const std::vector<std::pair<QuestionKind, std::size_t>> n_answers{{QuestionKind::choice, 3},
                                                                    {QuestionKind::likert, 5},
                                                                    {QuestionKind::slider, 101},
                                                                    {QuestionKind::number, 5}};
  for (const auto& [kind, n] : n_answers) {
    std::set<std::string> given;
    for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
      const auto answer = any_answer_to(question(kind), seed, "sorting.q.q");
      ASSERT_TRUE(answer && takes_answer(question(kind), *answer)) << name_of(kind);
      given.insert(*answer);
    }
    EXPECT_EQ(given.size(), n) << name_of(kind);
  }
  EXPECT_FALSE(any_answer_to(question(QuestionKind::text), 1, "q"));
}

TEST(AnyAnswer, IsInTheRangeWhereNoWholeNumberIs) {
  FormQuestion between = question(QuestionKind::number);
  between.least = 0.25;
  between.most = 0.75;
  EXPECT_TRUE(takes_answer(between, any_answer_to(between, 1, "q").value()));
}

TEST(AnyAnswer, IsEachModelsOwnAndARecordingHasNone) {
  const FormQuestion slider = question(QuestionKind::slider);
  for (const char* name : {"simulated", "always_yes", "always_no", "coin", "criterion_only",
                           "start_anchored", "weber", "ideal"}) {
    const auto model = responder_named(name).make({7, {}, ""});
    EXPECT_EQ(model->answer(slider, "a"), any_answer_to(slider, 7, "a")) << name;
    EXPECT_EQ(model->answer(slider, "a"), model->answer(slider, "a")) << name;
  }
}

}  // namespace
}  // namespace heft
