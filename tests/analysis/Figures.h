// Figures of made-up sessions, by measure and place.
#pragma once

#include <string>
#include <vector>

#include "analysis/Analysis.h"
#include "analysis/report/Tables.h"

namespace heft {

inline Summary summarized(const std::vector<SessionData>& sessions) {
  return summarize({"x.db", sessions}, "");
}

/// Searches participants' estimates, too. @return an estimate without a measure if there is none
inline StudyEstimate figure(const Summary& summary, std::string_view measure,
                            std::initializer_list<Place> places = {}) {
  const Estimates all = all_estimates(summary);
  const StudyEstimate* found = find_estimate(all, measure, places);
  return found ? *found : StudyEstimate{};
}
inline StudyEstimate figure(const std::vector<SessionData>& sessions, std::string_view measure,
                            std::initializer_list<Place> places = {}) {
  return figure(summarized(sessions), measure, places);
}

}  // namespace heft
