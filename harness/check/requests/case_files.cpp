// Reads requests to check from files.
#include "harness/check/requests/case_files.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>

#include "harness/base/error.h"
#include "harness/check/requests/select_cases.h"
#include "harness/check/requests/select_narrow.h"
#include "harness/files/folders/folder_name.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/selection.h"

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
void read_common(files::TomlTable& table, CheckRequest& request) {
  if (table.has("scalars")) {
    request.scalars.clear();
    for (const toml::node* node : table.elements("scalars")) {
      request.scalars.push_back(
          static_cast<Precision>(table.choice_of(*node, "scalars", scalar_names)));
    }
  }
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  request.seed = static_cast<std::uint64_t>(table.integer("seed", 0, most, 1));
  request.time_limit = table.number("time_limit", files::positive, request.time_limit);
}

// Reads the names of algorithms.
CaseSelection read_algorithms(files::TomlTable& table) {
  const auto read = [&](std::string_view key) {
    return table.has(key) ? list_of(table, key) : std::string();
  };
  CaseSelection selection;
  selection.with = read("with");
  selection.kinds = read("kinds");
  selection.pair = read("narrow");
  for (const kinds::Kind* kind : kinds::kinds()) selection.others[kind] = read(kind->old_name());
  return selection;
}

// Names that there are not are reported at their keys.
void expect_algorithms(files::TomlTable& table, const CaseSelection& selection,
                       const CheckRequest& request) {
  const auto expect = [&](std::string_view key, const std::string& list, const auto& take) {
    if (list.empty()) return;
    selected(table, key, [&] {
      take(list);
      return true;
    });
  };
  expect("narrow", selection.pair,
         [&](const auto& list) { narrow_phases_to_grade(list, request.scalars); });
  expect("broad", selection.box, [](const auto& list) {
    kinds::select(registry::entries<BroadPhaseEntry>(), kinds::split_names(list), "broad phase");
  });
  for (const auto& [kind, names] : selection.others) {
    expect(kind->old_name(), names, [&, kind = kind](const auto& list) {
      kind->contestants(kinds::split_names(list), request.scalars);
    });
  }
}

// Reads the cases of a check or a soak.
void read_cases_of(files::TomlTable& table, CaseSelection& selection, const char* fallback,
                   CheckRequest& request) {
  selection.regimes = list_of(table, "regimes");
  selection.groups = list_of(table, "groups");
  expect_algorithms(table, selection, request);
  selected(table, selection.regimes.empty() ? "groups" : "regimes", [&] {
    select_cases(selection, fallback, request);
    return true;
  });
}

CheckRequest read_check(files::TomlTable& table) {
  CheckRequest request;
  read_common(table, request);
  CaseSelection selection = read_algorithms(table);
  if (table.has("broad")) selection.box = list_of(table, "broad");
  read_cases_of(table, selection, "all", request);
  request.cases = static_cast<int>(table.integer("cases", 1, 1'000'000, request.cases));
  request.rounds = static_cast<int>(table.integer("rounds", 1, 1'000'000'000, 1));
  return request;
}

StressRequest read_stress(files::TomlTable& table) {
  StressRequest request;
  read_common(table, request);
  const CaseSelection selection = read_algorithms(table);
  expect_algorithms(table, selection, request);
  const std::string axes = list_of(table, "axes");
  selected(table, "axes", [&] {
    select_axes_and_algorithms(selection, axes, request);
    return true;
  });
  request.cases = static_cast<int>(table.integer("cases", 1, 100'000, request.cases));
  return request;
}

// `key` is that of the number of cases.
SoakRequest read_soak(files::TomlTable& table, std::string_view key) {
  SoakRequest request;
  read_common(table, request);
  CaseSelection selection = read_algorithms(table);
  if (selection.is_unsaid()) selection.pair = "certified";
  read_cases_of(table, selection, "none", request);
  request.pairs = table.integer(key, 1, 1'000'000'000'000, request.pairs);
  return request;
}

// Reads a table [check], which with `axes` is a sweep and with `count` a soak.
std::variant<CheckRequest, StressRequest, SoakRequest> read_any_check(files::TomlTable& table) {
  if (table.has("axes")) {
    if (table.has("count")) table.fail("count", "expected it without `axes`");
    return read_stress(table);
  }
  if (table.has("count")) return read_soak(table, "count");
  return read_check(table);
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
  read.name = files::folder_name(top, file);
  const auto kind = std::ranges::find_if(kinds, [&](auto key) { return top.has(key); });
  if (kind == kinds.end()) {
    throw base::InputError(file.string(), 0, "expected a table [check], [stress] or [soak]");
  }
  files::TomlTable table = top.inside(*kind, std::string(*kind));
  switch (kind - kinds.begin()) {
    case 0: read.request = read_any_check(table); break;
    case 1: read.request = read_stress(table); break;
    default: read.request = read_soak(table, "pairs"); break;
  }
  table.finish();
  top.finish();  // a second table of these is an unknown key
  return read;
}

}  // namespace touchstone::check
