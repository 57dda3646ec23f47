#include <fmt/format.h>

#include <array>

#include "tasks/Adjustment.h"
#include "view/screens/AskedQuestion.h"
#include "view/screens/ScreenPages.h"

namespace heft {

// Coarse steps in the first row, fine ones below; decreases on the left. The cube that changes is
// marked, but not in the fading scene of the last trial.
void Adjustment::screen(PageBuilder& builder, const Offer& offer) {
  const std::string page = trial_page(builder);
  add_scene(builder, builder.text(page, "question"));
  add_hint(builder);
  if (!builder.state.faded) builder.page.marks.push_back({offer.slot, "", true});
  struct Place {
    const char* text;
    int row, beside;
  };
  constexpr std::array<Place, 4> places{
      {{"much_lighter", 0, 0}, {"lighter", 1, 0}, {"heavier", 1, 1}, {"much_heavier", 0, 1}}};
  const Measures& m = builder.measures;
  const Rect column = column_of(builder);
  const Rect first{column.x, column.y, column.width, 1.5f * m.target};
  for (std::size_t i = 0; i < std::min(places.size(), offer.steps.size()); ++i)
    builder
        .add_button(fmt::format("adjust_{}", i + 1),
                    cell(rows_below(first, places[i].row, m.gap), places[i].beside, 2, m.gap),
                    builder.text(page, places[i].text),
                    answer_touch({"adjust", offer.slot, {}, offer.steps[i].change_g}),
                    static_cast<char>('1' + i))
        .enabled = can_answer(builder) && offer.steps[i].is_possible;
  add_confirmation(builder, builder.text(page, "equal"), {"equal"}, true);
}

}  // namespace heft
