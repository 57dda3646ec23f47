// A study plan (STUDY.toml): participants, groups and orders of blocks. Independent of the sessions
// so far, which are in the log (apparatus/StudyPlaces.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/Names.h"
#include "experiment/SessionConfig.h"

namespace heft {

/// Designs of the orders of n blocks. latin: n orders, with each block once in each position.
/// balanced: also each block equally often directly after each other one (Williams 1949: n orders
/// of an even number of blocks, 2n of an odd one). rows: the orders listed in the file.
enum class OrderDesign { latin, balanced, rows };
template <>
struct EnumNames<OrderDesign> {
  static constexpr std::array<std::string_view, 3> names{"latin", "balanced", "rows"};
};

/// Names of blocks in order. Empty: the protocol's order.
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
  std::string run_by;                                   ///< the experimenter; empty: unknown
};

/// The plan for one participant.
struct StudyPlace {
  int number = 0;  ///< 1...participants
  int group = 0;   ///< index of StudyPlan::groups
  int order = 0;   ///< index of StudyPlan::orders
};

/// The orders of a design; `rows` has only those listed. The assignment of blocks depends on the
/// seed.
/// @param blocks two or more names
std::vector<BlockOrder> designed_orders(OrderDesign design, std::vector<std::string> blocks,
                                        std::uint64_t seed);

/// Places 1...n are in rounds of each group with each order once, in random order; within a round,
/// each section with as many places as groups has each group once. More participants do not change
/// existing places.
StudyPlace place_in(const StudyPlan& plan, int number);

/// "P07": with as many digits as the last participant's, but at least two.
std::string planned_id(const StudyPlan& plan, int number);

/// The order as the protocol's key `block_order`: block_order=["a", "b"]. Empty: nothing to set.
ProtocolSetting order_setting(const BlockOrder& order);
inline constexpr std::string_view order_key = "block_order";

/// "sorting, thresholds"; empty: the protocol's order.
std::string described(const BlockOrder& order);

/// Paths are relative to the file's folder. Protocols are read, too: each must be valid and have
/// every block of the orders.
/// @throws InvalidFile with every mistake at its line and column
StudyPlan parse_study(const std::string& text, const std::string& file);

/// @throws Error if the file cannot be read, InvalidFile as parse_study
StudyPlan load_study(const std::string& path);

}  // namespace heft
