// The two people around a session: the participant before their screen, and the experimenter.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "session/Console.h"
#include "session/Journal.h"
#include "view/ArView.h"

namespace heft {

/// What the participant has in front of them. Everything that is presented goes through here, so
/// that each text that comes to stand there is logged, in which language, with its hash, and when;
/// and so that the experimenter's monitor knows which page it is.
class ParticipantScreen {
 public:
  /// @param texts what the person reads; null: nobody reads
  /// @param asked of questionnaires that a model is asked; null: it is asked none
  ParticipantScreen(Journal& journal, ArView& view, const ScreenTexts* texts,
                    const ScreenTexts* asked)
      : journal_(journal), view_(view), texts_(texts), asked_(asked) {}

  /// As ArView::present; logs the screen's text unless it is the one that stands there already.
  std::optional<double> present(const ViewFrame& frame, const ScreenState& screen);

  /// The same of a page that stands before a model, where there is no screen.
  void tell(const ScreenState& screen);

  std::vector<Touch> wait(double seconds) { return view_.wait(seconds); }
  /// As ArView::is_full_screen.
  std::optional<bool> is_full_screen() const { return view_.is_full_screen(); }
  /// As ArView::clone_offset_px.
  std::optional<double> clone_offset_px() const { return view_.clone_offset_px(); }

  /// What was presented last; none: nothing yet.
  const std::optional<ScreenState>& shown() const { return shown_; }

 private:
  void log_text(const ScreenTexts& texts, const std::string& page);

  Journal& journal_;
  ArView& view_;
  const ScreenTexts *texts_, *asked_;
  std::optional<ScreenState> shown_;
  std::string page_;  // of texts, that stands there
};

/// Runs what goes on while a session waits: keeps the screen alive, listens to the experimenter,
/// holds the session while they want it held, and puts what waits in memory on disk.
class SessionControl {
 public:
  /// @param console may be null  @param stop set from a signal handler; may be null
  /// @param has_screen whether `screen` can wait; otherwise this waits by itself
  SessionControl(Journal& journal, ParticipantScreen& screen, Console* console,
                 const std::atomic<bool>* stop, bool has_screen)
      : journal_(journal),
        screen_(screen),
        console_(console),
        stop_(stop),
        has_screen_(has_screen) {}

  /// Waits up to `seconds`, or as long as the experimenter holds the session; returns early with
  /// what the participant touched. On a virtual clock it returns at once.
  std::vector<Touch> wait(double seconds);

  /// Keeps the screen and the console alive a little while, in a session that can't go on at
  /// present; what is touched meanwhile means nothing.
  void stand_still(const std::string& why);

  /// What the experimenter says to that question.
  enum class Answer {
    go_on,
    leave,  ///< the session, or it is left by other means
    check,  ///< look once more, and ask again
    nobody_there
  };
  /// Asks the experimenter whether to go on, and waits for their answer.
  Answer ask_to_go_on(const std::string& question);

  /// How the apparatus is looked at when the experimenter wants it to be.
  void on_check(std::function<void()> check) { check_ = std::move(check); }
  /// Does that where it was wanted while a trial was open.
  void check_if_wanted();

  /// Whether the session is to be left: a signal, the experimenter, a closed window.
  bool leaving() const { return leaving_ || (stop_ && stop_->load()); }

  /// As if the experimenter asked for a break.
  void want_rest() { rest_wanted_ = true; }
  /// Whether the experimenter asked for a break since the last time.
  bool take_rest_wish();

  /// Whether there is a screen that can be looked at and touched.
  bool has_screen() const { return has_screen_; }

  /// What the experimenter is shown with the next wait(); a trial fills in how its frames come.
  ConsoleStatus status;

 private:
  std::vector<Touch> poll(double seconds);
  void note_window();
  void obey(const ConsoleCommand& command);
  void veto(const std::string& why);
  void veto_answer(const std::string& why);
  void check();
  void unblind();
  void go_on();
  void show();

  Journal& journal_;
  ParticipantScreen& screen_;
  Console* console_;
  const std::atomic<bool>* stop_;
  bool has_screen_;
  std::function<void()> check_;
  std::optional<Answer> answer_;  // to what is being asked
  std::optional<bool> full_screen_;
  bool leaving_ = false, holding_ = false, asking_ = false;
  bool rest_wanted_ = false, check_wanted_ = false, unblinded_ = false;
};

}  // namespace heft
