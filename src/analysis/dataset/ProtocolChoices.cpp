#include "analysis/dataset/ProtocolChoices.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <variant>

#include "base/Error.h"
#include "protocol/study/StudyPlan.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {

namespace {

// A declared technique in words.
struct LawText {
  std::string operator()(const Coupling& coupling) const {
    if (!coupling.decoupled) return "coupled: the clone stays on the effector";
    return fmt::format("spring, {:g} N/m and {:g} N m/rad, clone of {:g} g, damping ratio {:g}",
                       coupling.stiffness_n_per_m, coupling.torsional_stiffness_nm_per_rad,
                       1e3 * coupling.clone_mass_kg, coupling.damping_ratio);
  }
  std::string operator()(const Displacement& displacement) const {
    return std::visit([](const auto& law) { return law.described(); }, displacement);
  }
};

std::string contacts_text(double compliance_m_per_n) {
  return compliance_m_per_n == 0
             ? "rigid"
             : fmt::format("yield {:g} mm per newton at each point", 1e3 * compliance_m_per_n);
}

bool has_practice(const Block& block) {
  const auto* trials = std::get_if<TaskBlock>(&block);
  return trials && trials->practice;
}

// Collects the choices of one protocol, and those of each of its blocks.
class Collector {
 public:
  explicit Collector(const Protocol& protocol) : name_(protocol.name) {
    add("effector, length x width x height",
        fmt::format("{:g} x {:g} x {:g} mm", 1e3 * protocol.effector_size_m.x(),
                    1e3 * protocol.effector_size_m.y(), 1e3 * protocol.effector_size_m.z()));
    add("gap between cubes", fmt::format("{:g} mm", 1e3 * protocol.layout.gap_m));
    add("start distance", fmt::format("{:g} mm", 1e3 * protocol.layout.start_distance_m));
    add("cubes that leave their area", std::string(name_of(protocol.layout.out_of_area)));
    add("friction", fmt::format("{:g}, {}", protocol.friction, name_of(protocol.friction_is)));
    add("contacts", contacts_text(protocol.contact_compliance_m_per_n));
    add("effector between pictures", input_text(protocol.simulator.input));
    add("answers need contact with every cube", protocol.require_contact ? "yes" : "no");
    if (std::ranges::none_of(protocol.blocks, has_practice)) add("practice and feedback", "none");
    for (const Technique& technique : protocol.techniques) {
      std::string text = std::visit(LawText{}, technique.law);
      if (const auto compliance = technique.contact_compliance_m_per_n)
        text += ", contacts " + contacts_text(*compliance);
      add("technique " + technique.name, text);
    }
    for (const Block& block : protocol.blocks) std::visit(*this, block);
  }

  void operator()(const DemonstrationBlock&) {}
  void operator()(const TaskBlock& block) {
    for (const auto& [choice, value] : block.choices()) add(choice, value);
  }
  void operator()(const BreakBlock& block) {
    add(block.name, fmt::format("a break of at least {:g} s", block.least_duration_s));
  }
  std::vector<ProtocolChoice> choices;

 private:
  static std::string input_text(const DriveInput& input) {
    return fmt::format("{}, {}", name_of(input.mode),
                       input.predict_s > 0 ? fmt::format("predicted {:g} s ahead", input.predict_s)
                                           : "not predicted");
  }
  void add(std::string choice, std::string value) {
    choices.push_back({name_, std::move(choice), std::move(value)});
  }

  std::string name_;
};

// The order of blocks differs between participants of one protocol.
bool is_order(const ProtocolSetting& setting) {
  return setting.key == order_key;
}

std::vector<ProtocolSetting> changed_by(const SessionConfig& setup) {
  std::vector<ProtocolSetting> settings = setup.settings;
  std::erase_if(settings, is_order);
  return settings;
}

std::vector<ProtocolSetting> changed_by(const SessionData& data) {
  if (data.setups.empty()) return {};
  return changed_by(data.setups.front().setup);
}

std::string joined(const std::set<std::string>& texts) {
  return fmt::format("{}", fmt::join(texts, "; "));
}

// Equal for sessions that ran the same protocol.
std::string key_of(const SessionData& data) {
  const SessionHeader& header = data.session.header;
  return fmt::format("{}{}{}", header.protocol_name, header.protocol_sha256,
                     to_text(changed_by(data)));
}

}  // namespace

