// Reads requests to check from files.
#include "harness/check/check_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>

#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/check/check_run.h"
#include "harness/check/select_cases.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/selection.h"

namespace touchstone::check {
namespace {

constexpr std::array<std::string_view, 3> tables = {"check", "stress", "soak"};
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

// Reads the keys that all modes have.
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

// Reads the names of algorithms. Those that there are not are reported at their keys.
CaseSelection read_algorithms(files::TomlTable& table, const CheckRequest& request) {
  const auto read = [&](std::string_view key) {
    return table.has(key) ? list_of(table, key) : std::string();
  };
  CaseSelection selection;
  selection.with = read("with");
  selection.kinds = read("kinds");
  for (const kinds::Kind* kind : kinds::checked_kinds()) {
    // Boxes have no axes and are not counted.
    if (request.mode != CheckMode::cases && kind->families().empty()) continue;
    const std::string list = selection.of_one[kind] = read(kind->old_name());
    if (list.empty()) continue;
    selected(table, kind->old_name(),
             [&] { return kind->contestants(kinds::split_names(list), request.scalars); });
  }
  return selection;
}

void read_selection(files::TomlTable& table, CheckRequest& request) {
  CaseSelection selection = read_algorithms(table, request);
  const bool has_axes = request.mode == CheckMode::axes;
  std::string axes;
  if (has_axes) {
    axes = list_of(table, "axes");
  } else {
    selection.regimes = list_of(table, "regimes");
    selection.groups = list_of(table, "groups");
  }
  selected(table,
           has_axes                    ? "axes"
           : selection.regimes.empty() ? "groups"
                                       : "regimes",
           [&] {
             select_cases(selection, axes, request);
             return true;
           });
}

// `table_name` is one of `tables`.
CheckRequest read_request(files::TomlTable& table, std::string_view table_name) {
  const bool says = table_name == "check";  // by a key what its mode is
  if (says && table.has("axes") && table.has("count")) {
    table.fail("count", "expected it without `axes`");
  }
  CheckMode mode = CheckMode::cases;
  if (table_name == "stress" || (says && table.has("axes"))) mode = CheckMode::axes;
  if (table_name == "soak" || (says && table.has("count"))) mode = CheckMode::count;
  CheckRequest request(mode);
  read_common(table, request);
  read_selection(table, request);
  switch (mode) {
    case CheckMode::cases:
      request.cases = static_cast<int>(table.integer("cases", 1, 1'000'000, request.cases));
      request.rounds = static_cast<int>(table.integer("rounds", 1, 1'000'000'000, 1));
      break;
    case CheckMode::axes:
      request.cases =
          static_cast<int>(table.integer("cases", 1, kinds::most_cases_of_axes, request.cases));
      break;
    case CheckMode::count:
      request.count = table.integer(table_name == "soak" ? "pairs" : "count", 1, 1'000'000'000'000,
                                    request.count);
      break;
  }
  return request;
}

}  // namespace

bool has_check(const std::filesystem::path& file) {
  return std::ranges::any_of(tables, [&](auto name) { return files::has_key(file, name); });
}

CheckFile read_check_file(const std::filesystem::path& file) {
  const toml::table root = files::parse_toml(file);
  files::TomlTable top(root, file.string(), "");
  CheckFile read;
  read.name = files::folder_name(top, file);
  const auto name = std::ranges::find_if(tables, [&](auto key) { return top.has(key); });
  if (name == tables.end()) {
    throw base::InputError(file.string(), 0, "expected a table [check], [stress] or [soak]");
  }
  files::TomlTable table = top.inside(*name, std::string(*name));
  read.request = read_request(table, *name);
  table.finish();
  top.finish();  // a second table of these is an unknown key
  return read;
}

CheckEnd run_and_tell(const CheckRequest& request) {
  const CheckReport report = run_check(request);
  if (request.part || report.interrupted) return {.text = {}, .interrupted = report.interrupted};
  return {summary_text(report, base::page_width()), !report.ours_wrong().empty()};
}

}  // namespace touchstone::check
