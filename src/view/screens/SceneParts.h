// Parts of trial screens: the scene with its question, the column of controls beside it, buttons
// for cubes. Each task's screen has a separate file.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "view/screens/ScreenPages.h"

namespace heft {

/// The column of controls, on the side of the tapping hand; the question is above the scene.
Rect column_of(const PageBuilder& builder);
void add_scene(PageBuilder& builder, const std::string& above);

/// The i-th of n equal cells of a row.
Rect cell(const Rect& row, int i, int n, float gap);
/// Number of buttons in a row that are large enough to be touched.
int in_a_row(int n);
Rect rows_below(const Rect& row, int n, float gap);
Rect bottom_row(const PageBuilder& builder);

/// A cube's place in words; letters where ranks are numbers.
std::string slot_words(const PageBuilder& builder, int slot, int n_slots);

/// Buttons for the cubes, in the cubes' order for either hand; in two rows if necessary.
void add_cubes(PageBuilder& builder, const Rect& row, const std::function<Effect(int)>& effect_of);
/// Two cubes below the task's question; one tap chooses one.
void add_choice_of_cube(PageBuilder& builder);
void add_put_back(PageBuilder& builder, const Rect& area);
/// What must be done before an answer is possible.
void add_hint(PageBuilder& builder);
/// Marks the last answer until its cubes disappear, as a confirmation.
void mark_named(PageBuilder& builder);

/// The page of texts of the trial's task.
std::string trial_page(const PageBuilder& builder);
/// Whether an answer can be given: the cubes are visible.
bool can_answer(const PageBuilder& builder);
/// The effect of a tap that is an answer.
Touch answer_touch(Action action);

}  // namespace heft
