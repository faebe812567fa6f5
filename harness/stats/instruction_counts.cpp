// Reads two files of counts, and joins them.
#include "harness/stats/instruction_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>

#include "harness/base/error.h"
#include "harness/files/callgrind.h"
#include "harness/files/csv.h"

namespace touchstone::stats {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string>& count_columns() {
  static const std::vector<std::string> columns = {"benchmark", "instructions"};
  return columns;
}

// The name of all programs that Callgrind counted.
constexpr const char* whole_program = "the program";

struct Counts {
  std::vector<std::string> names;
  std::map<std::string, double> of;
};

Counts read_counts(const fs::path& file) {
  if (!has_instructions(file)) {
    throw base::InputError(file.string(), 0,
                           "has no counts of instructions; expected a file of `bench "
                           "--instructions` or of Callgrind, as the other is");
  }
  Counts counts;
  if (files::is_callgrind(file)) {
    counts.names.emplace_back(whole_program);
    counts.of[whole_program] = static_cast<double>(files::read_callgrind(file).instructions);
  } else {
    files::CsvReader(file, count_columns()).read([&](const files::CsvReader::Row& row) {
      const std::string name(row.text(0));
      const double instructions = row.number(1);
      if (!(instructions > 0)) {
        row.fail(fmt::format("instructions: found {}; expected > 0", row.text(1)));
      }
      if (!counts.of.emplace(name, instructions).second) {
        row.fail(fmt::format("benchmark: found '{}' again; expected it once", name));
      }
      counts.names.push_back(name);
    });
  }
  if (counts.names.empty()) throw base::InputError(file.string(), 0, "has no count; expected one");
  return counts;
}

}  // namespace

std::vector<InstructionCount> InstructionComparison::slower(double threshold) const {
  std::vector<InstructionCount> found;
  std::ranges::copy_if(counts, std::back_inserter(found),
                       [&](const InstructionCount& one) { return one.ratio() > 1 + threshold; });
  std::ranges::stable_sort(found, std::greater<>(), &InstructionCount::ratio);
  return found;
}

bool has_instructions(const fs::path& file) {
  if (!fs::is_regular_file(file)) return false;
  if (files::is_callgrind(file)) return true;
  std::string head;
  std::ifstream stream(file);
  std::getline(stream, head);
  if (head.ends_with('\r')) head.pop_back();
  return head == "benchmark,queries,instructions";
}

InstructionComparison compare_instructions(const fs::path& a, const fs::path& b) {
  const Counts before = read_counts(a);
  Counts now = read_counts(b);
  InstructionComparison comparison;
  for (const std::string& name : before.names) {
    const auto at = now.of.find(name);
    if (at == now.of.end()) {
      throw base::InputError(
          b.string(), 0,
          fmt::format("has no count of '{}'; expected it, as {} has it", name, a.string()));
    }
    comparison.counts.push_back({name, before.of.at(name), at->second});
    now.of.erase(at);
  }
  for (const std::string& name : now.names) {
    if (now.of.contains(name)) comparison.only_in_b.push_back(name);
  }
  return comparison;
}

}  // namespace touchstone::stats
