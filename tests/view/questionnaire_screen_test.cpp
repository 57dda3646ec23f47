// Questionnaires on the screen: whether every question fits, and the touches of taps.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "EveryScreen.h"
#include "SourceFolder.h"
#include "base/files/TextFile.h"
#include "tasks/Judgment.h"
#include "view/screens/ScreenPages.h"
#include "view/screens/TextFit.h"
#include "view/screens/TouchScreen.h"

namespace heft {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

ScreenTexts texts_with_questionnaires(const std::string& language = "en") {
  ScreenTexts texts = texts_in(language);
  for (const std::string name :
       {"nasa_tlx", "borg_cr10", "presence", "ownership", "dissimilarity"}) {
    const std::string file = source_folder() + "/protocols/questionnaires/" + name +
                             (language == "fr" ? ".fr.toml" : ".en.toml");
    const ScreenTexts read = parse_questionnaires(read_text_file(file), file);
    texts.questionnaires.insert(read.questionnaires.begin(), read.questionnaires.end());
    texts.pages.insert(read.pages.begin(), read.pages.end());
  }
  return texts;
}

ScreenState asked(const std::string& name, std::map<std::string, std::string> entries = {}) {
  ScreenState state = page_state(Screen::questionnaire);
  state.form = name;
  state.form_prefix = "sorting." + name + '.';
  state.entries = std::move(entries);
  return state;
}

// A questionnaire that is tapped, with simulated times.
struct Form {
  explicit Form(const ScreenState& state, Measures window = {1024, 600},
                const std::string& language = "en")
      : Form(state, window, texts_with_questionnaires(language)) {}

  Form(const ScreenState& state, Measures window, ScreenTexts with)
      : texts(std::move(with)),
        measures(window),
        screen(texts, false, false, [](float, float) { return std::nullopt; }) {
    screen.show(state, false);
    draw();
  }

  const Control* control(const std::string& name) const {
    for (const Control& one : screen.page().controls)
      if (one.name == name) return &one;
    return nullptr;
  }

  /// Tapped position, as a fraction of the control's width.
  std::vector<Touch> tap(const std::string& name, float at = 0.5f) {
    const Rect area = control(name)->area;
    const float x = area.x + at * area.width, y = area.y + area.height / 2;
    now_s += 2 * settle_s;
    screen.down(Taps::mouse, x, y, now_s);
    screen.up(Taps::mouse, x, y, now_s);
    draw();
    return screen.take();
  }

  void draw() {
    screen.lay_out(typeface, measures, now_s);
    screen.presented(now_s);
  }

