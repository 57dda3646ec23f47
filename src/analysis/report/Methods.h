// The methods of a study as text for a paper; every number comes from the study's logs and their
// protocols.
#pragma once

#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"

namespace heft {

/// What the methods cite, in the order of `sources` in Methods.cpp.
enum class Source {
  technique,
  up_down,
  weighted_up_down,
  quest,
  quest_plus,
  psi,
  two_ac,
  indecision,
  quadrature,
  tobit,
  clustered,
  magnitudes,
  comparative_judgment,
  adjusted_likelihood
};

/// Collects the sources that the text cites.
class Citations {
 public:
  /// Adds the source to the list. @return "Levitt, 1971"
  std::string cite(Source source);
  /// The cited sources in full, ordered by author.
  std::vector<std::string> references() const;

 private:
  std::vector<Source> cited_;
};

struct Methods {
  std::vector<std::string> paragraphs;  ///< participants, apparatus and tasks, data, analysis
  std::vector<std::string> references;
};

/// Empty without sessions.
Methods methods_of(const Summary& summary);

/// The blocks of a protocol in their order; in MethodsTasks.cpp.
std::string tasks_in_words(const Protocol& protocol, Citations& citations);

/// "15, 200 and 800"; of nothing empty.
std::string listed(const std::vector<std::string>& items);
std::string listed_g(const std::vector<double>& masses_g);

}  // namespace heft
