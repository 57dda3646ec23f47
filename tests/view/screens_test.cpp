// The participant's screens without a window: content and fit of each page, and the touches of
// taps.
#include "view/screens/Screens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <sstream>

#include "EveryScreen.h"
#include "base/Error.h"
#include "tasks/Comparison.h"
#include "tasks/Task.h"
#include "view/screens/TextFit.h"

namespace heft {
namespace {

using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::MatchesRegex;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;

const std::vector<Measures> windows{{800, 480},         {1024, 600},    {1280, 800},
                                    {1920, 1080},       {800, 1280},    {1024, 600, 0.75f},
                                    {1024, 600, 1.3f},  {1008, 520},    {1008, 520, 1.3f},
                                    {3840, 2160, 1.3f}, {1024, 600, 2}, {800, 1280, 2}};

bool overlap(const Rect& a, const Rect& b) {
  return a.overlaps(b);
}

std::vector<std::string> names(const Page& page, bool enabled_only = false) {
  std::vector<std::string> all;
  for (const Control& control : page.controls)
    if (control.enabled || !enabled_only) all.push_back(control.name);
  return all;
}

// Screens in one language and window, tapped by name.
struct Fixture {
  explicit Fixture(const std::string& language = "en", Measures window = {1024, 600},
                   bool left_handed = false)
      : measures(window), typeface(texts_in(language)), screens(texts_in(language), left_handed) {}

  Page page() const { return screens.page(typeface, measures); }
  Control control(const std::string& name) const {
    for (const Control& control : page().controls)
      if (control.name == name) return control;
    throw std::out_of_range(name);
  }
  std::optional<Touch> tap(const std::string& name) {
    const Control& tapped = control(name);
    if (!tapped.enabled) throw std::logic_error(name + " is disabled");
    return screens.tapped(tapped);
  }

