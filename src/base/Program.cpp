#include "base/Program.h"

#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>
#include <sys/auxv.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <vector>

#include "base/Error.h"

namespace heft {

namespace {

std::string hexadecimal(const unsigned char* bytes, std::size_t n) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += fmt::format("{:02x}", bytes[i]);
  return text;
}

// The GNU build id among the notes of one ELF segment.
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

// dl_iterate_phdr visits the program first; returning 1 skips the libraries.
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

namespace {

std::filesystem::path program_folder() {
  std::error_code none;
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  if (none)  // /proc is not mounted
    program = std::filesystem::canonical(reinterpret_cast<const char*>(getauxval(AT_EXECFN)));
  return program.parent_path();
}

// The entries of a colon-separated variable such as PATH.
std::vector<std::filesystem::path> listed(const char* variable, const char* fallback) {
  const char* value = std::getenv(variable);
  std::istringstream list(value && *value ? value : fallback);
  std::vector<std::filesystem::path> paths;
  for (std::string path; std::getline(list, path, ':');)
    if (!path.empty()) paths.emplace_back(path);
  return paths;
}

// The first folder is the checkout when the program runs from its build folder. The last one serves
// programs that were copied elsewhere on the machine that built them.
std::vector<std::filesystem::path> data_folders() {
  const std::filesystem::path here = program_folder();
  std::vector<std::filesystem::path> folders{
      here.parent_path(), here.parent_path() / "share" / "heft", here / "share" / "heft"};
  for (const std::filesystem::path& path : listed("XDG_DATA_DIRS", "/usr/local/share:/usr/share"))
    folders.push_back(path / "heft");
  folders.emplace_back(HEFT_CHECKOUT);
  return folders;
}

}  // namespace

std::string installed_file_or_none(const std::string& name) {
  for (const std::filesystem::path& folder : data_folders()) {
    std::error_code none;
    if (std::filesystem::exists(folder / name, none)) return (folder / name).string();
  }
  return "";
}

std::string installed_file(const std::string& name) {
  const std::string found = installed_file_or_none(name);
  if (!found.empty()) return found;
  std::vector<std::string> tried;
  for (const std::filesystem::path& folder : data_folders()) tried.push_back(folder.string());
  throw Error(
      fmt::format("{} is missing; searched {}. Copy share/heft of an installed heft beside the "
                  "program",
                  name, fmt::join(tried, ", ")));
}

std::string bench_program() {
  const std::filesystem::path here = program_folder();
  std::vector<std::filesystem::path> folders{here, here.parent_path() / "libexec" / "heft"};
  for (const std::filesystem::path& path : listed("PATH", "")) folders.push_back(path);
  for (const std::filesystem::path& folder : folders)
    if (access((folder / "heft-bench").c_str(), X_OK) == 0) return (folder / "heft-bench").string();
  return "";
}

namespace {
// Beside the program or above it (build folder), or where both are installed.
std::string module_path(const char* module) {
  const std::filesystem::path here = program_folder();
  const std::filesystem::path library = std::filesystem::path(HEFT_LIBDIR) / "heft";
  for (const std::filesystem::path& folder :
       {here, here.parent_path(), here.parent_path() / library,
        here.parent_path().parent_path() / library}) {
    std::error_code none;
    if (std::filesystem::is_regular_file(folder / module, none)) return (folder / module).string();
  }
  return "";
}

// @return the reason for refusing a loaded module; empty: none
std::string wrong_edition(void* loaded, const char* name) {
  const auto* edition =
      static_cast<const char* const*>(dlsym(loaded, fmt::format("{}_edition", name).c_str()));
  if (!edition) return "it is no module of heft";
  if (std::string_view(*edition) == module_edition) return "";
  return fmt::format("it is of heft {}, expected {}", *edition, module_edition);
}
}  // namespace

const void* from_module(const char* module, const char* name, std::string_view purpose) {
  const std::string path = module_path(module);
  std::string why = path.empty() ? "it is not beside the program" : "";
  void* loaded = path.empty() ? nullptr : dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!path.empty()) why = loaded ? wrong_edition(loaded, name) : dlerror();
  if (why.empty())
    if (const void* found = dlsym(loaded, name)) return found;
  throw Error(
      fmt::format("the module {}, which {}, can't be loaded: {}. Install or build heft again, so "
                  "that it matches the program",
                  path.empty() ? module : path, purpose, why));
}

}  // namespace heft
