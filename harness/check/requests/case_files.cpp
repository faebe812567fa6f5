// Reads requests to check, stress and soak from files.
#include "harness/check/requests/case_files.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>

#include "harness/base/error.h"
#include "harness/campaign/selection.h"
#include "harness/check/regimes/select_regimes.h"
#include "harness/check/requests/select_narrow.h"
#include "harness/files/toml_table.h"

namespace touchstone::check {
namespace {

constexpr std::array<std::string_view, 3> kinds = {"check", "stress", "soak"};
constexpr std::array<std::string_view, 2> scalar_names = {"float", "double"};

std::string list_of(files::TomlTable& table, std::string_view key, const char* fallback = "") {
  return fmt::format("{}", fmt::join(table.texts(key, {fallback}), ","));
}

// A name that there is not is reported with its place.
template <class Select>
auto selected(files::TomlTable& table, std::string_view key, const Select& select) {
  try {
    return select();
  } catch (const base::InputError& error) {
    table.fail(key, error.what());
  }
}

// Reads the keys that all three have. A soak takes what it is told to, and the others no oracle
// that is not named.
void read_common(files::TomlTable& table, CheckRequest& request, const char* narrow) {
  if (table.has("scalars")) {
    request.scalars.clear();
    for (const toml::node* node : table.elements("scalars")) {
      request.scalars.push_back(
          static_cast<Precision>(table.choice_of(*node, "scalars", scalar_names)));
    }
  }
  const std::string names = list_of(table, "narrow", narrow);
  request.narrow =
      selected(table, "narrow", [&] { return narrow_phases_to_grade(names, request.scalars); });
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  request.seed = static_cast<std::uint64_t>(table.integer("seed", 0, most, 1));
  request.time_limit = table.number("time_limit", files::positive, request.time_limit);
}

void read_regimes(files::TomlTable& table, CheckRequest& request) {
  const std::string names = list_of(table, "regimes"), groups = list_of(table, "groups");
  request.regimes = selected(table, names.empty() ? "groups" : "regimes",
                             [&] { return select_regimes(names, groups); });
}

CheckRequest read_check(files::TomlTable& table) {
  CheckRequest request;
  read_common(table, request, "all");
  read_regimes(table, request);
  const std::vector<std::string> broad = table.texts("broad", {"all"});
  request.broad = selected(table, "broad",
                           [&] { return campaign::select(broad_phases(), broad, "broad phase"); });
  request.cases = static_cast<int>(table.integer("cases", 1, 1'000'000, request.cases));
  request.rounds = static_cast<int>(table.integer("rounds", 1, 1'000'000'000, 1));
  return request;
}

StressRequest read_stress(files::TomlTable& table) {
  StressRequest request;
  read_common(table, request, "all");
  if (request.narrow.empty()) table.fail("narrow", "names no algorithm; expected at least one");
  const std::string axes = list_of(table, "axes");
  request.cells = selected(table, "axes", [&] { return cells_of(select_axes(axes)); });
  request.cases = static_cast<int>(table.integer("cases", 1, 100'000, request.cases));
  return request;
}

SoakRequest read_soak(files::TomlTable& table) {
  SoakRequest request;
  read_common(table, request, "certified");
  read_regimes(table, request);
  request.pairs = table.integer("pairs", 1, 1'000'000'000'000, request.pairs);
  return request;
}

}  // namespace

std::string_view CaseFile::kind() const { return kinds[request.index()]; }

CheckRequest& CaseFile::common() {
  return std::visit([](CheckRequest& any) -> CheckRequest& { return any; }, request);
}

bool has_case_work(const std::filesystem::path& file) {
  return std::ranges::any_of(kinds, [&](auto kind) { return files::has_key(file, kind); });
}

CaseFile read_case_file(const std::filesystem::path& file) {
  const toml::table root = files::parse_toml(file);
  files::TomlTable top(root, file.string(), "");
  CaseFile read;
  read.name = top.text("name", file.stem().string());
  const auto kind = std::ranges::find_if(kinds, [&](auto key) { return top.has(key); });
  if (kind == kinds.end()) {
    throw base::InputError(file.string(), 0, "expected a table [check], [stress] or [soak]");
  }
  files::TomlTable table = top.inside(*kind, std::string(*kind));
  switch (kind - kinds.begin()) {
    case 0: read.request = read_check(table); break;
    case 1: read.request = read_stress(table); break;
    default: read.request = read_soak(table); break;
  }
  table.finish();
  top.finish();  // a second table of these is an unknown key
  return read;
}

}  // namespace touchstone::check
