// Words for counts of instructions before and after a change.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/base/table.h"
#include "harness/commands/commands.h"
#include "harness/commands/compare.h"
#include "harness/files/csv.h"
#include "harness/stats/instruction_counts.h"

namespace touchstone::commands {
namespace {

using stats::InstructionCount;

base::Table table_of(const std::vector<InstructionCount>& counts) {
  base::Table table({"benchmark", "A", "B", "change"});
  for (const InstructionCount& one : counts) {
    table.add({one.benchmark, fmt::format("{:.6g}", one.a), fmt::format("{:.6g}", one.b),
               fmt::format("{:+.2f} %", 100 * (one.ratio() - 1))});
  }
  return table;
}

}  // namespace

Judgement compare_instructions(const CompareRequest& request, double threshold) {
  const stats::InstructionComparison comparison = stats::compare_instructions(request.a, request.b);
  if (!request.csv.empty()) {
    files::CsvWriter csv(request.csv, {"benchmark", "a", "b", "ratio"});
    for (const InstructionCount& one : comparison.counts) {
      csv.field(one.benchmark).field(one.a).field(one.b).field(one.ratio()).end_row();
    }
    csv.close();
  }
  const std::vector<InstructionCount> slower = comparison.slower(threshold);
  std::vector<InstructionCount> shown = request.all ? comparison.counts : slower;
  // One count is worth its line, whatever it says.
  if (comparison.counts.size() == 1) shown = comparison.counts;
  constexpr std::size_t most = 20;
  const std::size_t more = request.all || shown.size() <= most ? 0 : shown.size() - most;
  shown.resize(shown.size() - more);

  const std::string sum =
      fmt::format("{} counts of instructions compared: {} greater by more than {:g} %",
                  comparison.counts.size(), slower.size(), 100 * threshold);
  Judgement judged;
  judged.status = slower.empty() ? exit_done : exit_measured_wrong;
  judged.markdown =
      fmt::format("### Instructions: {}\n\n{}\n", slower.empty() ? "passed" : "FAILED", sum);
  if (!shown.empty()) {
    const base::Table table = table_of(shown);
    judged.text += table.text(base::page_width()) + "\n";
    judged.markdown += "\n" + table.markdown();
  }
  if (more > 0) {
    const std::string rest = fmt::format("and {} more (--all, --csv)\n", more);
    judged.text += "  " + rest;
    judged.markdown += "\n" + rest;
  }
  if (!comparison.only_in_b.empty()) {
    const std::string alone = fmt::format("{} benchmarks are in B alone, such as {}\n",
                                          comparison.only_in_b.size(), comparison.only_in_b[0]);
    judged.text += alone;
    judged.markdown += "\n" + alone;
  }
  judged.text += sum + "\n";
  return judged;
}

}  // namespace touchstone::commands
