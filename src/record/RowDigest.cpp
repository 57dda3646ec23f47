#include "record/RowDigest.h"

#include <SQLiteCpp/Column.h>
#include <sqlite3.h>

#include <array>
#include <bit>

#include "base/Sha256.h"

namespace heft {

void RowDigest::begin(std::string_view table, std::string_view previous) {
  bytes_.clear();
  text(table);
  text(previous);
}

void RowDigest::null() {
  bytes_ += 'n';
}

void RowDigest::integer(std::int64_t value) {
  bytes_ += 'i';
  eight_bytes(static_cast<std::uint64_t>(value));
}

void RowDigest::real(double value) {
  bytes_ += 'r';
  eight_bytes(std::bit_cast<std::uint64_t>(value));
}

void RowDigest::text(std::string_view value) {
  sized('t', value);
}

void RowDigest::cell(const SQLite::Column& cell) {
  switch (cell.getType()) {
    case SQLITE_INTEGER:
      return integer(cell.getInt64());
    case SQLITE_FLOAT:
      return real(cell.getDouble());
    case SQLITE_TEXT:
      return text(cell.getString());
    case SQLITE_BLOB:
      return sized('b', cell.getString());
    default:
      return null();
  }
}

std::string RowDigest::value() const {
  return sha256(bytes_);
}

void RowDigest::sized(char type, std::string_view bytes) {
  bytes_ += type;
  eight_bytes(bytes.size());
  bytes_ += bytes;
}

void RowDigest::eight_bytes(std::uint64_t bits) {
  std::array<char, 8> bytes{};
  for (char& byte : bytes) {
    byte = static_cast<char>(bits & 0xff);
    bits >>= 8;
  }
  bytes_.append(bytes.data(), bytes.size());
}

}  // namespace heft
