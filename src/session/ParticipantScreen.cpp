#include "session/ParticipantScreen.h"

#include <nlohmann/json.hpp>

#include "base/Sha256.h"
#include "protocol/TextsFile.h"

namespace heft {

std::optional<double> ParticipantScreen::present(const ViewPicture& picture,
                                                 const ScreenState& screen) {
  if (texts_) log_text(text_page(screen.screen, screen.task));
  shown_ = screen;
  return view_.present(picture, screen);
}

void ParticipantScreen::log_text(const std::string& page) {
  if (page == page_) return;
  page_ = page;
  journal_.emit_now(EventKind::text_shown,
                    nlohmann::ordered_json{{"page", page},
                                           {"language", texts_->language},
                                           {"sha256", sha256(page_text(*texts_, page))}}
                        .dump());
}

}  // namespace heft
