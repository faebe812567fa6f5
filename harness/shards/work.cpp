// Reads the work of a file.
#include "harness/shards/work.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/error.h"
#include "harness/check/check_file.h"
#include "harness/files/toml_table.h"

namespace touchstone::shards {

std::unique_ptr<Work> read_work(const std::filesystem::path& file,
                                const std::filesystem::path& home) {
  if (check::has_check(file)) return check_work(file);
  if (files::has_key(file, "trade")) return trade_work(file, home);
  return campaign_work(file, home);
}

void expect_no_earlier(const std::filesystem::path& earlier) {
  if (earlier.empty()) return;
  throw base::InputError(earlier.string(), 0,
                         "is for the estimate of a campaign; expected no --from with other work");
}

void expect_facts(const record::Facts& planned, const record::Facts& now) {
  for (const auto& [name, value] : now) {
    const auto at = std::ranges::find(planned, name, &record::Facts::value_type::first);
    const std::string before = at == planned.end() ? "" : at->second;
    if (before == value) continue;
    throw base::InputError(fmt::format(
        "{} is '{}', and was '{}' when the plan was made; expected the same{}", name, value, before,
        name == "program" ? " build of the program for all shards" : ""));
  }
}

}  // namespace touchstone::shards
