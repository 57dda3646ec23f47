#include "base/Build.h"

#include <elf.h>
#include <fmt/chrono.h>
#include <link.h>

#include <chrono>
#include <cstring>
#include <ctime>

#include "base/Error.h"

namespace heft {

namespace {

using Clock = std::chrono::system_clock;

std::string hexadecimal(const unsigned char* bytes, std::size_t n) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += fmt::format("{:02x}", bytes[i]);
  return text;
}

// Looks through the notes of one ELF segment for the GNU build id.
std::string build_id_in(const char* notes, std::size_t size) {
  const auto padded = [](std::size_t n) { return (n + 3) & ~std::size_t{3}; };
  std::size_t at = 0;
  while (at + sizeof(ElfW(Nhdr)) <= size) {
    ElfW(Nhdr) header;
    std::memcpy(&header, notes + at, sizeof(header));
    const char* name = notes + at + sizeof(header);
    const char* content = name + padded(header.n_namesz);
    if (header.n_type == NT_GNU_BUILD_ID && header.n_namesz == 4 && !std::memcmp(name, "GNU", 4))
      return hexadecimal(reinterpret_cast<const unsigned char*>(content), header.n_descsz);
    at += sizeof(header) + padded(header.n_namesz) + padded(header.n_descsz);
  }
  return {};
}

// dl_iterate_phdr visits the program itself first; the libraries after it are not looked at.
int visit(dl_phdr_info* info, std::size_t, void* id) {
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const auto* notes = reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr);
    const std::string found = build_id_in(notes, segment.p_memsz);
    if (!found.empty()) *static_cast<std::string*>(id) = found;
  }
  return 1;
}

}  // namespace

std::string build_name() {
  std::string id;
  dl_iterate_phdr(visit, &id);
  return fmt::format("gcc {} {} build {}", __VERSION__, sizeof(void*) == 8 ? "64-bit" : "32-bit",
                     id.empty() ? "unknown" : id);
}

std::string utc_of(std::chrono::system_clock::time_point time) {
  // Downwards, before 1970 as well.
  const auto second = std::chrono::floor<std::chrono::seconds>(time);
  const auto ms = std::chrono::floor<std::chrono::milliseconds>(time - second).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(Clock::to_time_t(second)), ms);
}

std::string utc_now() {
  return utc_of(Clock::now());
}

double seconds_since(const std::string& utc) {
  std::tm time{};
  const char* rest = strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%S", &time);
  // Before 1970 an earlier heft wrote what is to be taken off the second: "59.-250Z".
  const bool counts_down = rest && std::string_view(rest).starts_with(".-");
  const std::string fraction = !rest ? "" : counts_down ? "-." + std::string(rest + 2) : rest;
  char* end = nullptr;
  const double fraction_s = std::strtod(fraction.c_str(), &end);
  if (!rest || std::string_view(end) != "Z")
    throw Error(fmt::format("\"{}\" is no UTC time, expected YYYY-MM-DDThh:mm:ss.sssZ", utc));
  const double started_s = static_cast<double>(timegm(&time)) + fraction_s;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count() - started_s;
}

}  // namespace heft
