// Questionnaires in whole sessions: the answers given are logged, and no question is asked twice.
#include <gmock/gmock.h>

#include "SourceFolder.h"
#include "base/Random.h"
#include "base/files/TextFile.h"
#include "protocol/readers/Files.h"
#include "record/temporary_folder.h"
#include "session/Session.h"
#include "session/TappedSession.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsSupersetOf;
using testing::made_up_s;
using ::testing::Not;
using ::testing::StartsWith;
using testing::Tap;
using testing::TappedScreen;
using testing::TappedSession;

std::string text_with(const std::vector<std::string>& names) {
  std::string text = read_text_file(source_folder() + "/protocols/texts/en.toml");
  for (const std::string& name : names)
    text +=
        '\n' + read_text_file(source_folder() + "/protocols/questionnaires/" + name + ".en.toml");
  return text;
}

ScreenTexts texts_with(const std::vector<std::string>& names) {
  return parse_texts(text_with(names), "texts");
}

// Answers each question once with any of its buttons, and goes on.
class Asked {
 public:
  explicit Asked(std::uint64_t seed) : random_(seed, "questionnaires") {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    const auto& controls = screen.page().controls;
    const bool asks = screen.screen().screen == Screen::questionnaire;
    if (screen.screen().screen == Screen::trial) return tap(answer_to(screen, controls), 0.5);
    const Control* next = named(controls, "next");
    if (!asks || next == nullptr || next->text == "Continue") return tap(next, 0.5);
    std::vector<const Control*> answers;
    for (const Control& control : controls)
      if (control.enabled && is_answer(control.name)) answers.push_back(&control);
    if (answers.empty()) return tap(next, 0.5);  // told to the experimenter
    const Control& chosen = *answers[random_.below(answers.size())];
    const double at = 0.01 + 0.98 * random_.uniform();
    if (const auto* touch = std::get_if<Touch>(&chosen.effect)) meant[touch->key] = touch->value;
    if (const auto* typed = std::get_if<Typed>(&chosen.effect)) meant[typed->key] = typed->value;
    if (const auto* slide = std::get_if<Slide>(&chosen.effect))
      meant[slide->key] = std::to_string(std::lround(100 * at));
    return tap(&chosen, at);
  }

  std::map<std::string, std::string> meant;

 private:
  // Of a keypad, a digit is an answer: each is a number.
  static bool is_answer(const std::string& name) {
    const auto key = name.find("_key_");
    if (key != std::string::npos) return name.back() >= '1' && name.back() <= '9';
    return name != "next" && name != "back" && !name.ends_with("_delete");
  }

  static const Control* named(const std::vector<Control>& controls, const std::string& name) {
    for (const Control& control : controls)
      if (control.name == name) return &control;
    return nullptr;
  }

  static const Control* answer_to(const TappedScreen& screen,
                                  const std::vector<Control>& controls) {
    const auto& state = screen.screen();
    if (state.faded || state.task != "sorting") return named(controls, "cube_1");
    return named(controls, "dont_know");
  }

  std::optional<Tap> tap(const Control* control, double at) {
    if (control == nullptr || !control->enabled) return std::nullopt;
    const double down_s = made_up_s + 0.8;
    const Rect& area = control->area;
    return Tap{down_s, down_s + 0.05, area.x + static_cast<float>(at) * area.width,
               area.y + area.height / 2};
  }

  RandomStream random_;
};

Protocol asking() {
  Protocol protocol = testing::quick_protocol();
  protocol.display_rate_hz = 15;
  auto second = *block_as<Sorting::Block>(protocol.blocks.front());
  second.name = "again";
  protocol.blocks.push_back(second);
  protocol.screens.questionnaires = {{"sorting", {"nasa_tlx"}},
                                     {"again", {"nasa_tlx", "borg_cr10"}},
                                     {"", {"presence", "ownership"}}};
  return protocol;
}

const std::vector<std::string> all{"nasa_tlx", "borg_cr10", "presence", "ownership"};

