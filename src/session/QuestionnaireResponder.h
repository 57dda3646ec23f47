// A model that answers a questionnaire by touches, at a person's pace.
#pragma once

#include <vector>

#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "responders/Responder.h"

namespace heft {

class QuestionnaireResponder {
 public:
  /// @param screen the questionnaire's; its existing entries are not answered again
  QuestionnaireResponder(const Responder& mind, const Questionnaire& form,
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