std::vector<ProtocolChoice> choices_in(const Protocol& protocol) {
  return Collector(protocol).choices;
}

void RunAs::add(const SessionData& data, const Protocol& protocol) {
  const SessionHeader& header = data.session.header;
  hashes_.insert(header.protocol_sha256);
  seeds_.insert(fmt::format("{}", header.seed));
  for (const LoggedSetup& logged : data.setups) {
    const SessionConfig& setup = logged.setup;
    if (!setup.heft_version.empty())
      programs_.insert(fmt::format("heft {}, {}", setup.heft_version, setup.build));
    simulators_.insert(fmt::format("{} at {:g} Hz", setup.simulator,
                                   setup.rate_hz.value_or(protocol.simulator.rate_hz)));
    const double wanted_hz = setup.display_rate_hz.value_or(protocol.display_rate_hz);
    rates_.insert(
        setup.source_rate_hz && *setup.source_rate_hz < wanted_hz
            ? fmt::format("{:g}, of a source that gives {:.3g}", wanted_hz, *setup.source_rate_hz)
            : fmt::format("{:g}", wanted_hz));
    if (const auto changed = changed_by(setup); !changed.empty())
      settings_.insert(to_text(changed));
    for (const ProtocolSetting& setting : setup.settings)
      if (is_order(setting)) orders_.insert(to_text(setting));
  }
}

std::vector<ProtocolChoice> RunAs::choices(const std::string& protocol) const {
  constexpr std::size_t most_seeds = 3;
  std::vector<ProtocolChoice> choices{{protocol, "SHA-256", joined(hashes_)}};
  if (!programs_.empty()) choices.push_back({protocol, "program and build", joined(programs_)});
  choices.push_back({protocol, "seeds of the sessions",
                     seeds_.size() <= most_seeds
                         ? joined(seeds_)
                         : fmt::format("{} different ones, in the log", seeds_.size())});
  choices.push_back({protocol, "frames a second", joined(rates_)});
  choices.push_back({protocol, "simulator", joined(simulators_)});
  if (!settings_.empty()) choices.push_back({protocol, "changed by --set", joined(settings_)});
  if (!orders_.empty()) choices.push_back({protocol, "orders of blocks", joined(orders_)});
  return choices;
}

std::string RunAs::programs() const {
  return joined(programs_);
}

std::string RunAs::simulators() const {
  return joined(simulators_);
}

std::string RunAs::rates_hz() const {
  return joined(rates_);
}

void ChoicesCollector::add(const SessionData& data) {
  const SessionHeader& header = data.session.header;
  const std::vector<ProtocolSetting> settings = changed_by(data);
  const auto [place, is_new] = places_.emplace(key_of(data), ran_.size());
  if (is_new) {
    Ran& ran = ran_.emplace_back(
        Ran{{}, header.protocol_name, header.protocol_sha256, !settings.empty(), {}});
    try {
      ran.protocol = parse_protocol(header.protocol_text, header.protocol_name, settings);
    } catch (const InvalidFile&) {
    }
  }
  Ran& ran = ran_[place->second];
  if (ran.protocol) ran.run_as.add(data, *ran.protocol);
  ran.participants.insert(data.participant());
  for (const Attempt& attempt : data.attempts) ran.conditions.insert(attempt.trial.plan.condition);
}

std::vector<ProtocolChoice> ChoicesCollector::result() const {
  std::vector<ProtocolChoice> all;
  for (const RanProtocol& ran : protocols())
    for (const auto& choices : {ran.run_as.choices(ran.protocol.name), choices_in(ran.protocol)})
      all.insert(all.end(), choices.begin(), choices.end());
  return all;
}

std::vector<RanProtocol> ChoicesCollector::protocols() const {
  std::map<std::string, std::set<std::string>> hashes_by_name;
  for (const Ran& ran : ran_) hashes_by_name[ran.name].insert(ran.sha256);
  std::vector<RanProtocol> all;
  for (const Ran& ran : ran_) {
    if (!ran.protocol) continue;
    Protocol protocol = *ran.protocol;
    protocol.name = ran.name;
    if (hashes_by_name[ran.name].size() > 1)
      protocol.name = fmt::format("{} {:.8}", ran.name, ran.sha256);
    if (ran.is_changed) protocol.name += " with --set";
    all.push_back({std::move(protocol), ran.run_as, ran.participants, ran.conditions});
  }
  return all;
}

}  // namespace heft