std::vector<std::string> keys_of(const TappedSession& session) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : session.sink.header().participant_info) keys.push_back(key);
  return keys;
}

TEST(Questionnaires, WhatPeopleAnswerIsLoggedByBlockWithItsTime) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Asked person(seed);
    TappedSession session(asking(), texts_with(all), std::ref(person));
    ASSERT_EQ(session.run(), RunEnd::finished);
    std::map<std::string, std::string> logged = session.sink.header().participant_info;
    double last_s = 0;
    for (const char* asked : {"sorting.nasa_tlx.done_s", "again.nasa_tlx.done_s",
                              "again.borg_cr10.done_s", "presence.done_s", "ownership.done_s"}) {
      ASSERT_TRUE(logged.contains(asked)) << asked;
      const double at_s = std::stod(logged.at(asked));
      EXPECT_GT(at_s, last_s) << asked;
      last_s = at_s;
      logged.erase(asked);
    }
    EXPECT_EQ(logged, person.meant);
    EXPECT_EQ(logged.size(), 6U + 6 + 1 + 3 + 5);
    EXPECT_THAT(testing::pages_of(session.sink),
                IsSupersetOf({"questionnaire_nasa_tlx", "questionnaire_presence"}));
  }
}

// Questions about the effort of a block are asked before the break.
TEST(Questionnaires, ComeBeforeTheBreakThatFollowsTheirBlock) {
  Protocol protocol = asking();
  protocol.blocks.insert(protocol.blocks.begin() + 1, BreakBlock{"rest", 0.1});
  protocol.blocks.insert(protocol.blocks.begin() + 2, DemonstrationBlock{"shown", 0.1});
  protocol.screens.questionnaires = {{"sorting", {"borg_cr10"}},
                                     {"rest", {"presence"}},
                                     {"shown", {"ownership"}},
                                     {"", {"nasa_tlx"}}};
  Asked person(6);
  TappedSession session(protocol, texts_with(all), std::ref(person));
  ASSERT_EQ(session.run(), RunEnd::finished);
  EXPECT_THAT(
      testing::pages_of(session.sink),
      ElementsAre("welcome", "instructions_sorting", "trial_sorting", "questionnaire_borg_cr10",
                  "rest", "questionnaire_presence", "demonstration", "questionnaire_ownership",
                  "instructions_sorting", "trial_sorting", "questionnaire_nasa_tlx", "thanks"));
}

// A short staircase, and at the end two questionnaires and the three questions.
Protocol asking_at_the_end() {
  Protocol protocol = testing::comparing_alone(asking());
  protocol.screens.how_decided = true;
  protocol.screens.questionnaires = {{"", {"borg_cr10", "presence"}}};
  return protocol;
}

// The pages of a session whose last answer is vetoed while one of them is shown.
std::vector<std::string> pages_with_veto_on(Screen vetoed_on) {
  Asked person(7);
  std::optional<TappedSession> session;
  bool vetoed = false;
  const auto with_veto = [&](const TappedScreen& screen) {
    if (screen.screen().screen == vetoed_on && !std::exchange(vetoed, true))
      session->engine.apply({session->engine.last_s(), AnswerVetoed{"by mistake"}});
    return person(screen);
  };
  session.emplace(asking_at_the_end(), texts_with(all), with_veto);
  EXPECT_EQ(session->run(), RunEnd::finished);
  std::vector<std::string> pages = testing::pages_of(session->sink);
  pages.erase(pages.begin(), pages.begin() + 2);  // welcome and instructions
  return pages;
}

TEST(Questionnaires, AnAnswerTakenBackComesBeforeThePagesThatAreLeftAndNoneComesTwice) {
  EXPECT_THAT(pages_with_veto_on(Screen::questionnaire),
              ElementsAre("trial_comparison", "questionnaire_borg_cr10", "trial_comparison",
                          "questionnaire_presence", "how_decided", "thanks"));
  EXPECT_THAT(pages_with_veto_on(Screen::how_decided),
              ElementsAre("trial_comparison", "questionnaire_borg_cr10", "questionnaire_presence",
                          "how_decided", "trial_comparison", "thanks"));
}

