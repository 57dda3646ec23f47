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
#include "session/RunnerOptions.h"
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

/// What happens while a session waits: the screen is kept alive, the experimenter's commands are
/// obeyed, what waits in memory is written. Events come only from here while the session's own
/// steps stand still: between two pictures, and on pages.
class SessionControl {
 public:
  /// @param has_screen whether `screen` can wait; otherwise this waits by itself
  /// @param has_person who would be lost if the session gave up
  SessionControl(Journal& journal, ParticipantScreen& screen, const RunnerOptions& options,
                 bool has_screen, bool has_person)
      : journal_(journal),
        screen_(screen),
        console_(options.console),
        stop_(options.stop),
        tell_(options.tell),
        has_screen_(has_screen),
        has_person_(has_person) {}

  /// Waits up to `seconds`, or as long as the experimenter holds the session; returns early with
  /// what the participant touched. On a virtual clock it returns at once.
  std::vector<Touch> wait(double seconds);

  /// Waits, in a paused session, as long as the experimenter holds it or another process locks the
  /// database, so that acknowledged events are not on disk. Call it between the steps of a session,
  /// before anything is shown that acknowledges an event: the state may change meanwhile.
  /// @throws LogBusy when the database stays locked: for a person never, for a model after half a
  ///   minute, sooner when the session is to be left
  void wait_while_held();

  /// Writes everything, waiting as above.
  void save();

  /// Leaves the session as Journal::leave, and saves it.
  void leave(const std::string& why);

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
  void pause();
  void confirm(const std::string& done);
  void keep(const std::vector<Touch>& touches);
  std::vector<Touch> touched(double seconds);
  void refuse_stale();
  void pause_for_database();
  void continue_after_database();
  bool gives_up_after(double waited_s) const;
  void stand_still(bool is_locked);
  void show();

  Journal& journal_;
  ParticipantScreen& screen_;
  Console* console_;
  const std::atomic<bool>* stop_;
  std::function<void(const std::string&)> tell_;
  bool has_screen_, has_person_;
  std::function<void()> check_;
  std::optional<Answer> answer_;  // to what is being asked
  std::vector<Touch> pending_;    // not returned yet
  std::optional<bool> full_screen_;
  bool leaving_ = false, holding_ = false, asking_ = false;
  bool paused_for_database_ = false;
  bool rest_wanted_ = false, check_wanted_ = false, unblinded_ = false;
};

}  // namespace heft
