#include "session/shards/Shards.h"

#include <fmt/format.h>

#include <charconv>

#include "apparatus/configuration/ResolvedConfig.h"
#include "base/Error.h"
#include "base/Random.h"
#include "record/schema/EventRow.h"

namespace heft {

ParticipantNumbers numbers_of(const Shard& shard, int participants) {
  const int count = (participants - shard.number + shard.of) / shard.of;
  return {shard.number, shard.of, count};
}

std::string simulated_participant(int n) {
  return fmt::format("sim-{:04}", n);
}

int number_in_id(const std::string& participant) {
  const auto digits = participant.find_first_of("0123456789");
  int n = 0;
  if (digits != std::string::npos)
    std::from_chars(participant.data() + digits, participant.data() + participant.size(), n);
  return n > 0 && participant == simulated_participant(n) ? n : 0;
}

std::uint64_t session_seed(std::uint64_t seed, int n) {
  return RandomStream(seed, "participant", static_cast<std::uint64_t>(n)).bits() >> 1;
}

SimulationKey simulation_key(const SessionHeader& header) {
  SimulationKey key{header.protocol_name, header.protocol_sha256,
                    setup_from_json(header.run_options)};
  if (!key.config.simulation_seed || !key.config.simulation_participants)
    throw Error("it was not made by this version's heft simulate, or was withdrawn",
                ExitCode::usage);
  key.config.participant_parameters.clear();
  return key;
}

std::string difference(const SimulationKey& found, const SimulationKey& expected) {
  const auto differs = [](std::string_view what, const auto& one, const auto& other) {
    return one == other ? "" : fmt::format("{} {}, not {}", what, one, other);
  };
  const auto& [seed, participants] =
      std::pair(*found.config.simulation_seed, *found.config.simulation_participants);
  for (const std::string& text :
       {differs("protocol", found.protocol, expected.protocol),
        differs("a protocol with the hash", found.protocol_sha256.substr(0, 12),
                expected.protocol_sha256.substr(0, 12)),
        differs("--seed", seed, *expected.config.simulation_seed),
        differs("--participants", participants, *expected.config.simulation_participants),
        differs("the protocol in", found.config.protocol_file, expected.config.protocol_file)})
    if (!text.empty()) return text;
  for (const ConfigChange& change : changes_between(found.config, expected.config))
    return fmt::format("{} \"{}\", not \"{}\"", change.column, change.from, change.to);
  return found.config == expected.config ? "" : "a responder or text with other contents";
}

int n_stored(const LogReader& log, const std::string& db, const SimulationKey& key,
             const ParticipantNumbers& numbers) {
  int n = 0;
  for (const std::int64_t session_id : log.session_ids()) {
    const SessionHeader header = log.session(session_id).header;
    const int number = n < numbers.count ? numbers.at(n) : 0;
    std::string why;
    try {
      why = difference(simulation_key(header), key);
    } catch (const Error& error) {
      why = error.what();
    }
    if (why.empty() && header.participant != simulated_participant(number))
      why = number > 0 ? "expected " + simulated_participant(number) : "all others are there";
    if (!why.empty())
      throw Error(fmt::format("{} has sessions of something else: session {} is of {}, {}. Choose "
                              "another file, or remove this one.",
                              db, session_id, header.participant, why),
                  ExitCode::usage);
    ++n;
  }
  return n;
}

}  // namespace heft
