#include "session/SessionControl.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "base/Clock.h"
#include "base/files/TextFile.h"
#include "protocol/readers/Files.h"

namespace heft {

std::optional<double> ParticipantScreen::present(const ViewFrame& frame,
                                                 const ScreenState& screen) {
  log_text(screen);
  return view_.present(frame, screen);
}

void ParticipantScreen::log_text(const ScreenState& screen) {
  const ScreenTexts* read = screen.screen == Screen::questionnaire && asked_ ? asked_ : texts_;
  if (read)
    log_text(*read, text_page(screen));
  else
    page_.clear();  // its page is not read any more
  shown_ = screen;
}

void ParticipantScreen::log_text(const ScreenTexts& texts, const std::string& page) {
  if (page == page_) return;
  page_ = page;
  journal_.emit_now(TextShown{page, texts.language, sha256(page_text(texts, page))});
}

namespace {
constexpr double holding_step_s = 0.05;
constexpr double longest_wait_alone_s = 30, longest_wait_leaving_s = 10;
constexpr std::string_view database_locked = "database locked by another process";
}  // namespace

std::vector<Touch> SessionControl::wait(double seconds) {
  wait_while_held();
  if (!journal_.clock().is_wall()) return {};
  keep(poll(pending_.empty() ? seconds : 0));
  if (holding_) wait_while_held();
  return std::exchange(pending_, {});
}

void SessionControl::keep(const std::vector<Touch>& touches) {
  pending_.insert(pending_.end(), touches.begin(), touches.end());
}

std::vector<Touch> SessionControl::touched(double seconds) {
  std::vector<Touch> touches = screen_.wait(seconds);
  if (std::ranges::any_of(touches, [](const Touch& t) { return t.kind == TouchKind::close; }))
    leaving_ = true;
  return touches;
}

void SessionControl::wait_while_held() {
  if (!journal_.busy()) note_alive();
  std::optional<double> busy_since_s;
  for (;;) {
    if (journal_.busy() && !busy_since_s) {
      busy_since_s = monotonic_s();
      if (journal_.clock().is_wall())
        keep(touched(0));  // touched before the screen shows the pause
      const std::string locked =
          "Database locked by another process; retrying. Nothing is lost. "
          "Close the other program to continue.";
      console_ ? console_->say(locked) : print_(locked);
    }
    if (busy_since_s) {
      pause_for_database();
      if (journal_.flush()) busy_since_s.reset();
    }
    if (!busy_since_s && (!holding_ || leaving())) break;
    if (busy_since_s && gives_up_after(monotonic_s() - *busy_since_s))
      throw LogBusy(*journal_.busy());
    wait_paused(busy_since_s.has_value());
  }
  continue_after_database();
  refuse_stale();
}

// An answer that was pending in a pause, to a trial that has ended since.
void SessionControl::refuse_stale() {
  if (!has_person_) return;
  const PageId page = journal_.engine().screen().page();
  std::erase_if(pending_, [&](const Touch& touch) {
    if (touch.kind != TouchKind::action || touch.page == page) return false;
    journal_.emit_now(ActionRefused{touch.action, "its trial was over after a pause"});
    return true;
  });
}

// On a wall clock; a command may have continued the session meanwhile.
void SessionControl::pause_for_database() {
  if (!journal_.clock().is_wall() || journal_.engine().state() != SessionState::running) return;
  // Since the program waits for the lock.
  journal_.emit(
      {std::max(alive_s_, journal_.engine().last_s()), SessionPaused{std::string(database_locked)}},
      Durability::acknowledged);
  paused_for_database_ = true;
}

void SessionControl::continue_after_database() {
  if (!std::exchange(paused_for_database_, false)) return;
  continue_if_free();
}

// Ends a pause that the experimenter neither holds nor must end.
void SessionControl::continue_if_free() {
  const Engine& engine = journal_.engine();
  const bool is_paused = engine.state() == SessionState::paused;
  if (is_paused && !holding_ && !engine.needs_experimenter()) journal_.emit_now(SessionContinued{});
}

void SessionControl::show_pause() {
  ScreenState screen = journal_.engine().screen();
  screen.screen = Screen::paused;
  screen_.present({}, screen);
}

bool SessionControl::gives_up_after(double waited_s) const {
  if (leaving()) return waited_s >= longest_wait_leaving_s;
  return !has_person_ && waited_s >= longest_wait_alone_s;
}

// Shows the pause for a moment; touches meanwhile are ignored.
void SessionControl::wait_paused(bool is_locked) {
  if (is_locked) status.trouble = std::string(database_locked) + "; retrying";
  if (journal_.clock().is_wall()) show_pause();
  poll(holding_step_s);
  if (is_locked) status.trouble.clear();
}

void SessionControl::save() {
  journal_.flush();
  wait_while_held();
}

void SessionControl::leave(const std::string& why) {
  journal_.leave(why);
  save();
}

SessionControl::Answer SessionControl::ask_to_continue(const std::string& question) {
  if (!console_ || !console_->ask_to_continue(question)) return Answer::no_one_there;
  answer_.reset();
  asking_ = true;
  while (!answer_ && !leaving()) {
    wait_while_held();
    poll(holding_step_s);
  }
  asking_ = false;
  return answer_.value_or(Answer::leave);
}

std::vector<Touch> SessionControl::poll(double seconds) {
  note_alive();
  std::vector<Touch> touches = touched(seconds);
  if (!has_screen_) std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  if (suspend_ && suspend_->exchange(false)) suspend();
  note_alive();
  note_window();
  journal_.flush_now_and_then();
  if (!console_) return touches;
  while (const auto command = console_->command()) obey(*command);
  show();
  return touches;
}

void SessionControl::note_alive() {
  constexpr double standstill_s = 0.5;
  if (!journal_.clock().is_wall()) return;
  const double from_s =
      std::max(std::exchange(alive_s_, journal_.now_s()), journal_.engine().last_s());
  const Engine& engine = journal_.engine();
  if (alive_s_ - from_s < standstill_s || !engine.trial_is_open()) return;
  if (engine.state() != SessionState::running) return;
  journal_.emit({from_s, SessionPaused{"the program stood still"}}, Durability::acknowledged);
  stood_still_since(from_s, "the program stood still");
}

// Handles a suspension of the program within a pause that began at `from_s`, and ends the pause.
void SessionControl::stood_still_since(double from_s, const std::string& why) {
  const Engine& engine = journal_.engine();
  alive_s_ = journal_.now_s();
  if (engine.trial_is_open() && alive_s_ - from_s > void_after_s_)
    journal_.emit_now(TrialVoided{why});
  continue_if_free();
}

// The participant sees the pause while the program is suspended.
void SessionControl::suspend() {
  const double from_s = journal_.now_s();
  const bool pauses = journal_.engine().state() == SessionState::running;
  if (pauses) journal_.emit_now(SessionPaused{"suspended"});
  journal_.flush();
  show_pause();
  stop_process_();
  if (pauses) stood_still_since(from_s, "suspended");
}

// The initial state is in the configuration; F11 changes it.
void SessionControl::note_window() {
  const std::optional<bool> full = screen_.is_full_screen();
  const bool is_new = full && full_screen_ && *full != *full_screen_;
  if (is_new && journal_.engine().next().kind != Next::Kind::over)
    journal_.emit_now(
        Note{*full ? "the window is now full screen" : "the window is no longer full screen"});
  if (full) full_screen_ = full;
}

void SessionControl::show() {
  const Engine& engine = journal_.engine();
  status.session_s = journal_.now_s();
  status.n_completed = engine.n_completed();
  status.paused = engine.state() == SessionState::paused;
  status.paused_itself = status.paused && !holding_;
  status.screen = screen_.shown();
  if (!status.screen || status.screen->screen != Screen::trial) status.tracking.reset();
  status.plan = unblinded_ && engine.trial_is_open() ? engine.next().plan : std::nullopt;
  console_->show(status);
}

void SessionControl::obey(const ConsoleCommand& command) {
  switch (command.kind) {
    case ConsoleCommandKind::pause:
      return pause();
    case ConsoleCommandKind::proceed:
      return proceed();
    case ConsoleCommandKind::veto:
      return veto(command.text);
    case ConsoleCommandKind::veto_answer:
      return veto_answer(command.text);
    case ConsoleCommandKind::check:
      return check();
    case ConsoleCommandKind::note:
      journal_.emit_now(Note{command.text});
      return confirm("noted");
    case ConsoleCommandKind::rest:
      rest_wanted_ = !rest_wanted_;
      return console_->say(rest_wanted_ ? "a break comes before the next trial; b takes it back"
                                        : "no break comes before the next trial");
    case ConsoleCommandKind::end:
      if (asking_) answer_ = Answer::leave;
      leaving_ = true;
      return;
    case ConsoleCommandKind::unblind:
      return unblind();
  }
}

void SessionControl::pause() {
  if (journal_.engine().next().kind == Next::Kind::over)
    return console_->say("the session has ended; it cannot be paused");
  if (paused_for_database_ && !holding_) {
    holding_ = true;
    return console_->say("the session stays paused until you continue it");
  }
  if (journal_.engine().state() == SessionState::paused)
    return console_->say("the session is already paused");
  journal_.emit_now(SessionPaused{"experimenter"});
  holding_ = true;
}

// Only what is on disk is reported as done.
void SessionControl::confirm(const std::string& done) {
  console_->say(journal_.busy() ? done + "; not saved yet" : done);
}

void SessionControl::proceed() {
  if (asking_) {
    answer_ = Answer::proceed;
    return;
  }
  if (!holding_) return console_->say("the session is not held; it continues automatically");
  holding_ = false;
  if (!paused_for_database_) journal_.emit_now(SessionContinued{});
}

void SessionControl::veto(const std::string& why) {
  if (!journal_.engine().trial_is_open())
    return console_->say("no trial is open; an answered trial stays as it is");
  journal_.emit_now(TrialVoided{"veto: " + why});
  confirm("the trial is void and will be presented again");
}

// A trial that has begun since then is repeated afterwards, with the same draws.
void SessionControl::veto_answer(const std::string& why) {
  const Engine& engine = journal_.engine();
  if (engine.next().kind == Next::Kind::over)
    return console_->say("the session has ended; its answers are kept");
  if (!engine.vetoable()) return console_->say("there is no answered trial to void");
  if (engine.trial_is_open()) journal_.emit_now(TrialVoided{std::string(void_interrupted)});
  journal_.emit_now(AnswerVetoed{why});
  confirm("the last answer is void; its cubes will be presented again");
}

// Not during a trial, whose pictures it would take.
void SessionControl::check() {
  if (asking_) {
    answer_ = Answer::check;
    return;
  }
  if (journal_.engine().trial_is_open()) {
    check_wanted_ = true;
    return console_->say("the apparatus is checked before the next trial");
  }
  if (check_) check_();
}

void SessionControl::check_if_wanted() {
  if (std::exchange(check_wanted_, false) && check_) check_();
}

void SessionControl::unblind() {
  if (unblinded_) return;
  unblinded_ = true;
  journal_.emit_now(Unblinding{"experimenter"});
}

bool SessionControl::take_rest_wish() {
  return std::exchange(rest_wanted_, false);
}

}  // namespace heft
