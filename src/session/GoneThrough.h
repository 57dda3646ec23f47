// What a person went through before their session went on: it does not come again.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiment/Event.h"
#include "experiment/ScreenState.h"

namespace heft {

struct GoneThrough {
  bool consented = false;
  std::set<std::string> pages = {};                 ///< that were turned
  std::map<std::string, std::string> entries = {};  ///< of forms, answered so far
  bool in_break = false;                            ///< was shown last, and not ended
};

/// Whether people go on to read the page that this one covers for a while.
inline bool covers_a_page(const std::string& page) {
  return page == name_of(Screen::paused) || page == name_of(Screen::setting_up);
}

/// @param entries what the log keeps of the participant
inline GoneThrough gone_through(const std::vector<Event>& events,
                                std::map<std::string, std::string> entries) {
  GoneThrough gone{.entries = std::move(entries)};
  std::string page;
  for (const Event& event : events) {
    if (const auto* consent = event.as<Consent>()) gone.consented = consent->agreed;
    if (event.as<BreakTaken>()) gone.in_break = false;
    if (event.as<SessionResumed>()) page.clear();  // it was broken off, not turned
    const auto* shown = event.as<TextShown>();
    if (!shown || covers_a_page(shown->page)) continue;
    if (!page.empty() && shown->page != page) gone.pages.insert(page);
    page = shown->page;
    gone.in_break = page == name_of(Screen::rest);
  }
  return gone;
}

}  // namespace heft
