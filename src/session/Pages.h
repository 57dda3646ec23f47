// The pages that a person turns: consent, welcome, instructions, the demonstration, breaks, thanks.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiment/Event.h"
#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "protocol/Protocol.h"
#include "responders/Responder.h"
#include "session/SessionControl.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

/// Pages and entries of a session before it was resumed: they are not repeated.
struct ResumeState {
  bool consented = false;
  std::set<std::string> pages = {};                 ///< completed by the participant
  std::map<std::string, std::string> entries = {};  ///< answers of questionnaires so far
  bool in_break = false;  ///< a break was displayed last, and has not ended
};

/// Whether this page only covers another one for a while.
inline bool covers_a_page(const std::string& page) {
  return page == name_of(Screen::paused) || page == name_of(Screen::setting_up);
}

/// @param entries logged about the participant
inline ResumeState resume_state(const std::vector<Event>& events,
                                std::map<std::string, std::string> entries) {
  ResumeState gone{.entries = std::move(entries)};
  std::string page;
  for (const Event& event : events) {
    if (const auto* consent = event.as<Consent>()) gone.consented = consent->agreed;
    if (event.as<BreakTaken>()) gone.in_break = false;
    if (event.as<SessionResumed>()) page.clear();  // interrupted, not completed
    const auto* shown = event.as<TextShown>();
    if (!shown || covers_a_page(shown->page)) continue;
    if (!page.empty() && shown->page != page) gone.pages.insert(page);
    page = shown->page;
    gone.in_break = page == name_of(Screen::rest);
  }
  return gone;
}

/// The model that answers questionnaires in place of a person.
struct SimulatedReader {
  const Responder* responder = nullptr;
  const ScreenTexts* texts = nullptr;  ///< null: it answers none
};

class Pages {
 public:
  /// @param texts for the participant; null: there is no reader, and the demonstration and breaks
  ///   continue without a touch
  /// @param before pages and entries of the session so far
  Pages(const Protocol& protocol, Journal& journal, SessionControl& control,
        ParticipantScreen& screen, const ScreenTexts* texts, ResumeState before,
        SimulatedReader reader = {})
      : protocol_(protocol),
        journal_(journal),
        control_(control),
        screen_(screen),
        texts_(texts),
        before_(std::move(before)),
        reader_(reader) {}

  bool has_reader() const { return texts_ != nullptr; }

  /// The pages before a session's first trial, without those completed before.
  /// @return false if the person does not agree to take part
  bool welcome();

  /// The instructions of a block, unless completed before.
  void instructions(const std::string& block, const Task& task);

  /// Between the practice of a block and its trials that count. A block without practice has none.
  void after_practice(const std::string& block);

  /// The demonstration, for at least the block's duration and until the person continues.
  /// @param apparatus, left_hand as Demonstration
  void demonstration(const DemonstrationBlock& block, const Apparatus& apparatus, bool left_hand);

  /// A break of at least `least_s` seconds.
  void rest(double least_s);

  /// Unanswered questionnaires that follow the blocks before this one; none for an empty name. A
  /// model answers them, too.
  void questionnaires_before(const std::string& block);
  /// Questionnaires after all blocks, and those at the end.
  void questionnaires_at_the_end();

  /// The pages after the last trial.
  void how_decided();
  void thanks();

 private:
  using Moving = std::function<ViewFrame(double t_s)>;

  /// @return the touch that ended it: next, decline, or close if the session is left
  TouchKind show(ScreenState screen, double least_s = 0, const Moving& frame_at = {});
  TouchKind show(Screen screen) { return show(ScreenState{.screen = screen}); }
  void show_once(Screen screen);
  void ask_after(const std::vector<std::string>& blocks);
  void ask(const std::string& name, const std::string& after);
  TouchKind ask_model(const Questionnaire& form, const ScreenState& screen);
  void show_form(Screen screen);
  bool agrees();

  const Protocol& protocol_;
  Journal& journal_;
  SessionControl& control_;
  ParticipantScreen& screen_;
  const ScreenTexts* texts_;
  ResumeState before_;
  std::set<std::string> instructed_;  // blocks whose instructions were read in this run
  SimulatedReader reader_;
};

class QuestionnaireResponder {
 public:
  /// @param screen the questionnaire's; its existing entries are not answered again
  QuestionnaireResponder(const Responder& responder, const Questionnaire& form,
                         const ScreenState& screen);

  /// New touches until a time after the page appeared: an answer or none every few seconds, then
  /// the button "next".
  std::vector<Touch> touch(double elapsed_s);

 private:
  std::vector<Touch> touches_;
  std::vector<double> at_s_;
  std::size_t n_given_ = 0;
};

}  // namespace heft
