#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tasks/Sorting.h"
#include "view/screens/ScreenPages.h"

namespace heft {

namespace {
using Labels = std::vector<std::optional<Label>>;

bool is_rank(std::string_view label) {
  return std::isdigit(static_cast<unsigned char>(label.front())) != 0;
}

// A label's text on a cube; ranks are numbers in every language.
std::string label_words(const PageBuilder& builder, std::string_view label) {
  return is_rank(label) ? std::string(label) : builder.text("trial_sorting", std::string(label));
}

// The question of a sorting trial; for ranks also which end is which.
std::string sorting_question(const PageBuilder& builder) {
  const std::string question = builder.text("trial_sorting", "question");
  const auto labels = Sorting::labels_for(builder.state.n_slots);
  if (!is_rank(labels.front())) return question;
  return fmt::format("{} {} = {}, {} = {}", question, labels.front(),
                     label_words(builder, "lightest"), labels.back(),
                     label_words(builder, "heaviest"));
}

bool all_labeled(const PageBuilder& builder, const Labels& given) {
  return static_cast<int>(std::ranges::count_if(
             given, [](const auto& label) { return label.has_value(); })) == builder.state.n_slots;
}

// The place of the cube that has a label; empty: none has. Shown on the labels' buttons, because
// three labels side by side would be too small to read.
std::string labeled_place(const PageBuilder& builder, const Labels& given, const Label& label) {
  const auto found = std::ranges::find(given, label);
  if (found == given.end()) return {};
  return slot_words(builder, static_cast<int>(found - given.begin()) + 1, builder.state.n_slots);
}

// Gives the selected cube a label, or removes its label.
void add_label(PageBuilder& builder, const Labels& given, const Label& label, const Rect& area,
               char key) {
  const int slot = builder.memory.selected.value_or(0);
  const auto i = static_cast<std::size_t>(slot - 1);
  const bool has_it = slot > 0 && i < given.size() && given[i] == label;
  Control& button = builder.add_button(
      "label_" + label, area, label_words(builder, label),
      answer_touch(has_it ? Action{"unlabel", slot} : Action{"label", slot, label}), key);
  button.note = labeled_place(builder, given, label);
  button.enabled = can_answer(builder) && slot > 0;
  button.chosen = has_it;
}

void mark_cubes(PageBuilder& builder, const Labels& given) {
  for (int slot = 1; slot <= builder.state.n_slots; ++slot) {
    const auto i = static_cast<std::size_t>(slot - 1);
    CubeMark mark{slot, "", builder.memory.selected == slot};
    if (i < given.size() && given[i]) mark.text = label_words(builder, *given[i]);
    if (mark.selected || !mark.text.empty()) builder.page.marks.push_back(std::move(mark));
  }
}

// Up to three labels have a row each; more are arranged like the cubes.
void add_labels(PageBuilder& builder, const Labels& given, const Rect& first_row) {
  const auto labels = Sorting::labels_for(builder.state.n_slots);
  const int n = builder.state.n_slots, n_beside = n <= 3 ? 1 : in_a_row(n);
  const float gap = builder.measures.gap;
  for (int i = 0; i < n; ++i) {
    const std::string_view label = labels[static_cast<std::size_t>(i)];
    add_label(builder, given, label,
              cell(rows_below(first_row, i / n_beside, gap), i % n_beside, n_beside, gap),
              is_rank(label) ? '\0' : label.front());
  }
}
}  // namespace

void Sorting::screen(PageBuilder& builder, const Offer& offer) {
  add_scene(builder, sorting_question(builder));
  add_hint(builder);
  if (builder.page.notice.empty() && !builder.memory.selected &&
      !all_labeled(builder, offer.labels))
    builder.page.notice = builder.text("trial_sorting", "tap_a_cube");
  mark_cubes(builder, offer.labels);

  const int n_cube_rows = builder.state.n_slots > 3 ? 2 : 1;
  const int n_label_rows = builder.state.n_slots > 3 ? 2 : builder.state.n_slots;
  const int n_rows = n_cube_rows + n_label_rows + 2;
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const auto n = static_cast<float>(n_rows);
  const float height = std::min((column.height - (n - 1) * m.gap) / n, 1.2f * m.target);
  const Rect first{column.x, column.y, column.width, height};
  add_cubes(builder, first, [](int slot) { return SelectCube{slot}; });
  add_labels(builder, offer.labels, rows_below(first, n_cube_rows, m.gap));
  const Rect below = rows_below(first, n_cube_rows + n_label_rows, m.gap);
  Control& validate =
      builder.add_button("validate", below, builder.text("trial_sorting", "validate"),
                         answer_touch({"validate"}), key_enter);
  validate.look = Look::primary;
  validate.enabled = builder.state.can_validate && builder.memory.cubes_shown;
  const Rect last{column.x, column.bottom() - height, column.width, height};
  builder
      .add_button("dont_know", cell(last, 0, 2, m.gap), builder.text("trial_sorting", "dont_know"),
                  answer_touch({"dont_know"}), 'd')
      .enabled = can_answer(builder);
  add_put_back(builder, cell(last, 1, 2, m.gap));
}

}  // namespace heft
