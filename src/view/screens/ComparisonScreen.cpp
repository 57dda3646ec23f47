#include "tasks/Comparison.h"
#include "view/screens/ScreenPages.h"

namespace heft {

void Comparison::screen(PageBuilder& builder, const Offer& offer) {
  add_choice_of_cube(builder);
  if (offer.answers == ComparisonAnswers::heavier) return mark_named(builder);
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const Rect area{column.x, column.y + 2 * m.target + m.gap, column.width, 1.25f * m.target};
  builder
      .add_button("no_difference", area, builder.text("trial_comparison", "no_difference"),
                  answer_touch({"no_difference"}), 'n')
      .enabled = can_answer(builder);
  mark_named(builder);
}

}  // namespace heft