  Measures measures;
  Typeface typeface;
  Screens screens;
};

Action action(const std::optional<Touch>& touch) {
  EXPECT_TRUE(touch);
  EXPECT_EQ(touch->kind, TouchKind::action);
  return touch->action;
}

// Visits every screen, every question and every part in a window.
template <typename Check>
void on_every_page(const Check& check) {
  for (const std::string language : {"en", "fr", "ar", "ja"})
    for (const Measures& window : windows)
      for (const bool left_handed : {false, true}) {
        Fixture fixture(language, window, left_handed);
        for (const NamedScreen& screen : every_screen(fixture.screens.texts())) {
          fixture.screens.show(screen.state, screen.cubes);
          SCOPED_TRACE(language + ' ' + screen.name + ' ' + std::to_string(window.height));
          for (bool more = true; more;) {
            check(fixture, fixture.page());
            more = false;
            for (const Control& control : fixture.page().controls)
              if (std::holds_alternative<TurnPart>(control.effect) && control.name != "back") {
                fixture.screens.tapped(control);
                more = true;
                break;
              }
          }
        }
      }
}

TEST(Screens, ControlsAreLargeSeparateAndInsideTheWindow) {
  on_every_page([](const Fixture& fixture, const Page& page) {
    const Rect window{0, 0, fixture.measures.width, fixture.measures.height};
    for (const Control& control : page.controls) {
      EXPECT_TRUE(inside(control.area, window)) << control.name;
      EXPECT_GE(control.area.width, fixture.measures.target) << control.name;
      EXPECT_GE(control.area.height, fixture.measures.target - 0.01f) << control.name;
      EXPECT_FALSE(page.scene && overlap(control.area, *page.scene)) << control.name;
      for (const Control& other : page.controls)
        EXPECT_FALSE(&other != &control && overlap(control.area, other.area))
            << control.name << ' ' << other.name;
    }
  });
}

TEST(Screens, TargetsAreTwelveMillimetersOnSevenInchScreen) {
  for (const auto& [width, height] :
       {std::pair{1024.f, 600.f}, {1280.f, 800.f}, {1920.f, 1080.f}}) {
    const float mm_per_px = 7 * 25.4f / std::hypot(width, height);
    EXPECT_GE(Measures(width, height).target * mm_per_px, 12.f) << width;
  }
}

TEST(Screens, TextIsInsideTheWindowAndBesideControls) {
  on_every_page([](const Fixture& fixture, const Page& page) {
    const Rect window{0, 0, fixture.measures.width, fixture.measures.height};
    for (const TextLine& line : page.lines) {
      const Rect area{line.x, line.y, fixture.typeface.width_px(line.text, line.size_px),
                      line.size_px};
      EXPECT_TRUE(inside(area, window)) << line.text;
      EXPECT_FALSE(page.scene && overlap(area, *page.scene)) << line.text;
      for (const Control& control : page.controls)
        EXPECT_FALSE(overlap(area, control.area)) << line.text << " on " << control.name;
    }
  });
}

TEST(Screens, ButtonTextsFitAtReadableSize) {
  on_every_page([](const Fixture& fixture, const Page& page) {
    const Measures asked = fixture.measures, usual(asked.width, asked.height);
    if (asked.body < usual.body) return;  // smaller text was requested
    for (const Control& control : page.controls) {
      const auto [words, note, words_area, note_area] =
          words_on(control, fixture.typeface, fixture.measures);
      EXPECT_GE(words.size_px, 0.7f * usual.body) << control.text;
      for (const std::string& line : words.lines)
        EXPECT_LE(fixture.typeface.width_px(line, words.size_px), words_area.width) << line;
    }
  });
}

bool is_number_or_letter(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos ||
         (text.size() == 1 && std::isalpha(static_cast<unsigned char>(text.front())) != 0);
}

// A larger answer would stand out. Letters and numbers of cubes are apart from answers in words.
TEST(Screens, ButtonsOfOneSizeHaveLettersOfOneSize) {
  on_every_page([](const Fixture& fixture, const Page& page) {
    const auto words = words_on(page.controls, fixture.typeface, fixture.measures);
    ASSERT_EQ(words.size(), page.controls.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
      const Control& control = page.controls[i];
      for (const std::string& line : words[i].text.lines)
        EXPECT_LE(fixture.typeface.width_px(line, words[i].text.size_px), words[i].text_area.width)
            << line;
      for (std::size_t j = 0; j < i; ++j) {
        const Control& other = page.controls[j];
        if (!control.note.empty() || !other.note.empty() || control.text.empty() ||
            other.text.empty() || std::abs(control.area.width - other.area.width) > 0.1f ||
            std::abs(control.area.height - other.area.height) > 0.1f ||
            is_number_or_letter(control.text) != is_number_or_letter(other.text))
          continue;
        EXPECT_EQ(words[i].text.size_px, words[j].text.size_px)
            << control.text << " and " << other.text;
      }
    }
  });
}

// The lines of each part.
std::vector<std::vector<std::string>> parts_of(Fixture& fixture, const ScreenState& state) {
  fixture.screens.show(state, true);
  std::vector<std::vector<std::string>> parts;
  for (bool more = true; more;) {
    parts.emplace_back();
    for (const TextLine& line : fixture.page().lines)
      if (line.tone == Tone::soft) parts.back().push_back(line.text);
    const auto all = names(fixture.page());
    more = std::ranges::find(all, "more") != all.end();
    if (more) fixture.tap("more");
  }
  return parts;
}

TEST(Screens, LongTextsAreDividedBetweenParagraphs) {
  Fixture fixture("fr", {1024, 600, 2});
  const auto parts = parts_of(fixture, page_state(Screen::thanks));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_TRUE(parts[1].front().starts_with("Veuillez")) << parts[1].front();
}

// Only the last part has two rows of buttons below it.
TEST(Screens, LongConsentFillsItsPages) {
  Fixture fixture("en", {1024, 600, 2});
  const auto parts = parts_of(fixture, page_state(Screen::consent));
  ASSERT_GT(parts.size(), 1U);
  EXPECT_GE(parts.front().size(), 4U);
}

TEST(Screens, LongTextsAreDividedBetweenSentences) {
  int n_divided = 0;
  for (const std::string language : {"en", "fr"})
    for (const Measures& window : {Measures(1024, 600, 2), Measures(1280, 720, 2)})
      for (const Screen screen : {Screen::welcome, Screen::consent, Screen::declined, Screen::rest,
                                  Screen::paused, Screen::thanks}) {
        Fixture fixture(language, window);
        const auto parts = parts_of(fixture, page_state(screen));
        n_divided += parts.size() > 1;
        for (const std::vector<std::string>& part : parts)
          EXPECT_THAT(part.back(), MatchesRegex(".*[.!?]")) << language << ' ' << window.width;
      }
  EXPECT_GT(n_divided, 4);
}

// A language without spaces, and a sentence that no page holds.
TEST(Screens, ASentenceLongerThanAPageIsDividedBetweenLines) {
  for (const std::string word : {"word ", "語"}) {
    std::string text;
    for (int i = 0; i < 400; ++i) text += word;
    Fixture fixture("en", {1024, 600, 2});
    ScreenTexts texts = texts_in("en");
    texts.pages.at("thanks").at("text") = text;
    fixture.screens = Screens(texts, false);
    const auto parts = parts_of(fixture, page_state(Screen::thanks));
    EXPECT_GT(parts.size(), 2U);
    std::string shown;
    for (const std::vector<std::string>& part : parts)
      for (const std::string& line : part) shown += line;
    std::erase(shown, ' ');
    std::erase(text, ' ');
    EXPECT_EQ(shown, text);
  }
}

// Given labels must be legible at arm's length, because they are validated.
TEST(Screens, GivenLabelsAreInOneLineOfUsualSize) {
  int n_notes = 0;
  on_every_page([&](const Fixture& fixture, const Page& page) {
    for (const Control& control : page.controls) {
      if (control.note.empty()) continue;
      ++n_notes;
      const Measures asked = fixture.measures, usual(asked.width, asked.height);
      const ControlWords words = words_on(control, fixture.typeface, fixture.measures);
      for (const FittedText& text : {words.text, words.note}) {
        EXPECT_EQ(text.lines.size(), 1U) << text.lines.front();
        EXPECT_GE(text.size_px, 0.85f * std::min(usual.body, asked.body)) << text.lines.front();
      }
      EXPECT_FALSE(overlap(words.text_area, words.note_area));
      EXPECT_TRUE(inside(words.note_area, control.area));
    }
  });
  EXPECT_GT(n_notes, 0);
}

// A photodiode on the screen must not cover anything.
TEST(Screens, PhotodiodePatchCoversNoControlAndNoText) {
  on_every_page([](const Fixture& fixture, const Page& page) {
    const bool left_handed =
        !page.controls.empty() && page.scene && page.controls.front().area.x < page.scene->x;
    for (const bool left : {true, false}) {
      if (page.scene && left == left_handed) continue;  // it is beside the scene
      const Rect patch = place_of({true, left}, fixture.measures);
      EXPECT_GE(patch.width, 1.9f * fixture.measures.margin);
      EXPECT_TRUE(inside(patch, {0, 0, fixture.measures.width, fixture.measures.height}));
      for (const Control& control : page.controls)
        EXPECT_FALSE(overlap(patch, control.area)) << control.name;
      for (const TextLine& line : page.lines)
        EXPECT_FALSE(overlap(
            patch,
            {line.x, line.y, fixture.typeface.width_px(line.text, line.size_px), line.size_px}))
            << line.text;
    }
  });
}

TEST(Screens, PageIsEmptyBeforeAStateIsSet) {
  Fixture fixture;
  EXPECT_THAT(fixture.page().lines, testing::IsEmpty());
  EXPECT_THAT(names(fixture.page()), ElementsAre());
}

TEST(Screens, SceneFillsMostOfTheWindow) {
  Fixture fixture;
  fixture.screens.show(trial_state("sorting"), true);
  const Rect scene = *fixture.page().scene;
  EXPECT_GT(scene.width, 0.64f * 1024);
  EXPECT_GT(scene.height, 0.8f * 600);
}

TEST(Screens, EachScreenOffersItsControls) {
  Fixture fixture;
  const auto offered = [&](const std::string& name) {
    for (const NamedScreen& screen : every_screen(fixture.screens.texts()))
      if (screen.name == name) fixture.screens.show(screen.state, screen.cubes);
    return names(fixture.page());
  };
  EXPECT_THAT(offered("consent"), UnorderedElementsAre("next", "decline"));
  EXPECT_THAT(offered("welcome"), ElementsAre("next"));
  EXPECT_THAT(offered("demonstration"), ElementsAre("next"));
  EXPECT_THAT(offered("demonstration_waiting"), ElementsAre());
  EXPECT_THAT(offered("instructions_sorting"), ElementsAre("next"));
  EXPECT_THAT(offered("rest_waiting"), ElementsAre());
  EXPECT_THAT(offered("rest"), ElementsAre("next"));
  EXPECT_THAT(offered("paused"), ElementsAre());
  EXPECT_THAT(offered("thanks"), ElementsAre("next"));
  EXPECT_THAT(offered("introduction"), UnorderedElementsAre("cube_1", "cube_2", "put_cubes_back"));
  EXPECT_THAT(offered("comparison"),
              UnorderedElementsAre("cube_1", "cube_2", "no_difference", "put_cubes_back"));
  EXPECT_THAT(
      offered("sorting"),
      UnorderedElementsAre("cube_1", "cube_2", "cube_3", "label_lightest", "label_intermediate",
                           "label_heaviest", "validate", "dont_know", "put_cubes_back"));
}

TEST(Screens, CubesOtherThanThreeAreRanked) {
  for (const int n : {2, 4, 5, 6}) {
    Fixture fixture;
    fixture.screens.show(sorting_state(n), true);
    std::vector<std::string> expected{"validate", "dont_know", "put_cubes_back"};
    for (int i = 1; i <= n; ++i) {
      expected.push_back("cube_" + std::to_string(i));
      expected.push_back("label_" + std::to_string(i));
    }
    EXPECT_THAT(names(fixture.page()), UnorderedElementsAreArray(expected));
    fixture.tap("cube_2");
    const auto given = action(fixture.tap("label_" + std::to_string(n)));
    EXPECT_EQ(given.kind, "label");
    EXPECT_EQ(given.slot, 2);
    EXPECT_EQ(given.label, Sorting::labels_for(n).back());
  }
}

TEST(Screens, LettersAndRanksOfManyCubesAreOfUsualSizeAmongLongWords) {
  for (const float text_size : {1.f, 2.f})
    for (const int n : {4, 5, 6}) {
      Fixture fixture("fr", {1024, 600, text_size});
      fixture.screens.show(sorting_state(n), true);
      const Page page = fixture.page();
      const auto words = words_on(page.controls, fixture.typeface, fixture.measures);
      for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& name = page.controls[i].name;
        if (!name.starts_with("cube_") && !name.starts_with("label_")) continue;
        EXPECT_GE(words[i].text.size_px, 0.99f * Measures(1024, 600).body) << name;
      }
    }
}

// In French a colon would need a space before it.
TEST(Screens, EndsOfTheRanksAreInTheQuestion) {
  Fixture fixture("fr", {1920, 1080});
  fixture.screens.show(sorting_state(4), true);
  std::string question;
  for (const TextLine& line : fixture.page().lines) question += line.text + ' ';
  EXPECT_THAT(question, ::testing::HasSubstr("1 = Le plus léger, 4 = Le plus lourd"));
}

TEST(Screens, AnswersAreDisabledBeforeTheyAreAllowed) {
  Fixture fixture;
  for (const Task task : words_of<Task>()) {
    ScreenState state = trial_state(task);
    state.can_validate = true;
    fixture.screens.show(state, false);
    EXPECT_THAT(names(fixture.page(), true), ElementsAre()) << "no cubes yet";
    state.can_answer = state.can_validate = false;
    fixture.screens.show(state, true);
    EXPECT_THAT(names(fixture.page(), true), ElementsAre("put_cubes_back"));
  }
}

TEST(Screens, OnlyIntroductionShowsTryAgain) {
  Fixture fixture;
  for (const Task task : words_of<Task>()) {
    ScreenState state = trial_state(task);
    state.try_again = true;
    fixture.screens.show(state, true);
    EXPECT_EQ(fixture.page().notice == "Please try again.", task == "introduction");
  }
}

TEST(Screens, ChoiceTakesOneTap) {
  Fixture fixture;
  fixture.screens.show(trial_state("comparison"), true);
  EXPECT_EQ(action(fixture.tap("cube_2")).kind, "select");
  EXPECT_EQ(action(fixture.tap("cube_2")).slot, 2);
  EXPECT_EQ(action(fixture.tap("no_difference")).kind, "no_difference");
  EXPECT_FALSE(action(fixture.tap("no_difference")).slot);
  EXPECT_EQ(fixture.tap("put_cubes_back")->kind, TouchKind::put_cubes_back);
}

TEST(Screens, SameOrDifferentTakesOneTapAndNoCube) {
  Fixture fixture;
  ScreenState state = trial_state("comparison");
  state.offer = Comparison::Offer{ComparisonAnswers::same_different};
  fixture.screens.show(state, true);
  EXPECT_THAT(names(fixture.page(), true),
              ElementsAre("no_difference", "different", "put_cubes_back"));
  EXPECT_EQ(action(fixture.tap("no_difference")).kind, "no_difference");
  EXPECT_EQ(action(fixture.tap("different")).kind, "different");
  EXPECT_FALSE(action(fixture.tap("different")).slot);
}

// The question that replaces the request to lift may have more lines or fewer.
TEST(Screens, SceneStaysWhereItIsOnceTheRealObjectWasLifted) {
  for (const std::string language : {"en", "fr"})
    for (const Measures& window : windows)
      for (const auto answers :
           {ComparisonAnswers::heavier_or_none, ComparisonAnswers::same_different}) {
        Fixture fixture(language, window);
        ScreenState state = trial_state("comparison");
        const auto scene = [&](bool was_lifted) {
          state.offer = Comparison::Offer{answers, "brass block", was_lifted};
          fixture.screens.show(state, true);
          return *fixture.page().scene;
        };
        const Rect before = scene(false), after = scene(true);
        EXPECT_FLOAT_EQ(before.y, after.y) << language << ' ' << window.height;
        EXPECT_FLOAT_EQ(before.height, after.height) << language << ' ' << window.height;
      }
}

TEST(Screens, LabelIsGivenToSelectedCubeAndRemovedBySecondTap) {
  Fixture fixture;
  ScreenState state = trial_state("sorting");
  fixture.screens.show(state, true);
  EXPECT_FALSE(fixture.control("label_heaviest").enabled) << "no cube is selected";
  EXPECT_FALSE(fixture.tap("cube_2")) << "a selection is not reported";
  EXPECT_TRUE(fixture.control("cube_2").chosen);
  const Action given = action(fixture.tap("label_heaviest"));
  EXPECT_EQ(given.kind, "label");
  EXPECT_EQ(given.slot, 2);
  EXPECT_EQ(given.label, "heaviest");

  labels_on(state)[1] = "heaviest";
  state.n_choices = 1;
  fixture.screens.show(state, true);
  EXPECT_TRUE(fixture.control("label_heaviest").chosen);
  EXPECT_EQ(fixture.control("label_heaviest").note, "Middle");
  EXPECT_EQ(fixture.control("label_lightest").note, "");
  const Action back = action(fixture.tap("label_heaviest"));
  EXPECT_EQ(back.kind, "unlabel");
  EXPECT_EQ(back.slot, 2);
  EXPECT_FALSE(back.label);
  EXPECT_EQ(action(fixture.tap("label_lightest")).kind, "label") << "labels can be changed";
}

TEST(Screens, LabelsAreShownOverTheirCubes) {
  Fixture fixture;
  ScreenState state = trial_state("sorting");
  labels_on(state) = {"heaviest", std::nullopt, "lightest"};
  fixture.screens.show(state, true);
  fixture.tap("cube_2");
  std::vector<std::tuple<int, std::string, bool>> marks;
  for (const CubeMark& mark : fixture.page().marks)
    marks.emplace_back(mark.slot, mark.text, mark.selected);
  EXPECT_THAT(marks, ElementsAre(std::tuple(1, "Heaviest", false), std::tuple(2, "", true),
                                 std::tuple(3, "Lightest", false)));
}

TEST(Screens, NewTrialBeginsWithoutSelectedCube) {
  const auto chosen_after = [](const ScreenState& next) {
    Fixture fixture;
    fixture.screens.show(trial_state("sorting"), true);
    fixture.tap("cube_1");
    const Turn turn = fixture.screens.show(next, true);
    const bool chosen = fixture.control("cube_1").chosen;
    EXPECT_EQ(turn, chosen ? Turn::none : Turn::page);
    return chosen;
  };
  const ScreenState same = trial_state("sorting");
  EXPECT_TRUE(chosen_after(same));
  for (int ScreenState::*number :
       {&ScreenState::trial_number, &ScreenState::attempt, &ScreenState::n_reshuffles}) {
    ScreenState other = same;
    ++(other.*number);
    EXPECT_FALSE(chosen_after(other));
  }
  EXPECT_FALSE(chosen_after(trial_state("comparison")));
}

TEST(Screens, AppearingCubesDoNotTurnThePage) {
  Fixture fixture;
  ScreenState state = trial_state("comparison");
  EXPECT_EQ(fixture.screens.show(state, false), Turn::page);
  EXPECT_EQ(fixture.screens.show(state, true), Turn::cubes);
  EXPECT_EQ(fixture.screens.show(state, true), Turn::none);
  state.trial_number = 2;
  state.faded = 0.2;
  EXPECT_EQ(fixture.screens.show(state, true), Turn::page);
  EXPECT_THAT(names(fixture.page(), true), ElementsAre()) << "those cubes belong to the last trial";
  EXPECT_EQ(fixture.page().notice, "Next cubes");
  for (const bool correct : {true, false}) {
    state.feedback = correct;
    fixture.screens.show(state, true);
    EXPECT_EQ(fixture.page().notice, correct ? "Correct" : "Not correct") << "after practice";
  }
  state.feedback.reset();
  EXPECT_FLOAT_EQ(fixture.page().scene_opacity, 0.8f);
  state.faded.reset();
  EXPECT_EQ(fixture.screens.show(state, true), Turn::cubes);
  EXPECT_FALSE(names(fixture.page(), true).empty());
}

TEST(Screens, ChoiceRemainsMarkedWhileItsCubesFade) {
  for (const char* named : {"cube_2", "no_difference"}) {
    Fixture fixture;
    ScreenState state = trial_state("comparison");
    fixture.screens.show(state, true);
    fixture.tap(named);
    const auto chosen = [&] {
      std::vector<std::string> all;
      for (const Control& control : fixture.page().controls)
        if (control.chosen) all.push_back(control.name);
      return all;
    };
    EXPECT_THAT(chosen(), ElementsAre()) << "the session has not accepted it yet";
    state.trial_number = 2;
    state.faded = 0.1;
    fixture.screens.show(state, true);
    EXPECT_THAT(chosen(), ElementsAre(named));
    state.faded.reset();
    fixture.screens.show(state, true);
    EXPECT_THAT(chosen(), ElementsAre()) << "the next cubes are another question";
  }
}

TEST(Screens, HintsDependOnTheProtocol) {
  Fixture fixture;
  ScreenState state = trial_state("comparison");
  state.can_answer = false;
  fixture.screens.show(state, true);
  EXPECT_EQ(fixture.page().notice, "");
  state.touch_first = true;
  fixture.screens.show(state, true);
  EXPECT_THAT(fixture.page().notice, testing::HasSubstr("Push every cube"));
}

TEST(Screens, PauseReturnsToTheSameQuestion) {
  Fixture fixture;
  fixture.screens.show(page_state(Screen::about_you), false);
  fixture.tap("age_25_34");
  fixture.tap("next");
  fixture.tap("next");
  ASSERT_TRUE(fixture.control("handedness_left").enabled);
  fixture.screens.show(page_state(Screen::paused), false);
  fixture.screens.show(page_state(Screen::about_you), false);
  EXPECT_TRUE(fixture.control("handedness_left").enabled);
  fixture.tap("back");
  fixture.tap("back");
  EXPECT_TRUE(fixture.control("age_25_34").chosen);
}

TEST(Screens, FormContinuesWithFirstUnansweredQuestion) {
  Fixture fixture;
  ScreenState state = page_state(Screen::about_you);
  state.entries = {{"age", "25_34"}, {"gender", "man"}};
  fixture.screens.show(state, false);
  EXPECT_TRUE(fixture.control("handedness_left").enabled);
}

TEST(Screens, AgreeIsApartFromMoreAndNeedsReadingTime) {
  for (const Measures& window : windows) {
    ScreenTexts texts = shipped_texts("en");
    for (int i = 0; i < 400; ++i) texts.pages["consent"]["text"] += " and so on";
    Fixture fixture("en", window);
    fixture.screens = Screens(texts, false);
    fixture.screens.show(page_state(Screen::consent), false);
    const Rect more = fixture.control("more").area;
    while (testing::Value(names(fixture.page()), testing::Contains("more"))) fixture.tap("more");
    for (const char* name : {"next", "decline"})
      EXPECT_FALSE(overlap(fixture.control(name).area, more)) << name;
    for (const double up_s : {0.0, 1.9})
      EXPECT_THAT(names(fixture.screens.page(fixture.typeface, fixture.measures, up_s), true),
                  ElementsAre("back", "decline"));
    EXPECT_THAT(names(fixture.screens.page(fixture.typeface, fixture.measures, 60), true),
                testing::Contains("next"));
  }
}

TEST(Screens, ConsentShowsTheTimeLeftForReading) {
  Fixture fixture;
  fixture.screens.show(page_state(Screen::consent), false);
  const auto note_after = [&](double up_s) {
    const Page page = fixture.screens.page(fixture.typeface, fixture.measures, up_s);
    return std::ranges::find(page.controls, "next", &Control::name)->note;
  };
  EXPECT_THAT(note_after(0), testing::MatchesRegex("Time to read: 0:0[0-9]"));
  EXPECT_NE(note_after(0), note_after(2));
  EXPECT_EQ(note_after(60), "");
}

TEST(Screens, ReturningFromDecliningNeedsNoReadingTime) {
  Fixture fixture;
  const auto enabled_immediately = [&] {
    return names(fixture.screens.page(fixture.typeface, fixture.measures, 0), true);
  };
  fixture.screens.show(page_state(Screen::consent), false);
  EXPECT_THAT(enabled_immediately(), ElementsAre("decline"));
  fixture.screens.show(page_state(Screen::declined), false);
  fixture.screens.show(page_state(Screen::consent), false);
  EXPECT_THAT(enabled_immediately(), ElementsAre("next", "decline"));
  fixture.screens.show(page_state(Screen::paused), false);
  fixture.screens.show(page_state(Screen::consent), false);
  EXPECT_THAT(enabled_immediately(), ElementsAre("next", "decline")) << "also after a pause";
}

TEST(Screens, ValidationIsDisabledUntilAllowed) {
  Fixture fixture;
  ScreenState state = trial_state("sorting");
  fixture.screens.show(state, true);
  EXPECT_FALSE(fixture.control("validate").enabled);
  state.can_validate = true;
  fixture.screens.show(state, true);
  EXPECT_EQ(action(fixture.tap("validate")).kind, "validate");
}

TEST(Screens, FormShowsOneSkippableQuestionAtATime) {
  Fixture fixture;
  fixture.screens.show(page_state(Screen::about_you), false);
  EXPECT_THAT(names(fixture.page()), IsSupersetOf({"age_18_24", "next"}));
  EXPECT_EQ(fixture.control("next").text, "Skip");
  const auto entry = fixture.tap("age_25_34");
  EXPECT_EQ(entry->kind, TouchKind::entry);
  EXPECT_EQ(entry->key, "age");
  EXPECT_EQ(entry->value, "25_34");
  EXPECT_TRUE(fixture.control("age_25_34").chosen);
  EXPECT_EQ(fixture.control("next").text, "Continue");
  for (int question = 1; question < 5; ++question) EXPECT_FALSE(fixture.tap("next"));
  EXPECT_EQ(fixture.tap("next")->kind, TouchKind::next);
  for (int question = 1; question < 5; ++question) EXPECT_FALSE(fixture.tap("back"));
  EXPECT_TRUE(fixture.control("age_25_34").chosen);
}

TEST(Screens, LongTextHasPartsAndAgreeOnTheLast) {
  ScreenTexts texts = shipped_texts("en");
  std::string& text = texts.pages["consent"]["text"];
  for (int i = 0; i < 200; ++i) text += (i % 20 ? " word" : "\n\nword") + std::to_string(i);
  Fixture fixture;
  fixture.screens = Screens(texts, false);
  fixture.screens.show(page_state(Screen::consent), false);
  std::set<std::string> seen;
  const auto read = [&] {
    for (const TextLine& line : fixture.page().lines) {
      EXPECT_LE(line.y + line.size_px, fixture.page().controls.front().area.y);
      std::istringstream words(line.text);
      for (std::string word; words >> word;) seen.insert(word);
    }
  };
  int n_parts = 1;
  for (; testing::Value(names(fixture.page()), testing::Contains("more")); ++n_parts) {
    ASSERT_LT(n_parts, 20);
    EXPECT_THAT(names(fixture.page()), testing::Not(testing::Contains("decline")));
    read();
    EXPECT_FALSE(fixture.tap("more"));
  }
  read();
  EXPECT_GE(n_parts, 3);
  for (int i = 0; i < 200; ++i) EXPECT_TRUE(seen.contains("word" + std::to_string(i))) << i;
  EXPECT_THAT(names(fixture.page()), ElementsAre("back", "next", "decline"));
}

TEST(Screens, LeftHandMirrorsControlsButNotCubes) {
  const auto areas = [](bool left_handed) {
    Fixture fixture("en", {1024, 600}, left_handed);
    fixture.screens.show(trial_state("sorting"), true);
    return std::tuple(*fixture.page().scene, fixture.control("cube_1").area,
                      fixture.control("cube_3").area, fixture.control("validate").area);
  };
  for (const bool left_handed : {false, true}) {
    const auto [scene, first, last, validate] = areas(left_handed);
    EXPECT_EQ(validate.right() <= scene.x, left_handed);
    EXPECT_EQ(validate.x >= scene.right(), !left_handed);
    EXPECT_LT(first.x, last.x);
  }
  Fixture left("en", {1024, 600}, true), right;
  for (Fixture* fixture : {&left, &right})
    fixture->screens.show(page_state(Screen::welcome), false);
  EXPECT_LT(left.control("next").area.right(), 512);
  EXPECT_GT(right.control("next").area.x, 512);
}

TEST(Screens, AllCubesLookTheSame) {
  Fixture fixture;
  fixture.screens.show(trial_state("sorting"), true);
  const Control first = fixture.control("cube_1"), last = fixture.control("cube_3");
  EXPECT_EQ(first.area.width, last.area.width);
  EXPECT_EQ(first.area.height, last.area.height);
  EXPECT_EQ(first.look, last.look);
}

TEST(Typeface, CharacterWithoutFontIsRefused) {
  ScreenTexts texts = shipped_texts("en");
  texts.pages["welcome"]["title"] = "\U00010FFF";  // unassigned
  try {
    const Typeface typeface(texts);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::invalid_file);
    EXPECT_THAT(error.what(), testing::HasSubstr("U+10FFF in welcome.title"));
  }
}

