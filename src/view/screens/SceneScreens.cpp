#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "view/screens/ScreenPages.h"

namespace heft {

namespace {
// Controls stand in a column on the side of the hand; what is asked is above the scene.
Rect column_of(const PageBuilder& builder) {
  const Measures& m = builder.measures;
  const float width = 3.55f * m.target;
  return {builder.left_handed ? m.margin : m.width - m.margin - width, m.margin, width,
          m.height - 2 * m.margin};
}

void add_scene(PageBuilder& builder, const std::string& above) {
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const float x = builder.left_handed ? column.right() + m.margin : m.margin;
  const float width = m.width - column.width - 3 * m.margin;
  const FittedText words =
      builder.typeface.fitted(above, m.body, width, 3 * m.body, m.least_px(m.body));
  const float bottom = builder.add_lines(words.lines, {x, 0, width, 0}, m.margin, words.size_px);
  const float y = bottom + m.gap;
  builder.page.scene = Rect{x, y, width, m.height - m.margin - y};
  builder.page.scene_opacity = static_cast<float>(1 - builder.state.faded.value_or(0));
}

// A row of the column divided into equal cells.
Rect cell(const Rect& row, int i, int n, float gap) {
  const float width = (row.width - gap * static_cast<float>(n - 1)) / static_cast<float>(n);
  return {row.x + static_cast<float>(i) * (width + gap), row.y, width, row.height};
}

// So many buttons beside each other are large enough to be touched.
int in_a_row(int n) {
  return n <= 3 ? n : (n + 1) / 2;
}

Rect rows_below(const Rect& row, int n, float gap) {
  return {row.x, row.y + static_cast<float>(n) * (row.height + gap), row.width, row.height};
}

Rect bottom_row(const PageBuilder& builder) {
  const Rect column = column_of(builder);
  const float height = builder.measures.target;
  return {column.x, column.bottom() - height, column.width, height};
}

std::string slot_words(const PageBuilder& builder, int slot, int n_slots) {
  if (n_slots != 2 && n_slots != 3)  // numbers are ranks
    return std::string(1, static_cast<char>('A' + slot - 1));
  if (slot == 1) return builder.text("slots", "left");
  return builder.text("slots", slot == n_slots ? "right" : "middle");
}

Touch answer(ActionKind kind, std::optional<int> slot = {}, std::optional<Label> label = {}) {
  Touch touch;
  touch.action.kind = kind;
  touch.action.slot = slot;
  touch.action.label = label;
  return touch;
}

// A label as it stands on a cube; ranks are numbers in every language.
std::string label_words(const PageBuilder& builder, Label label) {
  const std::string name(name_of(label));
  return label < Label::rank_1 ? builder.text("trial_sorting", name) : name;
}

// Which end of the order the first and last rank are.
std::string end_words(const PageBuilder& builder, int n_slots, Label end) {
  const auto labels = labels_for(n_slots);
  return fmt::format("{}: {}", name_of(end == Label::lightest ? labels.front() : labels.back()),
                     label_words(builder, end));
}

// What a sorting trial asks, and of ranks which end is which.
std::string sorting_question(const PageBuilder& builder, int n_slots) {
  const std::string question = builder.text("trial_sorting", "question");
  if (n_slots == 3) return question;
  return fmt::format("{} {}, {}", question, end_words(builder, n_slots, Label::lightest),
                     end_words(builder, n_slots, Label::heaviest));
}

// Buttons that stand for the cubes, in the cubes' order for either hand; in two rows where there
// are too many for one.
template <typename EffectOf>
void add_cubes(PageBuilder& builder, const Rect& row, const EffectOf& effect_of) {
  const int n_beside = in_a_row(builder.state.n_slots);
  for (int slot = 1; slot <= builder.state.n_slots; ++slot) {
    const Rect its_row = rows_below(row, (slot - 1) / n_beside, builder.measures.gap);
    Control& button =
        builder.add_button(fmt::format("cube_{}", slot),
                           cell(its_row, (slot - 1) % n_beside, n_beside, builder.measures.gap),
                           slot_words(builder, slot, builder.state.n_slots), effect_of(slot),
                           slot <= 9 ? static_cast<char>('0' + slot) : '\0');
    button.enabled = builder.state.can_answer && builder.memory.cubes_shown;
    button.chosen = builder.memory.selected == slot;
  }
}

void add_put_back(PageBuilder& builder, const Rect& area) {
  builder
      .add_button("put_cubes_back", area, builder.text("buttons", "put_cubes_back"),
                  touch_of(TouchKind::put_cubes_back), key_backspace)
      .enabled = builder.memory.cubes_shown;
}

// What must be done before an answer is possible.
void add_hint(PageBuilder& builder) {
  if (builder.state.faded)
    builder.page.notice = builder.text_if_any("trial", "next_cubes");
  else if (!builder.memory.cubes_shown)
    builder.page.notice = builder.text("trial", "wait_for_cubes");
  else if (builder.state.touch_first)
    builder.page.notice = builder.text("trial", "touch_every_cube");
}

bool all_labeled(const PageBuilder& builder) {
  return static_cast<int>(std::ranges::count_if(builder.state.labels, [](const auto& label) {
           return label.has_value();
         })) == builder.state.n_slots;
}

// The place of the cube that a label is given to; empty: to none. On the labels' buttons, which
// have the room for it: three labels beside each other would be too small to read.
std::string labeled_place(const PageBuilder& builder, Label label) {
  const auto found = std::ranges::find(builder.state.labels, label);
  if (found == builder.state.labels.end()) return {};
  return slot_words(builder, static_cast<int>(found - builder.state.labels.begin()) + 1,
                    builder.state.n_slots);
}

// Gives the selected cube a label, or takes back the one it has.
void add_label(PageBuilder& builder, Label label, const Rect& area, char key) {
  const int slot = builder.memory.selected.value_or(0);
  const auto i = static_cast<std::size_t>(slot - 1);
  const bool given =
      slot > 0 && i < builder.state.labels.size() && builder.state.labels[i] == label;
  const std::string name(name_of(label));
  Control& button = builder.add_button(
      "label_" + name, area, label_words(builder, label),
      given ? answer(ActionKind::unlabel, slot) : answer(ActionKind::label, slot, label), key);
  button.note = labeled_place(builder, label);
  button.enabled = builder.state.can_answer && builder.memory.cubes_shown && slot > 0;
  button.chosen = given;
}

void mark_cubes(PageBuilder& builder) {
  for (int slot = 1; slot <= builder.state.n_slots; ++slot) {
    const auto i = static_cast<std::size_t>(slot - 1);
    CubeMark mark{slot, "", builder.memory.selected == slot};
    if (i < builder.state.labels.size() && builder.state.labels[i])
      mark.text = label_words(builder, *builder.state.labels[i]);
    if (mark.selected || !mark.text.empty()) builder.page.marks.push_back(std::move(mark));
  }
}

// The words each in a row of its own, where there is room for them; ranks like the cubes.
void add_labels(PageBuilder& builder, const Rect& first_row) {
  const auto labels = labels_for(builder.state.n_slots);
  const int n = builder.state.n_slots, n_beside = n <= 3 ? 1 : in_a_row(n);
  const float gap = builder.measures.gap;
  for (int i = 0; i < n; ++i) {
    const Label label = labels[static_cast<std::size_t>(i)];
    const char key = label < Label::rank_1 ? name_of(label).front() : '\0';
    add_label(builder, label,
              cell(rows_below(first_row, i / n_beside, gap), i % n_beside, n_beside, gap), key);
  }
}

// What was answered last stays marked until its cubes are gone, so that people see that it counted.
void mark_named(PageBuilder& builder) {
  if (!builder.state.faded) return;
  for (Control& control : builder.page.controls)
    if (control.name == builder.memory.named) control.chosen = true;
}

// Two cubes, of which one is chosen with one tap.
void choice_screen(PageBuilder& builder) {
  add_scene(builder, builder.text(text_page(Screen::trial, builder.state.task), "question"));
  add_hint(builder);
  const Rect column = column_of(builder);
  add_cubes(builder, {column.x, column.y, column.width, 2 * builder.measures.target},
            [](int slot) { return answer(ActionKind::select, slot); });
  add_put_back(builder, bottom_row(builder));
}
}  // namespace

void demonstration_screen(PageBuilder& builder) {
  add_scene(builder, builder.text("demonstration", "title"));
  const Rect column = column_of(builder);
  const Rect button = bottom_row(builder);
  const Measures& m = builder.measures;
  const float y = builder.page.scene->y;
  const auto words =
      builder.typeface.fitted(builder.text("demonstration", "text"), m.body, column.width,
                              button.y - y - m.gap, m.least_px(m.body));
  builder.add_lines(words.lines, column, y, words.size_px, Tone::soft);
  if (builder.state.wait_s > 0) return;
  builder.add_primary("next", button, builder.text("buttons", "next"), touch_of(TouchKind::next));
}

void introduction_screen(PageBuilder& builder) {
  choice_screen(builder);
  if (builder.state.try_again && builder.page.notice.empty())
    builder.page.notice = builder.text("trial_introduction", "try_again");
}

void comparison_screen(PageBuilder& builder) {
  choice_screen(builder);
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const Rect area{column.x, column.y + 2 * m.target + m.gap, column.width, 1.25f * m.target};
  builder
      .add_button("no_difference", area, builder.text("trial_comparison", "no_difference"),
                  answer(ActionKind::no_difference), 'n')
      .enabled = builder.state.can_answer && builder.memory.cubes_shown;
  mark_named(builder);
}

void sorting_screen(PageBuilder& builder) {
  add_scene(builder, sorting_question(builder, builder.state.n_slots));
  add_hint(builder);
  if (builder.page.notice.empty() && !builder.memory.selected && !all_labeled(builder))
    builder.page.notice = builder.text("trial_sorting", "tap_a_cube");
  mark_cubes(builder);

  const int n_cube_rows = builder.state.n_slots > 3 ? 2 : 1;
  const int n_label_rows = builder.state.n_slots > 3 ? 2 : builder.state.n_slots;
  const int n_rows = n_cube_rows + n_label_rows + 2;
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const auto n = static_cast<float>(n_rows);
  const float height = std::min((column.height - (n - 1) * m.gap) / n, 1.2f * m.target);
  const Rect first{column.x, column.y, column.width, height};
  add_cubes(builder, first, [](int slot) { return SelectCube{slot}; });
  add_labels(builder, rows_below(first, n_cube_rows, m.gap));
  const Rect below = rows_below(first, n_cube_rows + n_label_rows, m.gap);
  Control& validate =
      builder.add_button("validate", below, builder.text("trial_sorting", "validate"),
                         answer(ActionKind::validate), key_enter);
  validate.look = Look::primary;
  validate.enabled = builder.state.can_validate && builder.memory.cubes_shown;
  const Rect last{column.x, column.bottom() - height, column.width, height};
  builder
      .add_button("dont_know", cell(last, 0, 2, m.gap), builder.text("trial_sorting", "dont_know"),
                  answer(ActionKind::dont_know), 'd')
      .enabled = builder.state.can_answer && builder.memory.cubes_shown;
  add_put_back(builder, cell(last, 1, 2, m.gap));
}

}  // namespace heft
