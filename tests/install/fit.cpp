// An external program: how well one participant discriminates two masses, from their choices.
#include "inference/Fit.h"

#include <cstdio>

int main() {
  // By comparison - reference in g: how often the reference, neither, or the comparison was called
  // heavier.
  const heft::AnswersByLevel answers{
      {-100, {14, 5, 1}}, {-50, {9, 8, 3}}, {0, {4, 12, 4}}, {50, {3, 8, 9}}, {100, {1, 5, 14}}};
  const heft::Fit fit = heft::fit_indecision(answers, {{}, 0, 0.02});
  if (!fit.identifiable()) {
    std::printf("no threshold, because %s\n", fit.why.c_str());
    return 1;
  }
  const heft::FittedParameter& threshold = fit.parameter("threshold_75_g");
  std::printf("75 %% correct at %.1f g, 95 %% interval %.1f to %.1f g\n", *threshold.value,
              *threshold.low, *threshold.high);
}
