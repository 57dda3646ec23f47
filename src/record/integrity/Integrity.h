// What is known of a log's integrity: broken digests, seals, and whether it was verified.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace heft {

/// The first row whose digest does not match: the row was changed, or rows directly before it were
/// changed together with their digests, removed, inserted or swapped.
struct BrokenDigest {
  std::string table;  ///< session (its header), event, frame or seal
  std::int64_t row_id = 0;
  int attempt_index = 0;  ///< 0: outside attempts, or of an unknown trial
  double t_s = 0;         ///< the row's current value; 0 for a session
  std::string logged, recomputed;
  std::string row;     ///< for messages: `the event "note" of attempt 2 at 12.500 s`
  std::string damage;  ///< why the row is invalid; empty if it is valid
};

/// What a log contained when a session had ended or was left (record/integrity/Seals.h).
struct Seal {
  std::int64_t seal_id = 0;  ///< from 1
  std::int64_t session_id = 0;
  std::string state;
  std::int64_t n_events = 0, n_frames = 0;
  std::string info_digest, digest;
  std::string head;  ///< digest of this seal and of all before it
};

/// The first characters of a head, as they are printed: enough to recognize it.
inline std::string short_head(const std::string& head) {
  constexpr std::size_t printed = 12;
  return head.substr(0, printed);
}

/// Whether logs were verified before their figures are shown.
struct LogIntegrity {
  bool is_verified = true;
  std::string words;  ///< "verified, head 1a2b3c4d5e6f"
};

/// For notes and descriptions where they were not.
inline constexpr std::string_view unverified_warning =
    "NOT VERIFIED: whether the log was changed was not checked (--unverified).";

}  // namespace heft
