// What the participant has in front of them. Everything that is presented goes through here, so
// that each text that comes to stand there is logged, in which language, with its hash, and when;
// and so that the experimenter's monitor knows which page it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "session/Journal.h"
#include "view/ArView.h"

namespace heft {

class ParticipantScreen {
 public:
  /// @param texts what the person reads; null: nobody reads
  ParticipantScreen(Journal& journal, ArView& view, const ScreenTexts* texts)
      : journal_(journal), view_(view), texts_(texts) {}

  /// As ArView::present; logs the screen's text unless it is the one that stands there already.
  std::optional<double> present(const ViewFrame& frame, const ScreenState& screen);

  std::vector<Touch> wait(double seconds) { return view_.wait(seconds); }

  /// What was presented last; none: nothing yet.
  const std::optional<ScreenState>& shown() const { return shown_; }

 private:
  void log_text(const std::string& page);

  Journal& journal_;
  ArView& view_;
  const ScreenTexts* texts_;
  std::optional<ScreenState> shown_;
  std::string page_;  // of texts, that stands there
};

}  // namespace heft