TEST(Typeface, InstalledFontsHaveOtherScripts) {
  ScreenTexts texts = shipped_texts("en");
  texts.pages["welcome"]["title"] =
      "Добро пожаловать Καλώς ήρθατε Vítejte Ťŕíźňę שלום مرحبا 歓迎 \u200f\u00a0";
  EXPECT_NO_THROW(Typeface{texts});
  EXPECT_THAT(missing_characters(texts), testing::IsEmpty());
}

TEST(Typeface, ArabicLettersJoin) {
  const Typeface typeface(texts_in("ar"));
  constexpr float size_px = 40;
  // Joined letters have narrower forms than isolated ones.
  EXPECT_LT(typeface.width_px("ععع", size_px), 0.95f * 3 * typeface.width_px("ع", size_px));
  EXPECT_EQ(typeface.written("ععع", size_px).direction, Direction::right_to_left);
}

TEST(Typeface, LineHasItsLanguagesDirectionUnlessAllLettersHaveTheOther) {
  const Typeface arabic(texts_in("ar")), english(texts_in("en"));
  EXPECT_TRUE(arabic.reads_right_to_left());
  EXPECT_FALSE(english.reads_right_to_left());
  const auto leftward = [](const Typeface& typeface, const std::string& line) {
    return typeface.written(line, 20).direction == Direction::right_to_left;
  };
  EXPECT_TRUE(leftward(arabic, "3 / 5"));
  EXPECT_FALSE(leftward(english, "3 / 5"));
  EXPECT_TRUE(leftward(arabic, "NASA مكعب"));
  EXPECT_FALSE(leftward(arabic, "Heft"));
  EXPECT_FALSE(leftward(english, "مكعب cube"));
  EXPECT_TRUE(leftward(english, "مكعب"));
}

