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
        .add_button(name, rows_below(first, i++, builder.measures.gap), builder.text_if_any(page, text),
                    answer_touch({ActionKind(name)}), key)
        .enabled = can_answer(builder);
  add_put_back(builder, bottom_row(builder));
  mark_named(builder);
}
}  // namespace

void Comparison::screen(PageBuilder& builder, const Offer& offer) {
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
