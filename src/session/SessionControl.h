// The participant's screen and the experimenter's commands during a session.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "session/Console.h"
#include "session/Journal.h"
#include "view/ArView.h"

namespace heft {

class Engine;
class EventOutlet;

/// How a session is run: callbacks, console and event outlet.
struct RunnerOptions {
  bool keep_frames = true;
  /// Called after every event, for a progress bar.
  std::function<void(const Engine&)> progress = [](const Engine&) {};
  /// Set by a signal handler to stop at the next picture; the session can be resumed.
  const std::atomic<bool>* stop = nullptr;
  /// Prints messages where there is no console.
  std::function<void(const std::string&)> print = [](const std::string&) {};
  Console* console = nullptr;  ///< the experimenter's; only on a wall clock
  /// Other recorders, informed of each event once it is on disk; null: none.
  EventOutlet* events = nullptr;
  /// Set to the session's number once it is logged; null: not needed.
  std::int64_t* begun = nullptr;
  /// Set by a signal handler to suspend the program (Ctrl-Z), and what suspends it; null: not
  /// wanted.
  std::atomic<bool>* suspend = nullptr;
  std::function<void()> stop_process = {};
  /// Continue after a failed check if there is no experimenter to ask.
  bool ignore_failed_checks = false;
};

/// The participant's screen. Everything is presented through it, so that each text is logged with
/// its language, hash and time, and the experimenter's monitor knows the page.
class ParticipantScreen {
 public:
  /// @param texts for the participant; null: there is no reader
  /// @param asked texts of questionnaires for a model; null: none
  ParticipantScreen(Journal& journal, ArView& view, const ScreenTexts* texts,
                    const ScreenTexts* asked)
      : journal_(journal), view_(view), texts_(texts), asked_(asked) {}

  /// Calls ArView::present; logs the screen's text if it is new.
  std::optional<double> present(const ViewFrame& frame, const ScreenState& screen);

  /// Logs the text of a page for a model, where there is no screen.
  void log_text(const ScreenState& screen);

  std::vector<Touch> wait(double seconds) { return view_.wait(seconds); }
  /// As ArView::is_full_screen.
  std::optional<bool> is_full_screen() const { return view_.is_full_screen(); }
  /// As ArView::clone_offset_px.
  std::optional<double> clone_offset_px() const { return view_.clone_offset_px(); }

  /// The last presented screen; none: nothing yet.
  const std::optional<ScreenState>& shown() const { return shown_; }

 private:
  void log_text(const ScreenTexts& texts, const std::string& page);

  Journal& journal_;
  ArView& view_;
  const ScreenTexts *texts_, *asked_;
  std::optional<ScreenState> shown_;
  std::string page_;  // page of texts that is displayed
};

/// Activities while a session waits: keeps the screen responsive, carries out the experimenter's
/// commands, writes buffered events. Events come only from here while the session's own steps wait:
/// between two pictures, and on pages.
class SessionControl {
 public:
  /// @param has_screen whether `screen` can wait; otherwise this object does
  /// @param has_person whether a participant would be lost if the session gave up
  /// @param void_after_s a standstill of that length voids the open trial
  SessionControl(Journal& journal, ParticipantScreen& screen, const RunnerOptions& options,
                 bool has_screen, bool has_person, double void_after_s)
      : journal_(journal),
        screen_(screen),
        console_(options.console),
        stop_(options.stop),
        suspend_(options.suspend),
        stop_process_(options.stop_process),
        print_(options.print),
        has_screen_(has_screen),
        has_person_(has_person),
        void_after_s_(void_after_s),
        alive_s_(journal.now_s()) {}

  /// Waits up to `seconds`, or while the experimenter holds the session; returns early with the
  /// participant's touches. On a virtual clock it returns immediately.
  std::vector<Touch> wait(double seconds);

  /// Waits, in a paused session, while the experimenter holds it or another process locks the
  /// database, so that acknowledged events are not on disk. Call it between the steps of a session,
  /// before anything is shown that acknowledges an event: the state may change meanwhile.
  /// @throws LogBusy if the database stays locked: for a person never, for a model after half a
  ///   minute, earlier if the session is to be left
  void wait_while_held();

  /// Notices that the program stood still: it was suspended, or a disk was slow. An open trial is
  /// paused for that time and, if it was long, voided. Call it at least every few pictures.
  void note_alive();

  /// Writes everything, waiting as above.
  void save();

  /// Leaves the session as Journal::leave, and saves it.
  void leave(const std::string& why);

  /// The experimenter's answer.
  enum class Answer {
    proceed,
    leave,  ///< the session, which may also be left by other means
    check,  ///< again, then repeat the question
    no_one_there
  };
  /// Asks the experimenter whether to continue, and waits for the answer.
  Answer ask_to_continue(const std::string& question);

  /// Sets the check of the apparatus that the experimenter can request.
  void on_check(std::function<void()> check) { check_ = std::move(check); }
  /// Runs the check if it was requested while a trial was open.
  void check_if_wanted();

  /// Whether the session is to be left: a signal, the experimenter, a closed window.
  bool leaving() const { return leaving_ || (stop_ && stop_->load()); }

  /// Requests a break, as the experimenter can.
  void want_rest() { rest_wanted_ = true; }
  /// Whether a break was requested since the last call.
  bool take_rest_wish();

  /// Whether a screen can be seen and touched.
  bool has_screen() const { return has_screen_; }

  /// Shown to the experimenter by the next wait(); a trial fills in the tracking status.
  ConsoleStatus status;

 private:
  std::vector<Touch> poll(double seconds);
  void note_window();
  void suspend();
  void show_pause();
  void continue_if_free();
  void stood_still_since(double from_s, const std::string& why);
  void obey(const ConsoleCommand& command);
  void veto(const std::string& why);
  void veto_answer(const std::string& why);
  void check();
  void unblind();
  void proceed();
  void pause();
  void confirm(const std::string& done);
  void keep(const std::vector<Touch>& touches);
  std::vector<Touch> touched(double seconds);
  void refuse_stale();
  void pause_for_database();
  void continue_after_database();
  bool gives_up_after(double waited_s) const;
  void wait_paused(bool is_locked);
  void show();

  Journal& journal_;
  ParticipantScreen& screen_;
  Console* console_;
  const std::atomic<bool>* stop_;
  std::atomic<bool>* suspend_;
  std::function<void()> stop_process_;
  std::function<void(const std::string&)> print_;
  bool has_screen_, has_person_;
  double void_after_s_;
  double alive_s_;  // session time when the program was last seen running
  std::function<void()> check_;
  std::optional<Answer> answer_;  // to what is being asked
  std::vector<Touch> pending_;    // not returned yet
  std::optional<bool> full_screen_;
  bool leaving_ = false, holding_ = false, asking_ = false;
  bool paused_for_database_ = false;
  bool rest_wanted_ = false, check_wanted_ = false, unblinded_ = false;
};

}  // namespace heft