TEST(Questionnaires, WhoComesBackIsNotAskedAgainAndContinuesWhereTheyLeft) {
  Asked person(3);
  TappedSession session(asking(), texts_with(all), std::ref(person));
  session.before.entries = {{"sorting.nasa_tlx.done_s", "12.000"},
                            {"again.nasa_tlx.mental_demand", "40"},
                            {"again.nasa_tlx.physical_demand", "50"}};
  ASSERT_EQ(session.run(), RunEnd::finished);
  const auto keys = keys_of(session);
  EXPECT_THAT(keys, Each(Not(StartsWith("sorting."))));
  EXPECT_THAT(keys, Contains("again.nasa_tlx.effort"));
  EXPECT_THAT(keys, Not(Contains("again.nasa_tlx.mental_demand")));
}

TEST(Questionnaires, ThatTheTextsLackAreNotedAndPassedOver) {
  Asked person(4);
  TappedSession session(asking(), texts_with({"nasa_tlx"}), std::ref(person));
  ASSERT_EQ(session.run(), RunEnd::finished);
  std::vector<std::string> notes;
  for (const Event& event : testing::events_of(session.sink, event_kind<Note>))
    notes.push_back(event.as<Note>()->text);
  EXPECT_THAT(notes, Contains(::testing::HasSubstr("\"presence\"")));
}

SessionRequest asked_model(const Protocol& protocol = asking()) {
  const test::TemporaryFolder folder;
  SessionOptions model;
  model.responder = Plug{"coin"};
  model.language = folder.file("texts.toml");
  replace_text_file(*model.language, text_with(all));
  return {resolve(model, protocol, 5), "sim"};
}

TEST(Questionnaires, ModelsAreAskedAsPeopleAre) {
  const RecordedSession session = compute_session(asked_model(), {});
  const std::map<std::string, std::string> logged = session.header().participant_info;
  EXPECT_EQ(logged.size(), 6U + 6 + 1 + 3 + 5 + 2 * 5) << "five that were gone through, by a model";
  const ScreenTexts texts = texts_with(all);
  double last_s = 0;
  const std::vector<std::pair<std::string, std::string>> asked{{"sorting.", "nasa_tlx"},
                                                               {"again.", "nasa_tlx"},
                                                               {"again.", "borg_cr10"},
                                                               {"", "presence"},
                                                               {"", "ownership"}};
  for (const auto& [after, name] : asked) {
    const std::string prefix = after + name + '.';
    for (const FormQuestion& question : texts.questionnaires.at(name).questions) {
      if (question.kind == QuestionKind::text) continue;
      EXPECT_TRUE(takes_answer(question, logged.at(prefix + question.key))) << prefix;
    }
    EXPECT_EQ(logged.at(prefix + "answered_by"), "model");
    const double at_s = std::stod(logged.at(prefix + "done_s"));
    EXPECT_GT(at_s, last_s + 2) << "it takes its time";
    last_s = at_s;
  }
  EXPECT_THAT(
      testing::pages_of(session),
      ElementsAre("questionnaire_nasa_tlx", "questionnaire_nasa_tlx", "questionnaire_borg_cr10",
                  "questionnaire_presence", "questionnaire_ownership"));
  EXPECT_EQ(compute_session(asked_model(), {}).header().participant_info, logged);
}

TEST(Questionnaires, DoNotChangeWhatAModelAnswersInTrials) {
  Protocol unasked = asking();
  unasked.screens.questionnaires.clear();
  const auto actions_of = [](const RecordedSession& session) {
    std::vector<Action> actions;
    for (const Event& event : testing::events_of(session, event_kind<Action>))
      actions.push_back(*event.as<Action>());
    return actions;
  };
  EXPECT_EQ(actions_of(compute_session(asked_model(unasked), {})),
            actions_of(compute_session(asked_model(), {})));
}

}  // namespace
}  // namespace heft
