// Keeps the list of a folder's own files; writes, reads and checks progress.csv.
#include "harness/record/folder_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/base/input_file.h"
#include "harness/base/names.h"
#include "harness/files/output_file.h"
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

bool OwnFiles::has_leftover(const std::string& name) const {
  const std::string target = files::target_of_temporary(name).generic_string();
  return target == list_name || has(target);
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

namespace {

constexpr const char* file_name = "progress.csv";
constexpr const char* units_key = "units";
constexpr std::string_view hash_ending = " hash";

// Facts of the identity that the hash holds, so that rows of another part are told from these.
constexpr std::array<std::string_view, 3> hashed_facts = {"plan", "shard", part_fact};

std::string hash_name(const std::string& file) { return file + std::string(hash_ending); }

std::string hash_of(base::ByteHash rows, std::int64_t units, const Facts& identity) {
  rows.add(fmt::format("{}", units));
  for (const std::string_view name : hashed_facts) rows.add("\n" + value_of(identity, name));
  return base::to_hex(rows.value());
}

std::int64_t size_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  return error ? 0 : static_cast<std::int64_t>(size);
}

}  // namespace

void write_progress(const std::filesystem::path& folder, std::int64_t units,
                    std::span<const RowsOfFile> rows, const Facts& identity) {
  Facts facts = {{units_key, std::to_string(units)}};
  for (const RowsOfFile& file : rows) {
    facts.emplace_back(file.name, std::to_string(file.size));
    facts.emplace_back(hash_name(file.name), hash_of(file.hash, units, identity));
  }
  write_facts(folder / file_name, facts, files::CsvWriter::Durable::against_kills);
}

RowProgress::RowProgress(std::filesystem::path folder)
    : folder_(std::move(folder)), file_(folder_ / file_name), facts_(read_facts(file_)) {
  units_ = number(units_key);
}

std::int64_t RowProgress::number(const std::string& name) const {
  const std::string text = value_of(facts_, name);
  std::int64_t value = -1;
  const char* const end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, value);
  if (fault != std::errc{} || stop != end || value < 0) {
    throw base::InputError(file_.string(), 0,
                           fmt::format("{}: found '{}'; expected a number", name, text));
  }
  return value;
}

std::int64_t RowProgress::size(const std::string& file) const { return number(file); }

RowsOfFile RowProgress::expect(const std::string& file, const Facts& identity) const {
  RowsOfFile rows = {.name = file, .size = size(file), .hash = {}};
  files::add_file(rows.hash, folder_ / file, 0, rows.size);
  const std::string found = hash_of(rows.hash, units_, identity);
  const std::string expected = value_of(facts_, hash_name(file));
  if (found != expected) {
    throw base::InputError(
        (folder_ / file).string(), 0,
        fmt::format("its first {} bytes have the hash {}; expected {} of the rows of {} units, as "
                    "progress.csv says",
                    rows.size, found, expected.empty() ? "one" : expected, units_));
  }
  return rows;
}

void RowProgress::expect_all(const Facts& identity) const {
  for (const auto& [name, value] : facts_) {
    if (name == units_key || name.ends_with(hash_ending)) continue;
    const std::filesystem::path file = folder_ / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error))) {
      throw base::InputError(file.string(), 0, "is no regular file; expected the rows of the part");
    }
    if (size_of(file) != size(name)) {
      throw base::InputError(
          file.string(), 0,
          fmt::format("{} bytes; expected {}, as progress.csv says", size_of(file), size(name)));
    }
    expect(name, identity);
  }
}

}  // namespace touchstone::record
