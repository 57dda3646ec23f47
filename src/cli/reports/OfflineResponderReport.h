// A responder's answers to a log compared with the logged ones, as text and as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "replay/OfflineResponder.h"

namespace heft::cli {

struct AnsweredSession {
  std::int64_t session_id = 0;
  std::string participant, responder;
  OfflineAnswers judgments;
  double took_s = 0;  ///< wall time of the judging
};

void print_offline_responder(const AnsweredSession& session);

/// Intervals of agreement: exact (Clopper and Pearson), 95 %. Of d' and criterion: 1.96 standard
/// errors. Missing values are null.
std::string as_json(const std::vector<AnsweredSession>& sessions);

}  // namespace heft::cli
