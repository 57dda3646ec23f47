// The list of all sections. A new one is a file in measures/ and its name here.
#include "analysis/measures/Section.h"

namespace heft {

std::shared_ptr<Section> timing_section();
std::shared_ptr<Section> lag_section();
std::shared_ptr<Section> tracking_section();
std::shared_ptr<Section> sorting_section();
std::shared_ptr<Section> perceived_mass_section();
std::shared_ptr<Section> introduction_section();
std::shared_ptr<Section> sensitivity_section();
std::shared_ptr<Section> lab_section();
std::shared_ptr<Section> staircase_section();
std::shared_ptr<Section> choice_section();
std::shared_ptr<Section> curve_section();
std::shared_ptr<Section> estimation_section();
std::shared_ptr<Section> judgment_section();
std::shared_ptr<Section> judgment_threshold_section();
std::shared_ptr<Section> adjustment_section();
std::shared_ptr<Section> forced_choice_section();
std::shared_ptr<Section> same_different_section();

// Sections with the most data per participant come first, since put() frees much of it.
std::vector<std::shared_ptr<Section>> all_sections() {
  return {timing_section(),         lag_section(),
          tracking_section(),       sorting_section(),
          perceived_mass_section(), introduction_section(),
          sensitivity_section(),    lab_section(),
          staircase_section(),      choice_section(),
          curve_section(),          estimation_section(),
          judgment_section(),       judgment_threshold_section(),
          adjustment_section(),     forced_choice_section(),
          same_different_section()};
}

}  // namespace heft
