// A responder's answers to a log beside the logged ones, for people and as JSON.
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
  double took_s = 0;  ///< wall time that the judging took
};

void print_offline_responder(const AnsweredSession& session);

/// Agreement's intervals: exact (Clopper and Pearson), 95 %. Those of d' and criterion: 1.96
/// standard errors. What does not exist is null.
std::string as_json(const std::vector<AnsweredSession>& sessions);

}  // namespace heft::cli
