// Files with one edit, for tests of mistakes. "^" in an edit marks the expected place of the
// mistake and is removed from the file.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "SourceFolder.h"
#include "base/Error.h"

namespace heft {

struct Edit {
  std::string was, is;  ///< the first `was` of the file becomes `is`
};

struct EditedFile {
  std::string text;
  int line = 0, column = 0;  ///< of the mark; 0 without one
};

inline EditedFile edited(std::string text, const Edit& edit) {
  const auto at = text.find(edit.was);
  if (at == std::string::npos) throw std::logic_error("no \"" + edit.was + "\" to edit");
  text.replace(at, edit.was.size(), edit.is);
  EditedFile file{text};
  const auto mark = text.find('^');
  if (mark == std::string::npos) return file;
  file.text.erase(mark, 1);
  file.line = 1;
  for (std::size_t i = 0; i < mark; ++i) {
    file.column = text[i] == '\n' ? 0 : file.column + 1;
    if (text[i] == '\n') ++file.line;
  }
  ++file.column;
  return file;
}

/// The mistakes found by parsing; none if the file is valid.
inline std::vector<Mistake> mistakes_of(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const InvalidFile& error) {
    return error.mistakes();
  }
  return {};
}

/// An edit that causes one mistake.
struct Broken {
  const char* name;
  Edit edit;
  std::vector<std::string> says;  ///< parts of the expected message
};

inline std::string name_of_broken(const testing::TestParamInfo<Broken>& broken) {
  return broken.param.name;
}

inline void PrintTo(const Broken& broken, std::ostream* out) {
  *out << broken.edit.is;
}

/// Expects that the edit causes exactly one mistake, at the mark, with the expected message.
inline void expect_broken(const std::string& base, const Broken& broken,
                          const std::function<void(const std::string& text)>& parse) {
  const auto file = edited(base, broken.edit);
  const auto mistakes = mistakes_of([&] { parse(file.text); });
  ASSERT_EQ(mistakes.size(), 1u) << InvalidFile(mistakes).what();
  EXPECT_EQ(to_string(mistakes[0].place), to_string(SourcePlace{"x.toml", file.line, file.column}))
      << mistakes[0].message;
  for (const std::string& part : broken.says)
    EXPECT_NE(mistakes[0].message.find(part), std::string::npos)
        << "\"" << part << "\" is not in: " << mistakes[0].message;
}

inline std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("can't read " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline const std::vector<std::string>& shipped_protocols() {
  static const std::vector<std::string> names{"paper", "sorting", "jnd", "quick", "recommended"};
  return names;
}

inline std::string shipped_path(const std::string& name) {
  return source_folder() + "/protocols/" + name + ".toml";
}

}  // namespace heft
