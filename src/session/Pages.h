// The pages that a person turns: consent, welcome, instructions, the demonstration, breaks, thanks.
// Logs each text that was shown, in which language, with its hash, and when.
#pragma once

#include <functional>
#include <string>

#include "experiment/ScreenTexts.h"
#include "protocol/Protocol.h"
#include "session/Attendant.h"

namespace heft {

class Pages {
 public:
  /// @param texts what the person reads; null: nobody reads, and no page is shown
  Pages(Journal& journal, Attendant& attendant, ArView& view, const ScreenTexts* texts)
      : journal_(journal), attendant_(attendant), view_(view), texts_(texts) {}

  bool has_reader() const { return texts_ != nullptr; }

  /// The pages before a session's first trial.
  /// @return false when the person does not agree to take part
  bool welcome();

  void instructions(Task task);

  /// The demonstration, for as long as the block says and until the person goes on.
  void demonstration(const DemonstrationBlock& block);

  /// A break of at least so many seconds.
  void rest(double least_s);

  /// The pages after the last trial.
  void how_decided();
  void thanks();

  /// A trial's screen is shown: logs its text unless it is the one shown last.
  void note_text(const ScreenState& screen);

 private:
  using Moving = std::function<ViewPicture(double t_s)>;

  /// @return the touch that ended it: next, decline, or close when the session is left
  TouchKind show(ScreenState screen, double least_s = 0, const Moving& picture_at = {});
  TouchKind show(Screen screen) { return show(ScreenState{.screen = screen}); }

  Journal& journal_;
  Attendant& attendant_;
  ArView& view_;
  const ScreenTexts* texts_;
  std::string shown_;
};

}  // namespace heft
