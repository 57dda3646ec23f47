// Untrusted texts are displayed, never interpreted.
#include "base/files/Printable.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>

#include "base/Random.h"

namespace heft {
namespace {

TEST(Escaped, WhatATerminalWouldObeyIsShown) {
  EXPECT_EQ(escaped("plain, \xc3\xa9t\xc3\xa9, \xe8\xb3\xaa\xe9\x87\x8f, \xf0\x9f\x91\x8b"),
            "plain, \xc3\xa9t\xc3\xa9, \xe8\xb3\xaa\xe9\x87\x8f, \xf0\x9f\x91\x8b");
  EXPECT_EQ(escaped("a\x1b[31mred\x07\r\n\tb\x7f"), "a\\x1b[31mred\\x07\\x0d\n\tb\\x7f");
  EXPECT_EQ(escaped_line("a\n\tb"), "a\\x0a\\x09b");
  EXPECT_EQ(escaped("\xc2\x9b"
                    "31m"),
            "\\x9b31m");                                                    // CSI as one letter
  EXPECT_EQ(escaped("\x9b\xff\xc0\xaf"), "\\x9b\\xff\\xc0\\xaf");           // no UTF-8
  EXPECT_EQ(escaped("\xed\xa0\x80\xf4\x90"), "\\xed\\xa0\\x80\\xf4\\x90");  // half a pair, cut off
  EXPECT_EQ(escaped("exe.\xe2\x80\xaegpj"), "exe.\\u202egpj");
  EXPECT_EQ(escaped(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Escaped, NothingThatActsComesThrough) {
  RandomStream random(20261121, "bytes");
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (int k = 0; k < 40; ++k) text += static_cast<char>(random.below(256));
    const std::string shown = escaped_line(text);
    EXPECT_EQ(escaped_line(shown), shown);
    for (const char c : shown) EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' && c != 0x7f);
  }
}

std::string as_bash_reads(const std::string& word) {
  const std::string command = "bash -c \"$HEFT_COMMAND\"";
  ::setenv("HEFT_COMMAND", ("printf %s " + word).c_str(), 1);
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string read;
  std::array<char, 256> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe.get()))
    read.append(part.data(), n);
  return read;
}

TEST(ShellQuoted, IsTheSameWordToAShell) {
  EXPECT_EQ(shell_quoted("lab/heft-1.db"), "lab/heft-1.db");
  EXPECT_EQ(shell_quoted("my lab.db"), "'my lab.db'");
  for (const std::string word : {"my lab.db", "", "it's", "$(reboot)", "a;b|c&d", "~", "*", "-x y",
                                 "`id`", "two\nlines", "bell\x07'\\", "\xc3\xa9 t", "\x9b", "!x"}) {
    EXPECT_EQ(as_bash_reads(shell_quoted(word)), word) << shell_quoted(word);
    EXPECT_EQ(escaped_line(shell_quoted(word)), shell_quoted(word)) << "can be printed and copied";
  }
}

}  // namespace
}  // namespace heft
