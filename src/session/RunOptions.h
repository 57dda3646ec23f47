// The options a session is run with, as kept in session.run_options so that resume and replay need
// nothing but the log.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/Protocol.h"
#include "responders/Responder.h"

namespace heft {

struct RunOptions {
  std::string responder = "simulated";  ///< NAME or NAME:FILE, FILE as an absolute path
  std::string responder_text;           ///< contents of a parameter FILE when the session started
  std::string tracker = "hand";
  std::string view = "headless";
  std::string simulator;  ///< instead of the protocol's; empty: the protocol's
};

std::string to_json(const RunOptions& options);

/// @throws Error when the text is not what to_json writes
RunOptions run_options_from_json(const std::string& text);

/// Makes the responder's FILE absolute, reads it if it holds parameters, and checks everything.
/// @throws Error (usage) for unknown names; device_missing for what this version does not have
void complete(RunOptions& options);

/// As complete(), for options from a log: the parameters stay those that were read then.
void check(const RunOptions& options);

/// Whether the two names in the table of simulators mean the same one.
/// @throws Error (usage) for an unknown name
bool is_same_simulator(const std::string& a, const std::string& b);

/// An option given anew when a session goes on. Its JSON is the detail of a `deviation` event:
/// {"option":"responder","from":"simulated","to":"coin"}.
struct OptionChange {
  std::string option, from, to;
};

std::string to_json(const OptionChange& change);

/// The options that differ, one change each.
std::vector<OptionChange> changes_between(const RunOptions& from, const RunOptions& to);

/// Puts a logged change in force; the detail of a deviation of another kind changes nothing.
void apply_deviation(RunOptions& options, const std::string& detail);

std::unique_ptr<Responder> make_responder(const RunOptions& options, std::uint64_t seed);

/// The protocol with the options' simulator in place of its own.
std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const RunOptions& options);

}  // namespace heft