TEST(Typeface, TextWithoutSpacesIsBrokenByItsScriptsRules) {
  const Typeface typeface(texts_in("ja"));
  const std::string text =
      "同じように見える二つの立方体が現れます。一方は他方より重くなっています。";
  const auto lines = typeface.wrapped(text, 30, 300);
  EXPECT_GT(lines.size(), 2U);
  std::string all;
  for (const std::string& line : lines) {
    EXPECT_LE(typeface.width_px(line, 30), 300);
    EXPECT_FALSE(line.starts_with("。")) << "no line begins with a full stop";
    all += line;
  }
  EXPECT_EQ(all, text);
}

TEST(Typeface, MeasuredWidthIsDrawnWidth) {
  for (const char* language : {"en", "ar", "ja"}) {
    const ScreenTexts texts = texts_in(language);
    const Typeface typeface(texts);
    for (const auto& [key, text] : texts.pages.at("trial_sorting"))
      for (const float size_px : {12.f, 25.2f, 71.f}) {
        const Ink ink = typeface.ink(typeface.written(text, size_px));
        const auto width = static_cast<float>(ink.width);
        const float measured = typeface.width_px(text, size_px);
        EXPECT_LE(width, measured + 4 + 0.12f * size_px) << text;
        EXPECT_GE(width, measured - size_px) << text << ": a full stop may have half its size free";
        EXPECT_GE(ink.top, -0.3f * size_px) << text;
        EXPECT_LE(ink.top + ink.height, 1.3f * size_px + 2) << text;
        EXPECT_GT(std::ranges::max(ink.coverage), 200) << text;
      }
  }
}

