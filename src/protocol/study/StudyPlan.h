// A study's plan: who is to take part in which group and with which order of blocks. What
// STUDY.toml says, and what follows from it alone; who has taken part stands in the log
// (apparatus/StudyPlaces.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/Names.h"
#include "experiment/SessionConfig.h"

namespace heft {

/// How the orders of n blocks are chosen. latin: n of them, each block once at each place.
/// balanced: that, and each block as often directly after each other one (Williams 1949: n orders
/// of an even number of blocks, 2n of an odd one). rows: the orders that the file lists.
enum class OrderDesign { latin, balanced, rows };
template <>
struct EnumNames<OrderDesign> {
  static constexpr std::array<std::string_view, 3> names{"latin", "balanced", "rows"};
};

/// Names of blocks, in the order in which they come. Empty: as the protocol has them.
using BlockOrder = std::vector<std::string>;

struct StudyGroup {
  std::string name;      ///< empty: the study has no groups
  std::string protocol;  ///< path of its file
  std::optional<std::string> language;
};

struct StudyPlan {
  std::string name;
  std::string sha256;  ///< of the file
  int participants = 0;
  std::uint64_t seed = 0;
  std::string id_prefix;           ///< participants are PREFIX01, PREFIX02...
  std::vector<StudyGroup> groups;  ///< at least one
  std::vector<BlockOrder> orders;  ///< at least one
  std::optional<int> display;
  std::optional<std::string> display_file, db, backup;  ///< paths
};

/// What the plan gives one participant.
struct StudyPlace {
  int number = 0;  ///< 1...participants
  int group = 0;   ///< index of StudyPlan::groups
  int order = 0;   ///< index of StudyPlan::orders
};

/// The orders of a design; `rows` has no others than it lists. Which block is which comes from the
/// seed.
/// @param blocks two or more names
std::vector<BlockOrder> designed_orders(OrderDesign design, std::vector<std::string> blocks,
                                        std::uint64_t seed);

/// Places 1...n come in rounds of each group with each order once, in random order; in each part of
/// a round that is as long as there are groups, each group comes once. More participants leave the
/// places before them as they are.
StudyPlace place_in(const StudyPlan& plan, int number);

/// "P07": as many digits as the plan's last participant has, but at least two.
std::string planned_id(const StudyPlan& plan, int number);

/// The order as the protocol's key `block_order` has it: block_order=["a", "b"]. Empty: nothing to
/// set.
ProtocolSetting order_setting(const BlockOrder& order);
inline constexpr std::string_view order_key = "block_order";

/// "sorting, thresholds"; empty: as the protocol has them.
std::string described(const BlockOrder& order);

/// Paths in it count from the file's folder. Protocols are read too: each must be valid and have
/// every block of the orders.
/// @throws InvalidFile with every mistake at its line and column
StudyPlan parse_study(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_study
StudyPlan load_study(const std::string& path);

}  // namespace heft
