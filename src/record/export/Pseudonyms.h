// Names that stand for people's: the same person has the same one in every export with the same
// key, and without the key nobody can tell whether a name belongs to it.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// HMAC-SHA-256 (RFC 2104), 64 lowercase hexadecimal digits.
std::string hmac_sha256(std::string_view key, std::string_view text);

/// "p" and 12 hexadecimal digits: of 10,000 people two are alike once in 5 million times.
std::string pseudonym(std::string_view key, std::string_view person);

struct PseudonymKey {
  std::string file, key;
  bool is_new = false;
};

/// The key that is in a file; if there is no such file, a new one of 256 random bits in a file that
/// only its owner can read.
/// @throws Error when the file can't be read or made, or is no line of 64 lowercase hexadecimal
///   digits, or one of digits that nobody drew
PseudonymKey pseudonym_key(const std::string& file);

}  // namespace heft
