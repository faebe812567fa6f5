// Tells machines apart by their facts.
#include "harness/shards/machines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include "harness/base/error.h"
#include "harness/record/machine.h"
#include "harness/shards/shard_run.h"

namespace touchstone::shards {
namespace {

// What differs from run to run on one machine.
constexpr std::array<std::string_view, 3> facts_of_runs = {"command_line", "commit", "tree"};

// Returns the names of the facts that describe a machine and its program.
const std::set<std::string>& names_of_machine_facts() {
  static const std::set<std::string> names = [] {
    std::set<std::string> all;
    for (const auto& [name, value] : record::machine_facts()) all.insert(name);
    for (const std::string_view name : facts_of_runs) all.erase(std::string(name));
    return all;
  }();
  return names;
}

}  // namespace

std::string Machines::name_of(const record::Facts& part) {
  record::Facts facts;
  for (const auto& fact : part) {
    const bool is_cache = fact.first.starts_with("cache_");  // another machine may have more
    if (is_cache || names_of_machine_facts().contains(fact.first)) facts.push_back(fact);
  }
  const std::string host = record::value_of(part, host_fact);
  std::string name = host;
  for (int number = 2;; ++number) {
    const auto [at, is_new] = facts_.try_emplace(name, facts);
    if (is_new || at->second == facts) return name;
    name = fmt::format("{}-{}", host, number);
  }
}

record::Facts Machines::shared() const {
  if (facts_.empty()) return {};
  record::Facts shared;
  for (const auto& [name, value] : facts_.begin()->second) {
    const bool is_equal = std::ranges::all_of(facts_, [&](const auto& machine) {
      return record::value_of(machine.second, name) == value;
    });
    shared.emplace_back(name, is_equal ? value : "differs: see machines/");
  }
  return shared;
}

void Machines::write(const std::filesystem::path& folder) const {
  for (const auto& [name, facts] : facts_) {
    const std::filesystem::path own = folder / "machines" / name;
    std::error_code error;
    std::filesystem::create_directories(own, error);
    if (error) throw base::InputError(own.string(), 0, "cannot be made: " + error.message());
    record::write_facts(own / "machine.csv", facts, files::CsvWriter::Durable::against_kills);
  }
}

}  // namespace touchstone::shards
