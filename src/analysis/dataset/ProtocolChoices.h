// Protocol settings that the paper does not specify, listed in the report.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/dataset/Dataset.h"
#include "protocol/Protocol.h"

namespace heft {

struct ProtocolChoice {
  std::string protocol;  ///< its name; the first digits of its hash where several share one
  std::string choice, value;
};

/// The choices of one protocol, in the order of paper.toml.
std::vector<ProtocolChoice> choices_in(const Protocol& protocol);

/// The configurations of a protocol's sessions, as their setups record them; each once.
class RunAs {
 public:
  void add(const SessionData& data, const Protocol& protocol);
  std::vector<ProtocolChoice> choices(const std::string& protocol) const;
  std::string programs() const;
  std::string simulators() const;
  std::string rates_hz() const;

 private:
  std::set<std::string> hashes_, seeds_, programs_, simulators_, rates_, settings_, orders_;
};

/// A protocol as its sessions ran it.
struct RanProtocol {
  Protocol protocol;  ///< by its name in ProtocolChoice
  RunAs run_as;
  std::set<std::string> participants, conditions;
};

/// Choices of each protocol that the sessions ran. A logged text that is no protocol has none.
class ChoicesCollector {
 public:
  void add(const SessionData& data);
  std::vector<ProtocolChoice> result() const;
  std::vector<RanProtocol> protocols() const;

 private:
  struct Ran {
    std::optional<Protocol> protocol;  // none: the text is none
    std::string name, sha256;
    bool is_changed = false;  // by --set
    RunAs run_as = {};
    std::set<std::string> participants = {}, conditions = {};
  };
  std::vector<Ran> ran_;                       // in the order of sessions
  std::map<std::string, std::size_t> places_;  // by what makes it one protocol
};

}  // namespace heft
