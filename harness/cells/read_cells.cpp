// Reads a [[group]] of a kind: what all kinds have, then what is the kind's own.
#include "harness/cells/read_cells.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/base/hash.h"
#include "harness/files/text_file.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/mesh/mesh_kind.h"

namespace touchstone::cells {
namespace {

using MakeSets = std::vector<kinds::PlannedSet> (*)(files::TomlTable&,
                                                    const std::filesystem::path&);
// Timed sets that are no kind of query by themselves.
constexpr std::array<std::pair<std::string_view, MakeSets>, 3> other_sets = {
    {{"sliding", [](files::TomlTable& table,
                    const std::filesystem::path&) { return kinds::sliding_sets(table); }},
     {"motion", motion_cells},
     {"frames", frame_cells}}};

// Reads the key `kind`, and with it the sets.
std::vector<kinds::PlannedSet> read_sets(files::TomlTable& table,
                                         const std::filesystem::path& home) {
  const std::string name = table.text("kind");
  for (const auto& [other, make] : other_sets) {
    if (name == other) return make(table, home);
  }
  if (const kinds::Kind* kind = kinds::find_kind(name)) return kind->timed_sets(table, home);
  std::string known;
  for (const kinds::Kind* kind : kinds::kinds()) known += std::string(kind->name()) + ", ";
  table.fail("kind",
             fmt::format("found '{}'; expected one of {}sliding, motion, frames", name, known));
}

// Results are compared where their files have equal hashes. The table was called [cells], and kinds had other words:
// the hash is that of the file in these, so that earlier results are compared with later ones.
std::string fingerprint(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> words = {
      {{"[[group]]", "[cells]"},
       {"kind = \"ray\"", "kind = \"rays\""},
       {"kind = \"point\"", "kind = \"points\""},
       {"kind = \"cast\"", "kind = \"casts\""},
       {"kind = \"feature\"", "kind = \"ccd\""},
       {"kind = \"mesh\"", "kind = \"concave\""}}};
  for (const auto& [now, before] : words) {
    const std::size_t at = text.find(now);
    if (at != std::string::npos) text.replace(at, now.size(), before);
  }
  std::uint64_t hash = 0;
  for (const char c : text) hash = base::mix(hash ^ static_cast<unsigned char>(c));
  return base::to_hex(hash);
}

// Rows of a cell are found by its name.
void refuse_equal_names(files::TomlTable& table, const std::vector<kinds::PlannedSet>& cells) {
  std::set<std::pair<std::string, std::string>> names;
  for (const kinds::PlannedSet& cell : cells) {
    if (names.emplace(cell.group, cell.name).second) continue;
    table.fail("kind",
               fmt::format("two cells are called '{}, {}'; expected lists without repetition, "
                           "and files of different names",
                           cell.group, cell.name));
  }
}

}  // namespace

bool has_cells(const std::filesystem::path& file) {
  return files::has_key(file, "group.kind") || files::has_key(file, "cells");
}

CellRequest read_cells(const std::filesystem::path& file) {
  const toml::table root = files::parse_toml(file);
  files::TomlTable top(root, file.string(), "");
  CellRequest request;
  request.name = files::folder_name(top, file);
  if (top.has("cells")) {
    top.fail("cells", "[cells] is now `[[group]]`, with the same keys; expected that line");
  }
  std::vector<files::TomlTable> groups = top.tables("group");
  if (groups.size() != 1) top.fail("group", "expected one [[group]] in a file with `kind`");
  files::TomlTable& table = groups.front();
  request.rounds = static_cast<int>(table.integer("rounds", 6, 10'000, request.rounds));
  request.sample_seconds = table.number("sample_seconds", files::positive, request.sample_seconds);
  request.time_limit = table.number("time_limit", files::positive, request.time_limit);
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  request.seed = static_cast<std::uint64_t>(table.integer("order_seed", 0, most, 1));
  request.query_kind = table.text("kind");
  if (const kinds::Kind* kind = kinds::find_kind(request.query_kind))
    request.query_kind = kind->name();
  request.cells = read_sets(table, file.parent_path());
  refuse_equal_names(table, request.cells);
  table.finish();
  top.finish();
  request.identity = {{"cells_hash", fingerprint(files::read_text(file))}};
  return request;
}

}  // namespace touchstone::cells
