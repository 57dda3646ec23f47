// Offers of screens and contents of answers, for tests.
#pragma once

#include <optional>
#include <vector>

#include "experiment/ScreenState.h"
#include "tasks/Sorting.h"

namespace heft {

using GivenLabels = std::vector<std::optional<Label>>;

/// The labels of a sorting screen, by slot.
inline GivenLabels& labels_on(ScreenState& screen) {
  if (!screen.offer.has_value()) screen.offer = Sorting::Offer{};
  return std::any_cast<Sorting::Offer&>(screen.offer).labels;
}
inline GivenLabels labels_on(const ScreenState& screen) {
  const auto* offer = std::any_cast<Sorting::Offer>(&screen.offer);
  return offer ? offer->labels : GivenLabels{};
}

/// The cube that an answer chooses, if any.
inline std::optional<int> chosen_slot(const Answer& answer) {
  return answer.actions.at(0).kind == "select" ? answer.actions[0].slot : std::nullopt;
}
/// The labels that an answer gives, by slot.
inline std::vector<Label> given_labels(const Answer& answer) {
  std::vector<Label> labels;
  for (const Action& action : answer.actions)
    if (action.label) labels.push_back(*action.label);
  return labels;
}
inline Answer choosing(int slot) {
  return {{{"select", slot}}};
}
inline Answer labeling(const std::vector<Label>& labels, bool first_step_corrected = false) {
  Answer answer{{}, first_step_corrected};
  for (const Label& label : labels)
    answer.actions.push_back({"label", static_cast<int>(answer.actions.size()) + 1, label});
  answer.actions.push_back({"validate"});
  return answer;
}

}  // namespace heft
