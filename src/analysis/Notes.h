// What a summary says in sentences: what a reader must know about what was counted and what was
// not, and the figures that speak to the paper's hypotheses.
#pragma once

#include <string>
#include <vector>

#include "analysis/Summary.h"

namespace heft {

/// What the data say and what they can't, for somebody who reads nothing else: of the sorting, of
/// the comparisons, of what rests on what.
std::vector<std::string> three_sentences(const Summary& summary);

/// A sentence each; none where nothing is out of the ordinary.
std::vector<std::string> notes_on(const Dataset& dataset, const Summary& summary);

/// Points of percent beside chance that count as chance: the protocol's, or 10.
double equivalence_margin_percent(const Summary& summary);

/// E1-H1...E1-H3 (sorting) and E2-H1, E2-H2 (JND), stated as in the paper.
/// Each is declared or exploratory, as the summary's plan says.
std::vector<Hypothesis> hypotheses_of(const Summary& summary);

}  // namespace heft
