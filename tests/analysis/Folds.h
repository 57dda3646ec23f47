// Runs simulated sessions through the analysis, as summarize() does with those of a log.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "analysis/dataset/ComparisonTrials.h"
#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/Jnd.h"
#include "analysis/dataset/Participants.h"
#include "analysis/dataset/ProtocolChoices.h"
#include "analysis/dataset/Quality.h"
#include "analysis/measures/Sensitivity.h"

namespace heft {

template <typename Fold>
Fold folded(std::span<const SessionData> sessions) {
  Fold fold;
  for (const SessionData& data : sessions) fold.add(data);
  return fold;
}

inline std::vector<ParticipantRow> participants_of(std::span<const SessionData> sessions) {
  return folded<ParticipantsCollector>(sessions).result();
}
inline std::optional<AnalysisPlan> declared_plan(std::span<const SessionData> sessions) {
  return folded<PlanCollector>(sessions).result();
}
inline ParticipantFlow flow_of(std::span<const SessionData> sessions,
                               std::span<const ParticipantRow> participants) {
  return folded<FlowCollector>(sessions).result(participants);
}
inline Quality quality_of(std::span<const SessionData> sessions) {
  return folded<QualityCollector>(sessions).result();
}
inline std::vector<ProtocolChoice> protocol_choices(const std::vector<SessionData>& sessions) {
  return folded<ChoicesCollector>(sessions).result();
}
inline std::deque<StaircaseResult> staircase_results(std::span<const SessionData> sessions) {
  return folded<StaircaseCollector>(sessions).results();
}
inline std::vector<ReferenceJnd> jnd_of(std::span<const SessionData> sessions) {
  return folded<StaircaseCollector>(sessions).jnds();
}
inline std::vector<ReferenceSensitivity> sensitivities_of(std::span<const SessionData> sessions) {
  return sensitivities_of(folded<ComparisonTrials>(sessions));
}

}  // namespace heft
