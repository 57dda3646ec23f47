#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/Random.h"
#include "protocol/study/StudyPlan.h"

namespace heft {

namespace {
using Row = std::vector<std::size_t>;

// 0, 1, n-1, 2, n-2...: neighbors differ by each number once, so that in its n shifted rows each
// block follows each other one once (n even).
Row zigzag(std::size_t n) {
  Row row{0};
  for (std::size_t i = 1; i < n; ++i) row.push_back(i % 2 == 1 ? (i + 1) / 2 : n - i / 2);
  return row;
}

Row counted(std::size_t n) {
  Row row(n);
  std::iota(row.begin(), row.end(), std::size_t{0});
  return row;
}

// The rows that are shifts of the first.
std::vector<Row> square_of(const Row& first) {
  std::vector<Row> rows;
  for (std::size_t shift = 0; shift < first.size(); ++shift) {
    Row row = first;
    for (std::size_t& place : row) place = (place + shift) % first.size();
    rows.push_back(std::move(row));
  }
  return rows;
}

// An odd number of blocks is balanced by the square and its mirror image together.
std::vector<Row> balanced_rows(std::size_t n) {
  std::vector<Row> rows = square_of(zigzag(n));
  if (n % 2 == 0) return rows;
  const std::size_t n_rows = rows.size();
  for (std::size_t i = 0; i < n_rows; ++i) rows.emplace_back(rows[i].rbegin(), rows[i].rend());
  return rows;
}

template <typename T>
void shuffle(std::vector<T>& items, RandomStream& stream) {
  stream.shuffle(std::span<T>(items));
}

// The places of one round, in their order.
std::vector<StudyPlace> round_of(const StudyPlan& plan, std::uint64_t round) {
  RandomStream stream(plan.seed, "study places", round);
  std::vector<std::vector<int>> orders(plan.groups.size());
  for (std::vector<int>& of_group : orders) {
    of_group.resize(plan.orders.size());
    std::iota(of_group.begin(), of_group.end(), 0);
    shuffle(of_group, stream);
  }
  std::vector<StudyPlace> places;
  for (std::size_t part = 0; part < plan.orders.size(); ++part) {
    std::vector<int> groups(plan.groups.size());
    std::iota(groups.begin(), groups.end(), 0);
    shuffle(groups, stream);
    for (const int group : groups)
      places.push_back({0, group, orders[static_cast<std::size_t>(group)][part]});
  }
  return places;
}

std::string toml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}
}  // namespace

std::vector<BlockOrder> designed_orders(OrderDesign design, std::vector<std::string> blocks,
                                        std::uint64_t seed) {
  RandomStream stream(seed, "study orders");
  shuffle(blocks, stream);
  std::vector<BlockOrder> orders;
  for (const Row& row : design == OrderDesign::balanced ? balanced_rows(blocks.size())
                                                        : square_of(counted(blocks.size()))) {
    BlockOrder& order = orders.emplace_back();
    for (const std::size_t place : row) order.push_back(blocks[place]);
  }
  return orders;
}

StudyPlace place_in(const StudyPlan& plan, int number) {
  const auto n_round = static_cast<int>(plan.groups.size() * plan.orders.size());
  const int round = (number - 1) / n_round;
  StudyPlace place = round_of(
      plan, static_cast<std::uint64_t>(round))[static_cast<std::size_t>((number - 1) % n_round)];
  place.number = number;
  return place;
}

std::string planned_id(const StudyPlan& plan, int number) {
  const std::size_t digits = std::max<std::size_t>(2, fmt::format("{}", plan.participants).size());
  return fmt::format("{}{:0{}}", plan.id_prefix, number, digits);
}

ProtocolSetting order_setting(const BlockOrder& order) {
  if (order.empty()) return {};
  std::vector<std::string> quoted;
  for (const std::string& block : order) quoted.push_back(toml_text(block));
  return {std::string(order_key), fmt::format("[{}]", fmt::join(quoted, ", "))};
}

std::string described(const BlockOrder& order) {
  return fmt::format("{}", fmt::join(order, ", "));
}

}  // namespace heft
