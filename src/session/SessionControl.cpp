#include "session/SessionControl.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "base/Sha256.h"
#include "protocol/Files.h"

namespace heft {

std::optional<double> ParticipantScreen::present(const ViewFrame& frame,
                                                 const ScreenState& screen) {
  tell(screen);
  return view_.present(frame, screen);
}

void ParticipantScreen::tell(const ScreenState& screen) {
  const ScreenTexts* read = screen.screen == Screen::questionnaire && asked_ ? asked_ : texts_;
  if (read)
    log_text(*read, text_page(screen));
  else
    page_.clear();  // nobody reads what stands there now
  shown_ = screen;
}

void ParticipantScreen::log_text(const ScreenTexts& texts, const std::string& page) {
  if (page == page_) return;
  page_ = page;
  journal_.emit_now(TextShown{page, texts.language, sha256(page_text(texts, page))});
}

namespace {
constexpr double holding_step_s = 0.05;
}  // namespace

std::vector<Touch> SessionControl::wait(double seconds) {
  if (!journal_.clock().is_wall()) return {};
  std::vector<Touch> touches = poll(seconds);
  while (holding_ && !leaving()) {  // what is touched meanwhile means nothing
    screen_.present({}, journal_.engine().screen());
    poll(holding_step_s);
  }
  return touches;
}

void SessionControl::stand_still(const std::string& why) {
  status.trouble = why;
  if (journal_.clock().is_wall()) screen_.present({}, journal_.engine().screen());
  poll(holding_step_s);
  status.trouble.clear();
}

SessionControl::Answer SessionControl::ask_to_go_on(const std::string& question) {
  if (!console_ || !console_->ask_to_go_on(question)) return Answer::nobody_there;
  answer_.reset();
  asking_ = true;
  while (!answer_ && !leaving()) poll(holding_step_s);
  asking_ = false;
  return answer_.value_or(Answer::leave);
}

std::vector<Touch> SessionControl::poll(double seconds) {
  std::vector<Touch> touches = screen_.wait(seconds);
  if (!has_screen_) std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  if (std::ranges::any_of(touches, [](const Touch& t) { return t.kind == TouchKind::close; }))
    leaving_ = true;
  note_window();
  journal_.flush_now_and_then();
  if (!console_) return touches;
  while (const auto command = console_->command()) obey(*command);
  show();
  return touches;
}

// How it stood at first is in the setup; F11 changes it.
void SessionControl::note_window() {
  const std::optional<bool> full = screen_.is_full_screen();
  const bool is_new = full && full_screen_ && *full != *full_screen_;
  if (is_new && journal_.engine().next().kind != Next::Kind::over)
    journal_.emit_now(
        Note{*full ? "the window is full screen now" : "the window is not full screen any more"});
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
      if (journal_.engine().state() == SessionState::paused)
        return console_->say("the session is paused already");
      if (journal_.engine().next().kind == Next::Kind::over)
        return console_->say("the session is over; there is nothing to pause");
      journal_.emit_now(SessionPaused{"experimenter"});
      holding_ = true;
      return;
    case ConsoleCommandKind::go_on:
      return go_on();
    case ConsoleCommandKind::veto:
      return veto(command.text);
    case ConsoleCommandKind::veto_answer:
      return veto_answer(command.text);
    case ConsoleCommandKind::check:
      return check();
    case ConsoleCommandKind::note:
      journal_.emit_now(Note{command.text});
      return console_->say("noted");
    case ConsoleCommandKind::rest:
      rest_wanted_ = true;
      return console_->say("a break comes before the next trial");
    case ConsoleCommandKind::end:
      if (asking_) answer_ = Answer::leave;
      leaving_ = true;
      return;
    case ConsoleCommandKind::unblind:
      return unblind();
  }
}

void SessionControl::go_on() {
  if (asking_) {
    answer_ = Answer::go_on;
    return;
  }
  if (!holding_) return console_->say("the session is not held; it goes on by itself");
  journal_.emit_now(SessionContinued{});
  holding_ = false;
}

void SessionControl::veto(const std::string& why) {
  if (!journal_.engine().trial_is_open())
    return console_->say("no trial is open; an answered trial stays as it is");
  journal_.emit_now(TrialVoided{"veto: " + why});
  console_->say("the trial is void and will be presented again");
}

// A trial that has begun since then is run again after it, with the same draws.
void SessionControl::veto_answer(const std::string& why) {
  const Engine& engine = journal_.engine();
  if (engine.next().kind == Next::Kind::over)
    return console_->say("the session is over; its answers stay as they are");
  if (!engine.vetoable())
    return console_->say("no comparison was answered whose answer could be taken back");
  if (engine.trial_is_open()) journal_.emit_now(TrialVoided{std::string(void_interrupted)});
  journal_.emit_now(AnswerVetoed{why});
  console_->say("the last answer is void; its cubes will be presented again");
}

// Not in the middle of a trial, whose pictures it would take away.
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
