#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "SourceFolder.h"
#include "analysis/Folds.h"
#include "analysis/dataset/ProtocolChoices.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Tasks.h"

namespace heft {
namespace {

using ::testing::IsEmpty;

Protocol shipped(const std::string& name) {
  return load_protocol(source_folder() + "/protocols/" + name);
}

std::string value_of(const std::vector<ProtocolChoice>& choices, const std::string& choice) {
  const auto found = std::ranges::find(choices, choice, &ProtocolChoice::choice);
  return found == choices.end() ? "absent" : found->value;
}

SessionData session_of(const Protocol& protocol) {
  SessionData data;
  data.session.header.protocol_name = protocol.name;
  data.session.header.protocol_text = protocol.text;
  data.session.header.protocol_sha256 = protocol.sha256;
  return data;
}

TEST(ProtocolChoices, NameWhatThePaperLeavesOpen) {
  const auto choices = choices_in(shipped("paper.toml"));
  EXPECT_EQ(value_of(choices, "effector, length x width x height"), "90 x 40 x 40 mm");
  EXPECT_EQ(value_of(choices, "friction"), "0.8, between_surfaces");
  EXPECT_EQ(value_of(choices, "effector between pictures"), "path, not predicted");
  EXPECT_EQ(value_of(choices, "wrong introduction answer"), "same_layout");
  EXPECT_EQ(value_of(choices, "between the experiments"), "a break of at least 60 s");
  EXPECT_EQ(value_of(choices, "staircase 15g"),
            "floor 0 g, ceiling 1500 g, 1 up, 1 down, step changes before_move, ends after 10 "
            "reversals, at most 60 trials, first 2 reversals left out");
  EXPECT_EQ(value_of(choices, "staircase 15g, start and steps"),
            "from 175 g, steps 50 g, halved every 2 reversals");
}

TEST(ProtocolChoices, NameConstantStimuli) {
  Protocol protocol = shipped("quick.toml");
  auto& block = *block_as<Comparison::Block>(protocol.blocks.back());
  block.staircases = {{200, {"c", ConstantConfig{.levels = {-5, 12.5}, .n_per_level = 9}}}};
  EXPECT_EQ(value_of(choices_in(protocol), "staircase c"),
            "constant levels -5, 12.5 g, each 9 times, order blocks");
}

TEST(ProtocolChoices, NameDeclaredTechniques) {
  Protocol protocol = shipped("quick.toml");
  protocol.techniques = {{"soft", Coupling{.stiffness_n_per_m = 25}},
                         {"ratio", Gain{MassCurve({{0.015, 0.95}, {0.8, 0.2}}), 0.1}},
                         {"slow", SpeedLimit{MassCurve({{0.2, 0.05}})}}};
  const auto choices = choices_in(protocol);
  EXPECT_EQ(value_of(choices, "technique soft"),
            "spring, 25 N/m and 150 N m/rad, clone of 10 g, damping ratio 1");
  EXPECT_EQ(value_of(choices, "technique ratio"), "gain 0.95 at 15 g, 0.2 at 800 g, back in 0.1 s");
  EXPECT_EQ(value_of(choices, "technique slow"), "speed limit 0.05 m/s at 200 g, back in 0.05 s");
}

TEST(ProtocolChoices, AreGivenOnceForEachProtocolAndVersionsAreDistinguished) {
  const Protocol quick = shipped("quick.toml");
  Protocol changed = quick;
  changed.text += "\n# changed\n";
  changed.sha256 = "0123456789abcdef";
  const auto once = protocol_choices({session_of(quick), session_of(quick)});
  EXPECT_EQ(once.size(), choices_in(quick).size() + 4);  // and the configuration in effect
  EXPECT_EQ(once.front().protocol, "quick");
  const auto both = protocol_choices({session_of(quick), session_of(changed)});
  EXPECT_EQ(both.size(), 2 * once.size());
  EXPECT_EQ(both.back().protocol, "quick 01234567");
}

TEST(ProtocolChoices, ShowWhatAppliedInAnyOfTheSessions) {
  const Protocol quick = shipped("quick.toml");
  SessionData plain = session_of(quick), resumed = session_of(quick);
  LoggedSetup logged{1, 1, {}};
  logged.setup.simulator = quick.simulator.name;
  logged.setup.rate_hz = quick.simulator.rate_hz;
  plain.setups = {logged};
  plain.session.header.seed = resumed.session.header.seed = 12;
  logged.setup.heft_version = "0.2.0";
  logged.setup.build = "Release 0123abc";
  logged.setup.simulator = "bullet";
  logged.setup.rate_hz = 500;
  logged.setup.display_rate_hz = 60;
  logged.setup.source_rate_hz = 30;
  logged.setup.settings = {{"coupling.stiffness_n_per_m", "25"}};
  resumed.setups = {plain.setups[0], logged};
  const auto choices = protocol_choices({plain, resumed});
  EXPECT_EQ(value_of(choices, "simulator"),
            fmt::format("{} at {:g} Hz; bullet at 500 Hz", quick.simulator.name,
                        quick.simulator.rate_hz));
  EXPECT_EQ(value_of(choices, "frames a second"),
            fmt::format("{:g}; 60, of a source that gives 30", quick.display_rate_hz));
  EXPECT_EQ(value_of(choices, "program and build"), "heft 0.2.0, Release 0123abc");
  EXPECT_EQ(value_of(choices, "seeds of the sessions"), "12");
  EXPECT_EQ(value_of(choices, "SHA-256"), quick.sha256);
  EXPECT_EQ(value_of(choices, "changed by --set"), "coupling.stiffness_n_per_m=25");
}

TEST(ProtocolChoices, ATextThatIsNoProtocolHasNone) {
  Protocol broken;
  broken.text = "nonsense";
  EXPECT_THAT(protocol_choices({session_of(broken)}), IsEmpty());
}

}  // namespace
}  // namespace heft
