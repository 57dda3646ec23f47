// Parts of sentences that several sections, tables and charts share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/dataset/Summary.h"

namespace heft {

/// "Sorting" becomes "Sorting (simulated)" where it is.
std::string titled(std::string_view title, const Summary& summary);
/// The same for a part of the data. @param data "simulated"; empty: of persons
std::string titled(std::string_view title, const std::string& data, const Summary& summary);

/// "simulated" becomes "simulated, NOT VERIFIED" if the logs were not verified.
std::string marked(const std::string& data, const Summary& summary);

/// That figures are of simulated responders; empty: they are not.
std::string simulated_note(const Summary& summary);

/// Three significant digits, without an exponent: "0.0123", "1.04", "1560".
std::string in_digits(double value);

/// Whole grams, with three significant digits from 1000 g on: "8", "109", "1570".
std::string in_grams(double value_g);

/// " [102, 118]", in grams; empty: the estimate has no interval.
std::string grams_between(const StudyEstimate& estimate);

/// "1, 2, 3 and 40 more"
std::string some_of(const std::vector<std::string>& names, std::size_t most = 8);

/// "with decoupling (C2)" where the condition is one of the paper's, otherwise "in soft".
std::string in_condition(const Summary& summary, const std::string& condition);

/// Of the means of a threshold in g, by reference and condition; none: there are none.
std::vector<std::string> threshold_findings(const Summary& summary, std::string_view task,
                                            std::string_view measure);

/// The conclusive verdicts on the paper's hypotheses about sorting, of those of its conditions that
/// were run: "Masses are discriminated in soft."; empty: none is conclusive.
std::string sorting_verdicts(const Summary& summary);

/// Points of percent beside chance that count as chance: the protocol's, or 10.
double equivalence_margin_percent(const Summary& summary);

}  // namespace heft
