// Binds values to a prepared statement, in order and bit for bit, and adds them to the row's
// digest. Private to record.
#pragma once

#include <SQLiteCpp/Statement.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/Error.h"
#include "base/Names.h"
#include "experiment/Rows.h"
#include "record/schema/Digests.h"

namespace heft {

class Binding {
 public:
  template <typename... Values>
  explicit Binding(SQLite::Statement& statement, const Values&... values) : statement_(statement) {
    ((*this << values), ...);
  }
  Binding(const Binding&) = delete;
  /// Resets the statement for the next row, also after a failure.
  ~Binding() { statement_.tryReset(); }

  /// Adds all following values to the digest.
  Binding& also_into(RowDigest& digest) {
    digest_ = &digest;
    return *this;
  }

  template <std::integral Integer>
  Binding& operator<<(Integer value) {
    const auto written = static_cast<std::int64_t>(value);
    statement_.bind(++place_, written);
    if (digest_) digest_->integer(written);
    return *this;
  }
  /// For a REAL column, which stores -0.0 as 0.0.
  Binding& operator<<(double value) { return exactly(value + 0.0); }
  /// For an ANY column, which keeps every bit.
  Binding& exactly(double value) {
    // SQLite would silently store NULL.
    if (std::isnan(value)) throw Error("a value of its row is not a number (NaN)");
    statement_.bind(++place_, value);
    if (digest_) digest_->real(value);
    return *this;
  }
  Binding& operator<<(const std::string& value) {
    statement_.bind(++place_, value);
    if (digest_) digest_->text(value);
    return *this;
  }
  template <typename Enum>
  requires std::is_enum_v<Enum> Binding& operator<<(Enum value) {
    return *this << std::string(name_of(value));
  }
  template <typename Value>
  Binding& operator<<(const std::optional<Value>& value) {
    if (value) return *this << *value;
    return null();
  }
  Binding& null() {
    statement_.bind(++place_);
    if (digest_) digest_->null();
    return *this;
  }

  void run() { statement_.exec(); }
  /// Binds the digest as the last value and runs the statement. @return the digest
  std::string run_with_digest() {
    std::string digest = std::exchange(digest_, nullptr)->value();
    *this << digest;
    run();
    return digest;
  }
  /// @return whether there is a row
  bool step() { return statement_.executeStep(); }

 private:
  SQLite::Statement& statement_;
  int place_ = 0;
  RowDigest* digest_ = nullptr;
};

/// Executes a statement without result rows, with bound values.
template <typename... Values>
void run(SQLite::Statement& statement, const Values&... values) {
  Binding(statement, values...).run();
}

/// Binds a row's fields.
template <typename Row>
void bind_row(Binding& places, const Row& row) {
  visit_cells(row, [&](const CellColumn& column, const auto& value) {
    if constexpr (std::same_as<decltype(value), const double&>)
      column.exact ? places.exactly(value) : places << value;
    else
      places << value;
  });
}

}  // namespace heft
