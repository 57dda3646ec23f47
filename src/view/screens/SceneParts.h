// What the screens of trials are put together from: the scene with its question, the column of
// controls beside it, buttons for cubes. Each task has a screen in a file of its own.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "view/screens/ScreenPages.h"

namespace heft {

/// Controls stand in a column on the side of the hand; what is asked is above the scene.
Rect column_of(const PageBuilder& builder);
void add_scene(PageBuilder& builder, const std::string& above);

/// The i-th of n equal cells of a row.
Rect cell(const Rect& row, int i, int n, float gap);
/// So many buttons beside each other are large enough to be touched.
int in_a_row(int n);
Rect rows_below(const Rect& row, int n, float gap);
Rect bottom_row(const PageBuilder& builder);

/// The place of a cube in words, where ranks are numbers in letters.
std::string slot_words(const PageBuilder& builder, int slot, int n_slots);

/// Buttons that stand for the cubes, in the cubes' order for either hand; in two rows where there
/// are too many for one.
void add_cubes(PageBuilder& builder, const Rect& row, const std::function<Effect(int)>& effect_of);
/// Two cubes, of which one is chosen with one tap, under the task's question.
void add_choice_of_cube(PageBuilder& builder);
void add_put_back(PageBuilder& builder, const Rect& area);
/// What must be done before an answer is possible.
void add_hint(PageBuilder& builder);
/// What was answered last stays marked until its cubes are gone, so that people see that it
/// counted.
void mark_named(PageBuilder& builder);

/// The page of texts of the trial's task.
std::string trial_page(const PageBuilder& builder);
/// An answer can be given: its cubes are there.
bool can_answer(const PageBuilder& builder);
/// What a tap does that is an answer.
Touch answer_touch(Action action);

}  // namespace heft
