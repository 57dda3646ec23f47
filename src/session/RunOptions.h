// The options a session is run with, as kept in session.run_options so that resume and replay need
// nothing but the log.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "protocol/Protocol.h"
#include "responders/Responder.h"

namespace heft {

struct RunOptions {
  std::string responder = "simulated";  ///< NAME or NAME:FILE
  std::string responder_text;           ///< contents of a parameter FILE when the session started
  std::string tracker = "hand";
  std::string view = "headless";
  std::string simulator;  ///< instead of the protocol's; empty: the protocol's
};

std::string to_json(const RunOptions& options);

/// @throws Error when the text is not what to_json writes
RunOptions run_options_from_json(const std::string& text);

/// Checks the names and reads the responder's parameter file into the options.
/// @throws Error (usage) for unknown names; device_missing for what needs the window view
void complete(RunOptions& options);

std::unique_ptr<Responder> make_responder(const RunOptions& options, std::uint64_t seed);

/// The protocol with the options' simulator in place of its own.
std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const RunOptions& options);

}  // namespace heft
