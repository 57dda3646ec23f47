// What a row's digest is taken over: its cells, one after the other, in bytes that no other row
// has. Private to this room.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace SQLite {
class Column;
}

namespace heft {

/// Each cell is a letter for its type, then an integer's or a number's 8 bytes (little-endian), or
/// a text's length and its bytes. The digest is SHA-256 over the cells `table`, `previous digest`
/// and the row's own. One value serves all rows of a table: its buffer is used again.
class RowDigest {
 public:
  /// Begins a row. @param previous the digest of the row before it, or what its chain starts from
  void begin(std::string_view table, std::string_view previous);

  void null();
  void integer(std::int64_t value);
  void real(double value);  ///< bit for bit, as the column keeps it: see Binding
  void text(std::string_view value);
  /// A cell as it is in the file, whatever its type.
  void cell(const SQLite::Column& cell);

  /// 64 hexadecimal digits.
  std::string value() const;

 private:
  void sized(char type, std::string_view bytes);
  void eight_bytes(std::uint64_t bits);

  std::string bytes_;
};

}  // namespace heft