TEST(TextFit, ShippedTextsFitTheSmallestScreen) {
  for (const char* language : {"en", "fr", "ar", "ja"})
    EXPECT_THAT(texts_that_do_not_fit(texts_in(language), smallest_screen()), testing::IsEmpty());
}

TEST(TextFit, LargeTextShrinksWhereSpaceIsShort) {
  for (const char* language : {"en", "fr", "ar", "ja"})
    EXPECT_THAT(texts_that_do_not_fit(texts_in(language), smallest_screen(2)),
                testing::Each(testing::HasSubstr("only in small letters")));
}

TEST(TextFit, TooLongTextsAreNamed) {
  ScreenTexts texts = shipped_texts("en");
  texts.pages["trial_sorting"]["dont_know"] = "Rindfleischetikettierungsüberwachungsaufgabe";
  texts.pages["welcome"]["title"] = std::string(60, 'W');
  texts.pages["trial"]["touch_every_cube"] = std::string(80, 'M');
  const auto found = texts_that_do_not_fit(texts, smallest_screen());
  EXPECT_THAT(found, IsSupersetOf(std::vector<testing::Matcher<std::string>>{
                         testing::StartsWith("trial_sorting: \"Rindfleisch"),
                         testing::StartsWith("welcome: \"WWW"),
                         testing::StartsWith("trial_comparison: \"MMM")}));
  EXPECT_THAT(texts_that_do_not_fit(shipped_texts("en"), smallest_screen(2)),
              testing::Not(testing::IsEmpty()))
      << "twice as large is too large somewhere";
}

TEST(Screens, RightToLeftFormBeginsAtTheRight) {
  Fixture fixture("ar");
  fixture.screens.show(page_state(Screen::about_you), false);
  EXPECT_GT(fixture.control("age_under_18").area.x, fixture.control("age_18_24").area.right());
  const TextLine title = fixture.page().lines.front();
  EXPECT_GT(title.x, 512) << "and so do lines";
}

}  // namespace
}  // namespace heft
