// Simulated people who read the buttons in their language and tap their intended answers, which the
// log must have, in every language and window size, right-handed and left-handed. HEFT_SESSIONS
// sets their number; the seed of a failure is printed.
#include <gmock/gmock.h>

#include <cstdlib>

#include "SourceFolder.h"
#include "base/Random.h"
#include "protocol/readers/Files.h"
#include "session/TappedSession.h"
#include "tasks/Offers.h"

namespace heft {
namespace {

using testing::made_up_s;
using testing::Tap;
using testing::TappedScreen;
using testing::TappedSession;

/// The intended answer to a trial.
struct Meant {
  std::vector<Label> labels;      ///< sorting: from left to right
  std::optional<int> slot;        ///< a choice; none: no difference
  std::optional<int> first_slot;  ///< introduction: tried before the others
};

/// Taps buttons by their words, anywhere within them, again if nothing changes.
class Person {
 public:
  Person(std::uint64_t seed, const ScreenTexts& texts) : random_(seed, "person"), texts_(texts) {}

  std::optional<Tap> operator()(const TappedScreen& screen) {
    const Control* button = wanted(screen);
    if (button == nullptr || !button->enabled) return std::nullopt;
    const double down_s = made_up_s + 0.2 + 0.4 * random_.uniform();
    const Rect& area = button->area;
    return Tap{down_s, down_s + 0.02 + 0.1 * random_.uniform(),
               area.x + static_cast<float>(random_.uniform()) * 0.99f * area.width,
               area.y + static_cast<float>(random_.uniform()) * 0.99f * area.height};
  }

  std::map<int, Meant> trials;                 ///< by number
  std::map<std::string, std::string> entries;  ///< of forms

 private:
  const Control* saying(const TappedScreen& screen, const std::string& words) const {
    for (const Control& control : screen.page().controls)
      if (control.text == words) return &control;
    return nullptr;
  }

  const Control* wanted(const TappedScreen& screen) {
    const std::string& more = texts_.at("buttons", "more");
    if (const Control* reads_on = saying(screen, more)) return reads_on;
    switch (screen.screen().screen) {
      case Screen::trial:
        return wanted_in_trial(screen);
      case Screen::about_you:
      case Screen::how_decided:
        return wanted_in_form(screen);
      case Screen::consent:
        return saying(screen, texts_.at("consent", "agree"));
      default:
        return leading_on(screen);
    }
  }

  const Control* leading_on(const TappedScreen& screen) const {
    for (const char* word : {"start", "next", "finish"})
      if (const Control* button = saying(screen, texts_.at("buttons", word))) return button;
    return nullptr;
  }

  // Recognizes the question by its words; skips some questions.
  const Control* wanted_in_form(const TappedScreen& screen) {
    const std::string page(name_of(screen.screen().screen));
    for (const auto& [key, question] : texts_.pages.at(page)) {
      if (key == "title" || !reads(screen, question)) continue;
      if (!entries.contains(key)) entries[key] = choice(screen, page, key);
      const Control* wanted = saying(screen, texts_.at(page, key + '_' + entries[key]));
      return wanted != nullptr && !wanted->chosen ? wanted : leading_on(screen);
    }
    return nullptr;
  }

  static bool reads(const TappedScreen& screen, const std::string& question) {
    std::string all;
    for (const TextLine& line : screen.page().lines)
      for (const char c : line.text)
        if (c != ' ') all += c;
    std::string sought = question;
    std::erase(sought, ' ');
    return all.find(sought) != std::string::npos;
  }

  std::string choice(const TappedScreen& screen, const std::string& page, const std::string& key) {
    std::vector<std::string> values;
    for (const auto& [other, words] : texts_.pages.at(page))
      if (other.starts_with(key + '_') && saying(screen, words) != nullptr)
        values.push_back(other.substr(key.size() + 1));
    return values.at(random_.below(values.size()));
  }

  const Control* wanted_in_trial(const TappedScreen& screen) {
    const ScreenState& state = screen.screen();
    if (state.faded) return nullptr;
    if (!trials.contains(state.trial_number)) trials[state.trial_number] = meant(state);
    const Meant& meant = trials[state.trial_number];
    if (state.task == "sorting") return next_of_sorting(screen, meant);
    if (state.task == "introduction") {
      const int other = 3 - *meant.first_slot;
      return cube(screen, state.n_choices % 2 == 0 ? *meant.first_slot : other);
    }
    if (meant.slot) return cube(screen, *meant.slot);
    return saying(screen, texts_.at("trial_comparison", "no_difference"));
  }

