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

enum class HypothesisVerdict { supported, not_supported, inconclusive, not_tested };
template <>
struct EnumNames<HypothesisVerdict> {
  static constexpr std::array<std::string_view, 4> names{"supported", "not supported",
                                                         "inconclusive", "not tested"};
};

/// One of the paper's hypotheses, with the verdict of these data and the figures behind it. It is
/// tested only if technique, masses and task are the paper's.
struct Hypothesis {
  std::string name;  ///< "E1-H1"
  std::string statement;
  bool declared = false;  ///< by the protocols of all sessions; otherwise it is exploratory
  HypothesisVerdict verdict = HypothesisVerdict::not_tested;
  std::string why;                   ///< reason for the verdict
  std::vector<std::string> figures;  ///< a sentence each
  std::string condition{};           ///< condition of this log that is the paper's; empty: none

  bool applies() const { return declared || !condition.empty(); }
};

/// Data that several sections use, collected while the sessions are read once.
struct SharedCollectors {
  ComparisonTrials comparisons;
  StaircaseCollector staircases, judgments{"judgment"};
};

class Section;

struct Summary {
  std::string database, command;
  LogIntegrity integrity = {};
  bool checks_models = true;  ///< whether models are checked by simulated studies
  std::string data;           ///< "human", "simulated" or "human and simulated"; empty: no sessions
  std::vector<SessionSummary> sessions;
  int n_participants = 0;                    ///< without excluded ones
  std::vector<ParticipantRow> participants;  ///< with excluded ones
  std::optional<AnalysisPlan> plan;
  Estimates estimates;  ///< over participants, in the order of the sections
  std::vector<std::shared_ptr<const Section>> sections;  ///< they have estimates by participant
  std::shared_ptr<const SharedCollectors> shared;        ///< never null
  Quality quality;
  ParticipantFlow flow;
  std::vector<SessionTracks> all_tracks;
  std::vector<Hypothesis> hypotheses;
  /// By condition, which of the paper's conditions its technique is, if any; masses may differ.
  std::map<std::string, published::Comparable> comparable;
  std::vector<RanProtocol> protocols;
  std::vector<ProtocolChoice> choices;
  std::vector<SetupValue> setups;
  std::vector<Incident> incidents;
  std::vector<std::string> notes;  ///< sentences that qualify the figures

  bool simulated() const { return data == "simulated" || data == "human and simulated"; }
};

}  // namespace heft
