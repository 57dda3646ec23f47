#include <tuple>

#include "tasks/Comparison.h"
#include "view/screens/ScreenPages.h"

namespace heft {

namespace {
constexpr auto page = "trial_comparison";

// Cubes in the picture are no answers here.
void add_same_or_different(PageBuilder& builder) {
  add_scene(builder, builder.text_if_any(page, "question_same_different"));
  add_hint(builder);
  const Rect column = column_of(builder);
  const Rect first{column.x, column.y, column.width, 1.5f * builder.measures.target};
  int i = 0;
  for (const auto& [name, text, key] :
       {std::tuple("no_difference", "same", 's'), std::tuple("different", "different", 'd')})
    builder
        .add_button(name, rows_below(first, i++, builder.measures.gap),
                    builder.text_if_any(page, text), answer_touch({ActionKind(name)}), key)
        .enabled = can_answer(builder);
  add_put_back(builder, bottom_row(builder));
  mark_named(builder);
}
// First the real object is lifted, then compared: its button, then those of the answers.
void add_comparison_with_object(PageBuilder& builder, const Comparison::Offer& offer) {
  const bool by_same = offer.answers == ComparisonAnswers::same_different;
  const std::string lift = builder.text_if_any(page, "lift") + ' ' + offer.object;
  const std::string question =
      builder.text_if_any(page, by_same ? "question_object_same" : "question_object");
  add_scene(builder, offer.was_lifted ? question : lift, {offer.was_lifted ? lift : question});
  add_hint(builder);
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const Rect first{column.x, column.y, column.width, 1.1f * m.target};
  int row = 0;
  const auto add = [&](const std::string& name, const std::string& words, const Action& action,
                       char key) -> Control& {
    return builder.add_button(name, rows_below(first, row++, m.gap), words, answer_touch(action),
                              key);
  };
  Control& lifted = add("lifted", builder.text_if_any(page, "lifted"), {"lifted"}, 'l');
  lifted.enabled =
      (builder.state.can_answer || builder.state.touch_first) && builder.memory.cubes_shown;
  lifted.look = offer.was_lifted ? Look::plain : Look::primary;
  const auto add_answer = [&](const std::string& name, const std::string& words,
                              const Action& action, char key) {
    add(name, words, action, key).enabled = can_answer(builder) && offer.was_lifted;
  };
  if (by_same) {
    add_answer("no_difference", builder.text_if_any(page, "same"), {"no_difference"}, 's');
    add_answer("different", builder.text_if_any(page, "different"), {"different"}, 'd');
  } else {
    add_answer("cube_1", builder.text_if_any(page, "cube"), {"select", 1}, '1');
    add_answer("select_object", offer.object, {"select_object"}, '2');
    if (offer.answers == ComparisonAnswers::heavier_or_none)
      add_answer("no_difference", builder.text(page, "no_difference"), {"no_difference"}, 'n');
  }
  add_put_back(builder, bottom_row(builder));
  mark_named(builder);
}
}  // namespace

void Comparison::screen(PageBuilder& builder, const Offer& offer) {
  if (!offer.object.empty()) return add_comparison_with_object(builder, offer);
  if (offer.answers == ComparisonAnswers::same_different) return add_same_or_different(builder);
  add_choice_of_cube(builder);
  if (offer.answers == ComparisonAnswers::heavier) return mark_named(builder);
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const Rect area{column.x, column.y + 2 * m.target + m.gap, column.width, 1.25f * m.target};
  builder
      .add_button("no_difference", area, builder.text(page, "no_difference"),
                  answer_touch({"no_difference"}), 'n')
      .enabled = can_answer(builder);
  mark_named(builder);
}

}  // namespace heft
