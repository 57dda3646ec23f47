// Errors with messages for users. The command line prints them on stderr and returns the exit code.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace heft {

/// The program's exit codes; scripts rely on them.
enum class ExitCode {
  ok = 0,
  failed = 1,
  usage = 2,
  invalid_file = 3,    ///< a protocol, procedure, scene or board file is invalid
  device_missing = 4,  ///< a camera, display or other device is missing
  diverged = 5,        ///< a replay differs from the log
  interrupted = 130
};

class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, ExitCode code = ExitCode::failed)
      : std::runtime_error(message), code_(code) {}
  ExitCode exit_code() const { return code_; }

 private:
  ExitCode code_;
};

/// A place in a text file. Lines and columns count from 1; 0 means unknown.
struct SourcePlace {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column", the format that editors and terminals make links of.
std::string to_string(const SourcePlace& place);

/// One mistake in a file. The message says what is wrong and what is expected.
struct Mistake {
  SourcePlace place;
  std::string message;
};

/// All mistakes found in a file; what() has one line each.
class InvalidFile : public Error {
 public:
  explicit InvalidFile(std::vector<Mistake> mistakes);
  const std::vector<Mistake>& mistakes() const { return mistakes_; }

 private:
  std::vector<Mistake> mistakes_;
};

}  // namespace heft
