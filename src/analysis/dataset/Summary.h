// The result of an analysis. Tables, JSON, charts and the report are ways to show a Summary.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/dataset/ComparisonTrials.h"
#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/Participants.h"
#include "analysis/dataset/ProtocolChoices.h"
#include "analysis/dataset/Quality.h"
#include "analysis/dataset/StudyEstimate.h"
#include "analysis/dataset/Tracks.h"

namespace heft {

/// One session and how much of it counts.
struct SessionSummary {
  std::int64_t session_id = 0;
  std::string participant, protocol, purpose, responder;
  SessionState state = SessionState::running;
  int n_completed = 0, n_void = 0, n_open = 0;  ///< attempts
  PictureCounts pictures = {};
};

enum class HypothesisVerdict { supported, not_supported, inconclusive };
template <>
struct EnumNames<HypothesisVerdict> {
  static constexpr std::array<std::string_view, 3> names{"supported", "not supported",
                                                         "inconclusive"};
};

/// One of the paper's hypotheses, what these data say of it, and the figures. It is judged where
/// technique, masses and task are the paper's.
struct Hypothesis {
  std::string name;  ///< "E1-H1"
  std::string statement;
  bool declared = false;  ///< by the protocols of all sessions; otherwise it is exploratory
  HypothesisVerdict verdict = HypothesisVerdict::inconclusive;
  std::string why;
  std::vector<std::string> figures;  ///< a sentence each
  std::string condition{};           ///< of this log that is the paper's; empty: none is

  bool applies() const { return declared || !condition.empty(); }
};

/// What several sections are made of; sessions are read once for all.
struct SharedCollectors {
  ComparisonTrials comparisons;
  StaircaseCollector staircases, judgments{"judgment"};
};

class Section;

struct Summary {
  std::string database, command;
  LogIntegrity integrity = {};
  bool checks_models = true;  ///< by simulated studies
  std::string data;           ///< "human", "simulated" or "human and simulated"; empty: no sessions
  std::vector<SessionSummary> sessions;
  int n_participants = 0;                    ///< that count
  std::vector<ParticipantRow> participants;  ///< all, those left out too
  std::optional<AnalysisPlan> plan;
  Estimates estimates;  ///< over participants, in the order of the sections
  std::vector<std::shared_ptr<const Section>> sections;  ///< which have each participant's
  std::shared_ptr<const SharedCollectors> shared = std::make_shared<SharedCollectors>();
  Quality quality;
  ParticipantFlow flow;
  std::vector<SessionTracks> all_tracks;
  std::vector<Hypothesis> hypotheses;
  /// Which conditions are the paper's, by technique; masses may differ.
  std::map<std::string, published::Comparable> comparable;
  std::vector<RanProtocol> protocols;
  std::vector<ProtocolChoice> choices;
  std::vector<SetupValue> setups;
  std::vector<Incident> incidents;
  std::vector<std::string> notes;  ///< what a reader must know about what was counted

  bool simulated() const { return data == "simulated" || data == "human and simulated"; }
};

}  // namespace heft
