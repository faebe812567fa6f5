// Writes, reads and checks progress.csv.
#include "harness/record/row_progress.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/files/folders/file_hash.h"
#include "harness/record/part.h"

namespace touchstone::record {
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