  Meant meant(const ScreenState& state) {
    Meant meant;
    const int slot = 1 + static_cast<int>(random_.below(2));
    if (state.task == "introduction") meant.first_slot = slot;
    if (state.task == "comparison" && random_.coin(0.7)) meant.slot = slot;
    if (state.task == "sorting") {
      meant.labels = {"lightest", "intermediate", "heaviest"};
      random_.shuffle(std::span(meant.labels));
    }
    return meant;
  }

  const Control* cube(const TappedScreen& screen, int slot) const {
    const int n = screen.screen().n_slots;
    return saying(screen, texts_.at("slots", slot == 1 ? "left" : slot == n ? "right" : "middle"));
  }

  // Gives one label after the other, and corrects wrong ones.
  const Control* next_of_sorting(const TappedScreen& screen, const Meant& meant) const {
    const auto given = labels_on(screen.screen());
    for (int slot = 1; slot <= 3; ++slot) {
      const auto i = static_cast<std::size_t>(slot - 1);
      if (given[i] == meant.labels[i]) continue;
      const Control* its = cube(screen, slot);
      if (its == nullptr || !its->chosen) return its;
      return saying(screen, texts_.at("trial_sorting", std::string(name_of(meant.labels[i]))));
    }
    return saying(screen, texts_.at("trial_sorting", "validate"));
  }

  RandomStream random_;
  const ScreenTexts& texts_;
};

ScreenTexts texts_in(const std::string& language) {
  const char* folder = language == "en" || language == "fr" ? "/protocols/texts/" : "/tests/texts/";
  return load_texts(source_folder() + std::string(folder) + language + ".toml");
}

// A trial's answers, from the log alone.
struct Logged {
  std::vector<std::optional<Label>> labels = std::vector<std::optional<Label>>(3);
  std::vector<Action> choices;
  bool validated = false;
};

std::map<int, Logged> logged_trials(const RecordedSession& sink) {
  std::map<int, Logged> trials;
  int number = 0;
  for (const RecordedEntry& entry : sink.entries()) {
    const auto* recorded = std::get_if<RecordedEvent>(&entry);
    if (!recorded) continue;
    if (recorded->event.as<TrialStarted>()) ++number;  // none is void here
    const auto* action = recorded->event.as<Action>();
    if (!action) continue;
    Logged& trial = trials[number];
    if (action->kind == "label") {
      for (auto& label : trial.labels)
        if (label == action->label) label.reset();
      trial.labels.at(static_cast<std::size_t>(*action->slot - 1)) = action->label;
    } else if (action->kind == "validate") {
      trial.validated = true;
    } else {
      trial.choices.push_back(*action);
    }
  }
  return trials;
}

void expect_meant(const Meant& meant, const Logged& logged) {
  if (!meant.labels.empty()) {
    EXPECT_TRUE(logged.validated);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(logged.labels[i], meant.labels[i]) << i;
  } else if (meant.first_slot) {
    EXPECT_EQ(logged.choices.at(0).slot, meant.first_slot);
  } else {
    ASSERT_EQ(logged.choices.size(), 1U) << "one answer, final at once";
    EXPECT_EQ(logged.choices[0].kind, meant.slot ? "select" : "no_difference");
    EXPECT_EQ(logged.choices[0].slot, meant.slot);
  }
}

TEST(WholeSessions, WhatPeopleMeantIsWhatIsLoggedInEveryLanguageSizeAndHand) {
  const std::array languages{"en", "ar", "ja"};
  const std::array<Measures, 3> windows{Measures{1024, 600}, {1280, 800, 1.3f}, {1920, 1080, 0.8f}};
  const char* asked = std::getenv("HEFT_SESSIONS");
  const std::uint64_t n_sessions = asked ? std::stoul(asked) : 18;
  std::size_t n_trials = 0, n_entries = 0;
  for (std::uint64_t i = 0; i < n_sessions; ++i) {
    // Eighteen successive sessions have each language with each size and hand.
    const char* language = languages[i % 3];
    const Measures& window = windows[(i + i / 6) % 3];
    const bool left_handed = i % 2 == 1;
    SCOPED_TRACE("seed " + std::to_string(i) + ", " + language);
    const ScreenTexts texts = texts_in(language);
    Person person(i, texts);
    TappedSession session(testing::whole_protocol(15, 6), texts, std::ref(person), window,
                          left_handed);
    ASSERT_EQ(session.run(), RunEnd::finished);
    const auto logged = logged_trials(session.sink);
    ASSERT_EQ(logged.size(), person.trials.size());
    for (const auto& [number, meant] : person.trials) {
      SCOPED_TRACE(number);
      expect_meant(meant, logged.at(number));
    }
    EXPECT_EQ(session.sink.header().participant_info, person.entries);
    n_trials += logged.size();
    n_entries += person.entries.size();
  }
  EXPECT_GE(n_trials, 8 * n_sessions);
  EXPECT_EQ(n_entries, 8 * n_sessions);
}

}  // namespace
}  // namespace heft
