// Errors for people: what went wrong, where, why and what to do. Thrown as exceptions; the command
// line turns them into a message on stderr and an exit code.
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
  invalid_file = 3,    ///< a protocol, procedure, scene or board file has mistakes
  device_missing = 4,  ///< a camera, display or other device is not there
  diverged = 5,        ///< a replayed log differs from what was logged
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

/// "file:line:column", as editors and terminals understand it.
std::string to_string(const SourcePlace& place);

/// One mistake in a file: where it is, and what is wrong, was expected and can be done.
struct Mistake {
  SourcePlace place;
  std::string message;
};

/// All mistakes found in a file, one line each in what().
class InvalidFile : public Error {
 public:
  explicit InvalidFile(std::vector<Mistake> mistakes);
  const std::vector<Mistake>& mistakes() const { return mistakes_; }

 private:
  std::vector<Mistake> mistakes_;
};

}  // namespace heft
