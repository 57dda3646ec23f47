// A model before a questionnaire: what a person would touch there, at a person's pace.
#pragma once

#include <vector>

#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "responders/Responder.h"

namespace heft {

class QuestionnaireResponder {
 public:
  /// @param screen of the questionnaire: what its entries have is not answered again
  QuestionnaireResponder(const Responder& mind, const Questionnaire& form,
                         const ScreenState& screen);

  /// What it touches until that time after the page came that it has not touched before: an answer
  /// or none every few seconds, then the button to go on.
  std::vector<Touch> touch(double elapsed_s);

 private:
  std::vector<Touch> touches_;
  std::vector<double> at_s_;
  std::size_t n_given_ = 0;
};

}  // namespace heft
