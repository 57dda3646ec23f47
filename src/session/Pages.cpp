#include "session/Pages.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files/TextFile.h"
#include "protocol/readers/Files.h"
#include "session/Demonstration.h"

namespace heft {

namespace {
constexpr double still_page_step_s = 0.1;
// Its instructions belong to no task: [instructions_after_practice].
constexpr std::string_view after_practice_page = "after_practice";
}  // namespace

bool Pages::welcome() {
  const ScreensChosen& chosen = protocol_.screens;
  if (chosen.consent && !before_.consented && !agrees()) return false;
  show_once(Screen::welcome);
  if (chosen.about_you) show_once(Screen::about_you);
  return true;
}

// Asks a participant who does not agree once more. @return false: they do not take part
bool Pages::agrees() {
  for (;;) {
    const TouchKind answer = show(Screen::consent);
    if (answer == TouchKind::close) return true;
    const bool agreed = answer == TouchKind::next;
    journal_.emit_now(Consent{agreed, texts_->language, sha256(page_text(*texts_, "consent"))});
    if (agreed) return true;
    if (!texts_->pages.contains("declined")) return false;  // older texts lack that page
    const TouchKind sure = show(Screen::declined);
    if (sure != TouchKind::next) return sure == TouchKind::close;
  }
}

void Pages::show_once(Screen screen) {
  if (!before_.pages.contains(std::string(name_of(screen)))) show_form(screen);
}

void Pages::show_form(Screen screen) {
  const TouchKind end = show(ScreenState{.screen = screen, .entries = before_.entries});
  if (end == TouchKind::next) before_.pages.insert(std::string(name_of(screen)));
}

// Blocks of one task share one page. It counts as read for the blocks that began before a person
// resumed their session, but not where a person continues a model's session.
void Pages::instructions(const std::string& block, const Task& task) {
  const bool left_before = before_.pages.contains(text_page(Screen::instructions, task));
  if (instructed_.contains(block) || (left_before && journal_.engine().has_begun(block))) return;
  const TouchKind end =
      show(ScreenState{.screen = Screen::instructions,
                       .task = task,
                       .wording = std::string(task_block(protocol_, block).wording())});
  if (end == TouchKind::next) instructed_.insert(block);
}

// Texts may lack the page: older ones do.
void Pages::after_practice(const std::string& block) {
  const ScreenState screen{.screen = Screen::instructions, .task = Task(after_practice_page)};
  if (task_block(protocol_, block).practice && texts_->pages.contains(text_page(screen)))
    show(screen);
}

void Pages::demonstration(const DemonstrationBlock& block, const Apparatus& apparatus,
                          bool left_hand) {
  Demonstration moving(protocol_, apparatus, journal_.engine().seed(), left_hand);
  show(ScreenState{.screen = Screen::demonstration}, block.duration_s,
       [&](double t_s) { return moving.at(t_s); });
}

void Pages::rest(double least_s) {
  show(ScreenState{.screen = Screen::rest}, least_s);
}

void Pages::how_decided() {
  if (protocol_.screens.how_decided) show_once(Screen::how_decided);
}

// A completed questionnaire has an entry with its time. Otherwise it is shown again when the
// session is resumed, from its first unanswered question.
void Pages::ask(const std::string& name, const std::string& after) {
  const std::string asked = (after.empty() ? "" : after + '.') + name;
  const std::string done = asked + ".done_s";
  if (before_.entries.contains(done) || control_.leaving()) return;
  const ScreenTexts& texts = texts_ ? *texts_ : *reader_.texts;
  const auto form = texts.questionnaires.find(name);
  if (form == texts.questionnaires.end()) {
    before_.entries[done] = "";
    return journal_.emit_now(
        Note{fmt::format("the texts have no questionnaire \"{}\": not asked", name)});
  }
  ScreenState screen{.screen = Screen::questionnaire, .entries = before_.entries};
  screen.form = name;
  screen.form_prefix = asked + '.';
  if (!texts_) journal_.add_info(asked + ".answered_by", "model");
  const TouchKind end = texts_ ? show(screen) : ask_model(form->second, screen);
  if (end != TouchKind::next) return;
  before_.entries[done] = fmt::format("{:.3f}", journal_.now_s());
  journal_.add_info(done, before_.entries[done]);
}

// Like show(), with the model's touches instead of a person's.
TouchKind Pages::ask_model(const Questionnaire& form, const ScreenState& screen) {
  QuestionnaireResponder model(*reader_.responder, form, screen);
  SessionClock& clock = journal_.clock();
  const double since_s = clock.now_s();
  while (!control_.leaving()) {
    if (control_.has_screen())
      screen_.present({}, screen);
    else
      screen_.log_text(screen);
    control_.wait(still_page_step_s);
    clock.advance_to(clock.now_s() + still_page_step_s);
    for (const Touch& touch : model.touch(clock.now_s() - since_s)) {
      if (touch.kind == TouchKind::next) return touch.kind;
      journal_.add_info(touch.key, touch.value);
    }
  }
  return TouchKind::close;
}

void Pages::questionnaires_before(const std::string& block) {
  if (block.empty()) return;
  std::vector<std::string> over;
  for (const Block& before : protocol_.blocks) {
    if (block_name(before) == block) break;
    over.push_back(block_name(before));
  }
  ask_after(over);
}

void Pages::questionnaires_at_the_end() {
  std::vector<std::string> over;
  for (const Block& block : protocol_.blocks) over.push_back(block_name(block));
  over.emplace_back();
  ask_after(over);
}

// If the last answer is vetoed meanwhile, its trial is repeated before the remaining
// questionnaires.
void Pages::ask_after(const std::vector<std::string>& blocks) {
  if (!texts_ && !reader_.texts) return;
  const int n_completed = journal_.engine().n_completed();
  for (const std::string& block : blocks) {
    const auto asked = protocol_.screens.questionnaires.find(block);
    if (asked == protocol_.screens.questionnaires.end()) continue;
    for (const std::string& name : asked->second)
      if (journal_.engine().n_completed() == n_completed) ask(name, block);
  }
}

void Pages::thanks() {
  show(Screen::thanks);
}

TouchKind Pages::show(ScreenState screen, double least_s, const Moving& frame_at) {
  const SessionClock& clock = journal_.clock();
  const double since_s = clock.now_s();
  const double step_s = frame_at ? 1 / protocol_.display_rate_hz : still_page_step_s;
  while (!control_.leaving()) {
    control_.wait_while_held();  // turning a page acknowledges its answers
    const double now_s = clock.now_s(), elapsed_s = now_s - since_s;
    screen.wait_s = std::max(0.0, least_s - elapsed_s);
    if (!texts_ && screen.wait_s == 0) return TouchKind::next;  // a spectator does not answer
    screen_.present(frame_at ? frame_at(elapsed_s) : ViewFrame{}, screen);
    const double left_s = std::max(0.0, now_s + step_s - clock.now_s());
    for (const Touch& touch : control_.wait(left_s)) {
      if (touch.page != screen.page()) continue;  // meant for the previous page
      if (touch.kind == TouchKind::entry) journal_.add_info(touch.key, touch.value);
      if (touch.kind == TouchKind::decline) return touch.kind;
      if (touch.kind == TouchKind::next && screen.wait_s == 0) return touch.kind;
    }
  }
  return TouchKind::close;
}

namespace {
constexpr double reading_s = 3;  // per question
}

QuestionnaireResponder::QuestionnaireResponder(const Responder& responder,
                                               const Questionnaire& form,
                                               const ScreenState& screen) {
  double at_s = 0;
  const auto add = [&](TouchKind kind, const std::string& key, const std::string& value) {
    Touch touch;
    touch.kind = kind;
    touch.key = key;
    touch.value = value;
    touch.page = screen.page();
    touches_.push_back(touch);
    at_s_.push_back(at_s);
  };
  for (const FormQuestion& question : form.questions) {
    const std::string key = screen.form_prefix + question.key;
    const auto given = screen.entries.find(key);
    if (given != screen.entries.end() && takes_answer(question, given->second)) continue;
    at_s += reading_s;
    if (const auto value = responder.answer(question, key); value && takes_answer(question, *value))
      add(TouchKind::entry, key, *value);
  }
  add(TouchKind::next, "", "");
}

std::vector<Touch> QuestionnaireResponder::touch(double elapsed_s) {
  std::vector<Touch> touches;
  for (; n_given_ < touches_.size() && at_s_[n_given_] <= elapsed_s; ++n_given_)
    touches.push_back(touches_[n_given_]);
  return touches;
}

}  // namespace heft