  ScreenTexts texts;
  Measures measures;
  Typeface typeface{texts};
  TouchScreen screen;
  double now_s = 0;
};

void expect_fits(const Form& form) {
  const Rect window{0, 0, form.measures.width, form.measures.height};
  for (const Control& control : form.screen.page().controls) {
    EXPECT_TRUE(inside(control.area, window)) << control.name;
    EXPECT_GE(control.area.width, form.measures.target - 0.01f) << control.name;
    EXPECT_GE(control.area.height, form.measures.target - 0.01f) << control.name;
    for (const Control& other : form.screen.page().controls)
      EXPECT_FALSE(&other != &control && control.area.overlaps(other.area))
          << control.name << " on " << other.name;
  }
  for (const TextLine& line : form.screen.page().lines) {
    const Rect area{line.x, line.y, form.typeface.width_px(line.text, line.size_px), line.size_px};
    EXPECT_TRUE(inside(area, window)) << line.text;
    for (const Control& control : form.screen.page().controls)
      EXPECT_FALSE(control.area.overlaps(area)) << line.text << " on " << control.name;
  }
}

TEST(QuestionnaireScreen, EveryQuestionFitsEveryScreen) {
  for (const Measures& window :
       {Measures{1024, 600}, {1280, 800}, {1920, 1080}, {800, 1280}, {1024, 600, 1.3f}})
    for (const char* language : {"en", "ar"})
      for (const auto& [name, questionnaire] : texts_with_questionnaires().questionnaires) {
        // Answered, so that all buttons exist.
        std::map<std::string, std::string> entries;
        for (const FormQuestion& question : questionnaire.questions)
          entries["sorting." + name + '.' + question.key] = "5";
        Form form(asked(name, entries), window, language);
        while (form.control("back")) form.tap("back");
        for (std::size_t i = 0; i < questionnaire.questions.size(); ++i) {
          SCOPED_TRACE(name + ' ' + questionnaire.questions[i].key + ' ' +
                       std::to_string(window.height));
          expect_fits(form);
          form.tap("next");
        }
      }
}

TEST(QuestionnaireScreen, AScaleOfAnyLengthFitsInLettersOfAnySize) {
  FormQuestion likert;
  likert.key = "l";
  likert.kind = QuestionKind::likert;
  likert.text = "How heavy did it feel?";
  likert.low = "Not at all";
  likert.high = "Very much";
  for (const float text_size : {1.0f, 1.3f, 2.0f})
    for (const Measures& window :
         {Measures{1024, 600, text_size}, {1920, 1080, text_size}, {800, 1280, text_size}})
      for (int n_points = 3; n_points <= 11; ++n_points) {
        likert.from = 0;
        likert.to = n_points - 1;
        SCOPED_TRACE(fmt::format("{} points, {} x {}, letters {}", n_points, window.width,
                                 window.height, text_size));
        ScreenTexts texts = texts_with_questionnaires("en");
        texts.questionnaires["scale"] = {"A scale", "", {likert}};
        expect_fits(Form(asked("scale"), window, texts));
        ScreenState trial = trial_state("judgment");
        trial.n_slots = 1;
        trial.offer = Judgment::Offer{likert};
        expect_fits(Form(trial, window, texts));
      }
}

TEST(QuestionnaireScreen, ShippedQuestionnairesFitTheSmallestScreen) {
  for (const char* language : {"en", "fr"}) {
    const ScreenTexts texts = texts_with_questionnaires(language);
    EXPECT_THAT(texts_that_do_not_fit(texts, smallest_screen()), IsEmpty());
    EXPECT_THAT(texts_that_do_not_fit(texts, smallest_screen(2)),
                ::testing::Each(::testing::HasSubstr("only in small letters")));
  }
}

TEST(QuestionnaireScreen, IncompleteNumberIsAskedAgain) {
  FormQuestion number, likert;
  number.key = "n";
  number.kind = QuestionKind::number;
  number.least = 10;
  number.most = 20;
  likert.key = "l";
  likert.kind = QuestionKind::likert;
  const Questionnaire form{"T", "", {number, likert}};
  for (const char* typed : {"", ".", "1", "123"})
    EXPECT_EQ(first_open_question(form, "q.", {{"q.n", typed}}), 0) << typed;
  EXPECT_EQ(first_open_question(form, "q.", {{"q.n", "12"}}), 1);
}

TEST(QuestionnaireScreen, SpokenQuestionsBeforeAnOpenOneAreAskedAgain) {
  FormQuestion spoken, likert;
  spoken.key = "t";
  spoken.kind = QuestionKind::text;
  likert.key = "l";
  likert.kind = QuestionKind::likert;
  FormQuestion last = likert;
  last.key = "m";
  const Questionnaire form{"T", "", {spoken, likert, last}};
  EXPECT_EQ(first_open_question(form, "q.", {}), 0);
  EXPECT_EQ(first_open_question(form, "q.", {{"q.l", "3"}}), 2);
  EXPECT_EQ(first_open_question({"T", "", {likert, spoken}}, "q.", {{"q.l", "3"}}), 1);
}

TEST(QuestionnaireScreen, SliderIsSetByTapAndMovedByOne) {
  Form form(asked("nasa_tlx"));
  EXPECT_EQ(form.control("next")->text, "Skip");
  EXPECT_EQ(form.control("mental_demand_more"), nullptr) << "nothing to move yet";
  auto touches = form.tap("mental_demand_scale", 0.25f);
  ASSERT_THAT(touches, SizeIs(1));
  EXPECT_EQ(touches[0].kind, TouchKind::entry);
  EXPECT_EQ(touches[0].key, "sorting.nasa_tlx.mental_demand");
  EXPECT_EQ(touches[0].value, "25");
  EXPECT_EQ(form.control("next")->text, "Continue");
  EXPECT_EQ(form.tap("mental_demand_more").at(0).value, "26");
  EXPECT_EQ(form.tap("mental_demand_less").at(0).value, "25");
  EXPECT_EQ(form.tap("mental_demand_scale", 0.999f).at(0).value, "100");
  EXPECT_EQ(form.tap("mental_demand_more").at(0).value, "100");
}

TEST(QuestionnaireScreen, SliderRunsInReadingDirection) {
  Form form(asked("nasa_tlx"), {1024, 600}, "ar");
  EXPECT_EQ(form.tap("mental_demand_scale", 0.25f).at(0).value, "75");
  EXPECT_LT(form.control("mental_demand_more")->area.x, form.control("mental_demand_less")->area.x);
}

TEST(QuestionnaireScreen, PointAndChoiceTakeOneTap) {
  Form likert(asked("presence"));
  EXPECT_EQ(likert.tap("being_there_7").at(0).value, "7");
  EXPECT_TRUE(likert.control("being_there_7")->chosen);
  EXPECT_EQ(likert.control("being_there_8"), nullptr);
  Form choice(asked("borg_cr10"));
  EXPECT_EQ(choice.tap("exertion_0.5").at(0).value, "0.5");
  EXPECT_THAT(choice.tap("next"), SizeIs(1)) << "the only question is the last";
}

// The ownership questionnaire at its last question, a number from 0 to 1000.
std::map<std::string, std::string> all_but_the_number() {
  std::map<std::string, std::string> before;
  for (const char* key : {"ownership", "ownership_control", "agency", "agency_control"})
    before[std::string("sorting.ownership.") + key] = "4";
  return before;
}

TEST(QuestionnaireScreen, NumberIsAnsweredWhenItsQuestionIsLeft) {
  Form form(asked("ownership", all_but_the_number()));
  ASSERT_NE(form.control("pushes_key_1"), nullptr) << "the first question without an answer";
  for (const char* key : {"1", "1", "0"})
    EXPECT_THAT(form.tap(std::string("pushes_key_") + key), IsEmpty()) << "no answer yet";
  EXPECT_FALSE(form.control("pushes_key_0")->enabled) << "1100 is out of range";
  EXPECT_TRUE(form.control("next")->enabled);
  form.tap("pushes_delete");
  const auto left = form.tap("next");
  ASSERT_THAT(left, SizeIs(2));
  EXPECT_EQ(left[0].key, "sorting.ownership.pushes");
  EXPECT_EQ(left[0].value, "11");
  EXPECT_EQ(left[1].kind, TouchKind::next);
}

TEST(QuestionnaireScreen, ErasedNumberIsNoAnswer) {
  Form form(asked("ownership", all_but_the_number()));
  form.tap("pushes_key_1");
  form.tap("pushes_delete");
  EXPECT_EQ(form.control("next")->text, "Skip");
  const auto left = form.tap("next");
  ASSERT_THAT(left, SizeIs(1));
  EXPECT_EQ(left[0].kind, TouchKind::next);
}

TEST(QuestionnaireScreen, NumberIsReportedWhenGoingBack) {
  Form form(asked("ownership", all_but_the_number()));
  form.tap("pushes_key_7");
  form.tap("pushes_key_.");
  const auto left = form.tap("back");
  ASSERT_THAT(left, SizeIs(1));
  EXPECT_EQ(left[0].value, "7") << "without the final point";
}

TEST(QuestionnaireScreen, RangeOfNumberIsShown) {
  const Form form(asked("ownership", all_but_the_number()));
  EXPECT_THAT(form.screen.page().lines,
              ::testing::Contains(::testing::Field(&TextLine::text, "0 – 1000")));
}

ScreenState number_trial() {
  ScreenState trial = trial_state("judgment");
  trial.n_slots = 1;
  FormQuestion number;
  number.kind = QuestionKind::number;
  number.key = "value";
  number.least = 0;
  number.most = 1000;
  trial.offer = Judgment::Offer{number};
  return trial;
}

// With the cube in the scene.
void add_cube(Form& form) {
  form.screen.show(number_trial(), true);
  form.draw();
}

TEST(QuestionnaireScreen, TypedNumberIsBesideItsRangeInLargeLetters) {
  for (const Measures& window : {Measures{1024, 600, 2}, {1280, 720, 2}, {1024, 600}}) {
    Form form(number_trial(), window);
    add_cube(form);
    const auto line = [&](const std::string& text) {
      for (const TextLine& one : form.screen.page().lines)
        if (one.text == text) return one;
      ADD_FAILURE() << "no line: " << text;
      return TextLine{};
    };
    const float empty_px = line("–").size_px;
    for (const char* key : {"5", "1", "7"}) form.tap(std::string("value_key_") + key);
    const TextLine number = line("517"), range = line("0 – 1000");
    EXPECT_LE(number.x + form.typeface.width_px(number.text, number.size_px), range.x);
    EXPECT_EQ(number.size_px, empty_px) << "it keeps its size while it is typed";
    EXPECT_GE(range.size_px, Measures(window.width, window.height).body);
  }
}

TEST(QuestionnaireScreen, SameDigitCountsTwiceWhenTypedQuickly) {
  Form form(number_trial());
  add_cube(form);
  form.tap("value_key_1");
  form.tap("value_key_0");
  const auto tap_again = [&](double after_s) {
    const Rect area = form.control("value_key_0")->area;
    const float x = area.x + area.width / 2, y = area.y + area.height / 2;
    form.now_s += after_s;
    form.screen.down(Taps::mouse, x, y, form.now_s);
    form.screen.up(Taps::mouse, x, y, form.now_s);
    form.draw();
    return form.screen.page().lines;
  };
  const auto shows = [](const std::string& text) {
    return ::testing::Contains(::testing::Field(&TextLine::text, text));
  };
  EXPECT_THAT(tap_again(0.03), shows("10")) << "a touch that bounces is one touch";
  EXPECT_THAT(tap_again(0.15), shows("100"));
}

TEST(QuestionnaireScreen, KeyThatCannotLeadIntoTheRangeIsDisabled) {
  FormQuestion number;
  number.kind = QuestionKind::number;
  const auto typed = [&](double least, double most, const std::string& keys) {
    number.least = least;
    number.most = most;
    std::string so_far;
    for (const char key : keys)
      so_far = typed_on(number, so_far, std::string(1, key)).value_or(so_far);
    return so_far;
  };
  EXPECT_EQ(typed(0, 99, "123456789"), "12");
  EXPECT_EQ(typed(0, 99, "99.5"), "99.") << "99.0 is in range, 99.5 is not";
  EXPECT_EQ(typed(0, 99, ".333"), "0.333");
  EXPECT_EQ(typed(0, 99, "007"), "7");
  EXPECT_EQ(typed(10, 20, "3"), "") << "with more digits it is 30 or 300";
  EXPECT_EQ(typed(10, 20, "15"), "15");
  EXPECT_EQ(typed(10, 20, "0.5"), "");
  EXPECT_EQ(typed(1000, 5000, "4321"), "4321");
  EXPECT_EQ(typed(0.25, 0.5, ".19"), "0.") << "neither 0.1 nor 0.9";
  EXPECT_EQ(typed(0, 1, "0.1.2"), "0.12");
  EXPECT_EQ(typed(0, 1e12, "1234567890"), "123456789") << "in nine letters";
  EXPECT_EQ(typed(2e9, 3e9, "2"), "") << "not possible in nine letters";
}

TEST(QuestionnaireScreen, TwoQuestionnairesInARowAreTwoPages) {
  Form form(asked("presence"));
  form.tap("being_there_7");
  form.screen.show(asked("ownership"), false);
  form.now_s += 5;
  form.draw();
  EXPECT_EQ(form.control("being_there_7"), nullptr);
  ASSERT_NE(form.control("ownership_7"), nullptr);
  EXPECT_FALSE(form.control("ownership_7")->chosen);
}

}  // namespace
}  // namespace heft
