#include "tasks/Introduction.h"
#include "view/screens/ScreenPages.h"

namespace heft {

void Introduction::screen(PageBuilder& builder, const Offer&) {
  add_choice_of_cube(builder);
  if (builder.state.try_again && builder.page.notice.empty())
    builder.page.notice = builder.text("trial_introduction", "try_again");
}

}  // namespace heft
