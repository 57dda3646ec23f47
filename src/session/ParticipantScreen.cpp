#include "session/ParticipantScreen.h"

#include "base/Sha256.h"
#include "protocol/TextsFile.h"

namespace heft {

std::optional<double> ParticipantScreen::present(const ViewFrame& frame,
                                                 const ScreenState& screen) {
  if (texts_) log_text(text_page(screen.screen, screen.task));
  shown_ = screen;
  return view_.present(frame, screen);
}

void ParticipantScreen::log_text(const std::string& page) {
  if (page == page_) return;
  page_ = page;
  journal_.emit_now(TextShown{page, texts_->language, sha256(page_text(*texts_, page))});
}

}  // namespace heft
