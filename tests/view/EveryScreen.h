// Every screen of the participant in every visually different state, for tests.
#pragma once

#include <string>
#include <vector>

#include "SourceFolder.h"
#include "base/PoseTypes.h"
#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "protocol/readers/Files.h"
#include "tasks/Offers.h"
#include "tasks/Task.h"
#include "view/ArView.h"
#include "view/screens/Page.h"

namespace heft {

/// With a tolerance of a hundredth of a pixel.
inline bool inside(const Rect& inner, const Rect& outer) {
  constexpr float rounding = 0.01f;
  return inner.x >= outer.x - rounding && inner.y >= outer.y - rounding &&
         inner.right() <= outer.right() + rounding && inner.bottom() <= outer.bottom() + rounding;
}

struct NamedScreen {
  std::string name;
  ScreenState state;
  bool cubes = true;  ///< in the picture
};

inline ScreenTexts shipped_texts(const std::string& language) {
  return load_texts(source_folder() + "/protocols/texts/" + language + ".toml");
}

/// Shipped texts, or texts of the tests in other scripts.
inline ScreenTexts texts_in(const std::string& language) {
  if (language == "en" || language == "fr") return shipped_texts(language);
  return load_texts(source_folder() + "/tests/texts/" + language + ".toml");
}

inline ScreenState sorting_state(int n_slots) {
  ScreenState state;
  state.screen = Screen::trial;
  state.task = "sorting";
  state.n_slots = n_slots;
  labels_on(state).assign(static_cast<std::size_t>(n_slots), std::nullopt);
  return state;
}

inline ScreenState trial_state(const Task& task) {
  ScreenState state;
  state.screen = Screen::trial;
  state.task = task;
  state.n_slots = task == "sorting" ? 3 : 2;
  if (task == "sorting") labels_on(state).assign(3, std::nullopt);
  return state;
}

inline ScreenState page_state(Screen screen, Task task = "sorting", double wait_s = 0) {
  ScreenState state;
  state.screen = screen;
  state.task = std::move(task);
  state.wait_s = wait_s;
  return state;
}

inline std::vector<NamedScreen> page_screens() {
  return {{"consent", page_state(Screen::consent)},
          {"welcome", page_state(Screen::welcome)},
          {"about_you", page_state(Screen::about_you)},
          {"demonstration_waiting", page_state(Screen::demonstration, "sorting", 5)},
          {"demonstration", page_state(Screen::demonstration)},
          {"instructions_introduction", page_state(Screen::instructions, "introduction")},
          {"instructions_sorting", page_state(Screen::instructions, "sorting")},
          {"instructions_comparison", page_state(Screen::instructions, "comparison")},
          {"instructions_after_practice", page_state(Screen::instructions, "after_practice")},
          {"rest_waiting", page_state(Screen::rest, "sorting", 64.2)},
          {"rest", page_state(Screen::rest)},
          {"paused", page_state(Screen::paused)},
          {"how_decided", page_state(Screen::how_decided)},
          {"thanks", page_state(Screen::thanks)},
          {"declined", page_state(Screen::declined)},
          {"setting_up", page_state(Screen::setting_up)}};
}

inline std::vector<NamedScreen> trial_screens() {
  ScreenState untouched = trial_state("sorting");
  untouched.can_answer = false;
  untouched.touch_first = true;
  ScreenState fading = trial_state("comparison");
  fading.can_answer = false;
  fading.faded = 0.5;
  ScreenState again = trial_state("introduction");
  again.try_again = true;
  again.n_choices = 1;
  ScreenState labeled = trial_state("sorting");
  labels_on(labeled) = {"intermediate", "lightest", "heaviest"};
  labeled.can_validate = true;
  labeled.n_choices = 3;
  ScreenState ranked = sorting_state(6);
  labels_on(ranked)[4] = "1";
  labels_on(ranked)[0] = "6";
  return {{"sorting_2", sorting_state(2)},
          {"sorting_4", sorting_state(4)},
          {"sorting_5", sorting_state(5)},
          {"sorting_6", ranked},
          {"sorting_without_cubes", untouched, false},
          {"sorting_untouched", untouched},
          {"sorting", trial_state("sorting")},
          {"sorting_labeled", labeled},
          {"introduction", trial_state("introduction")},
          {"introduction_again", again},
          {"comparison", trial_state("comparison")},
          {"comparison_fading", fading}};
}

/// The fullest screens of each task that the texts include, with and without cubes.
inline std::vector<NamedScreen> task_screens(const ScreenTexts& texts) {
  std::vector<NamedScreen> all;
  for (const Task task : words_of<Task>()) {
    if (!texts.pages.contains(text_page(Screen::trial, task))) continue;
    all.push_back({"instructions_" + task, page_state(Screen::instructions, task)});
    for (const auto& [wording, texts_of_trials] : task_named(task).wordings) {
      ScreenState state = page_state(Screen::instructions, task);
      if (texts.if_any(text_page(state), instructions_key(wording)).empty()) continue;
      state.wording = wording;
      all.push_back({"instructions_" + task + ", " + state.wording, state});
    }
    for (ScreenState state : fullest_screens(task)) {
      state.screen = Screen::trial;
      state.task = task;
      all.push_back({task + " of the task", state});
      all.push_back({task + " of the task without cubes", state, false});
    }
  }
  return all;
}

inline std::vector<NamedScreen> every_screen(const ScreenTexts& texts) {
  auto all = page_screens();
  for (auto& screen : trial_screens()) all.push_back(std::move(screen));
  for (auto& screen : task_screens(texts)) all.push_back(std::move(screen));
  return all;
}

/// The paper's cubes side by side, and the effector in front of them.
inline ViewSetup setup_for(const std::string& language, int n_cubes = 3) {
  ViewSetup setup;
  setup.texts = texts_in(language);
  for (int i = 0; i < n_cubes; ++i)
    setup.stage.slots_m.emplace_back(0.07 * (i - 0.5 * (n_cubes - 1)), 0.03, 0.0175);
  return setup;
}

inline ViewFrame picture_of(const ViewSetup& setup, bool cubes = true) {
  ViewFrame shown;
  const Pose effector = upright_pose({0.02, -0.09, 0.02}, 1.5707963);
  shown.frame.effector = effector;
  shown.frame.clone = effector;
  if (cubes)
    for (const auto& slot_m : setup.stage.slots_m)
      shown.frame.cubes.push_back(upright_pose(slot_m, 0));
  return shown;
}

}  // namespace heft
