// Keeps the list of a folder's own files.
#include "harness/record/own_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <system_error>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/file_name.h"
#include "harness/base/file_text.h"
#include "harness/files/text_file.h"

namespace touchstone::record {
namespace {

namespace fs = std::filesystem;

bool is_inside(const fs::path& name) {
  return !name.empty() && name.is_relative() && std::ranges::all_of(name, [](const fs::path& part) {
    return base::is_component(part.string());
  });
}

// Calls `take` for each file beside the stem that is called the stem and an ending.
template <class Take>
void each_with_stem(const fs::path& stem, const Take& take) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(stem.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (name == stem.filename() || name.starts_with(stem.filename().string() + "."))
      take(entry.path());
  }
}

}  // namespace

OwnFiles::OwnFiles(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(list(), error);
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) {
    throw base::InputError(list().string(), 0,
                           "is no regular file; expected the list that this program writes");
  }
  std::istringstream text(files::read_text(list()));
  std::int64_t number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (!is_inside(line)) {
      throw base::InputError(list().string(), number,
                             fmt::format("found '{}'; expected the path of a file in the folder",
                                         base::shortened(line)));
    }
    names_.insert(line);
  }
}

bool OwnFiles::is_behind_link(const fs::path& name) const {
  std::error_code error;
  for (fs::path at = name.parent_path(); !at.empty(); at = at.parent_path()) {
    if (fs::is_symlink(fs::symlink_status(folder_ / at, error))) return true;
  }
  return false;
}

fs::path OwnFiles::free_stem(const fs::path& subfolder, std::string_view text) const {
  const fs::path folder = subfolder.empty() ? folder_ : folder_ / subfolder;
  if (is_behind_link(subfolder / "file")) {
    throw base::InputError(folder.string(), 0,
                           "is reached by a symbolic link; expected a folder of the results");
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw base::InputError(folder.string(), 0, "cannot be made: " + error.message());
  const std::string name = base::safe_file_name(text);
  for (int number = 1;; ++number) {
    fs::path stem = folder / (number == 1 ? name : fmt::format("{}-{}", name, number));
    bool is_free = true;
    each_with_stem(stem, [&](const fs::path&) { is_free = false; });
    if (is_free) return stem;
  }
}

void OwnFiles::note(const std::vector<fs::path>& files) {
  bool any = false;
  for (const fs::path& file : files) {
    const std::string name = file.lexically_relative(folder_).generic_string();
    any = names_.insert(name).second || any;
  }
  if (any) write();
}

void OwnFiles::note_stem(const fs::path& stem) {
  std::vector<fs::path> files;
  each_with_stem(stem, [&](const fs::path& file) { files.push_back(file); });
  note(files);
}

void OwnFiles::remove(const std::function<bool(const std::string&)>& is_meant) {
  bool any = false;
  for (auto at = names_.begin(); at != names_.end();) {
    if (!is_meant(*at)) {
      ++at;
      continue;
    }
    const fs::path name = *at;
    at = names_.erase(at);
    any = true;
    if (is_behind_link(name)) continue;
    std::error_code error;
    if (fs::is_directory(fs::symlink_status(folder_ / name, error))) continue;
    error.clear();
    fs::remove(folder_ / name, error);
    if (error) {
      throw base::InputError((folder_ / name).string(), 0,
                             "cannot be replaced: " + error.message());
    }
    // A folder that is not empty stays.
    for (fs::path up = name.parent_path(); !up.empty(); up = up.parent_path())
      fs::remove(folder_ / up, error);
  }
  if (any) write();
}

void OwnFiles::write() const {
  std::error_code error;
  if (names_.empty()) {
    fs::remove(list(), error);
    return;
  }
  files::write_text(list(), fmt::format("{}\n", fmt::join(names_, "\n")));
}

}  // namespace touchstone::record
