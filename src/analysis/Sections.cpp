// The list of all sections. A new one is a file in measures/ and its name here.
#include "analysis/Section.h"

namespace heft {

std::unique_ptr<Section> introduction_section();
std::unique_ptr<Section> sorting_section();
std::unique_ptr<Section> sensitivity_section();
std::unique_ptr<Section> staircase_section();
std::unique_ptr<Section> choice_section();
std::unique_ptr<Section> estimation_section();
std::unique_ptr<Section> timing_section();
std::unique_ptr<Section> lag_section();
std::unique_ptr<Section> tracking_section();

std::vector<std::unique_ptr<Section>> all_sections() {
  std::vector<std::unique_ptr<Section>> sections;
  for (const auto& make :
       {sorting_section, introduction_section, sensitivity_section, staircase_section,
        choice_section, estimation_section, timing_section, lag_section, tracking_section})
    sections.push_back(make());
  return sections;
}

}  // namespace heft
