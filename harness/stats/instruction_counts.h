// Counts of instructions before and after a change. They do not depend on noise, so that they need no interval.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::stats {

struct InstructionCount {
  std::string benchmark;
  double a = 0, b = 0;  // instructions of a query, or of the whole program

  double ratio() const { return b / a; }
};

struct InstructionComparison {
  std::vector<InstructionCount> counts;  // in the order of A
  std::vector<std::string> only_in_b;    // benchmarks

  // Those whose ratio is above 1 + threshold, the greatest first.
  std::vector<InstructionCount> slower(double threshold) const;
};

// Returns whether the file has counts: `bench --instructions` or Callgrind wrote it.
bool has_instructions(const std::filesystem::path& file);

// Compares two files of counts. Those of Callgrind are of one program, whatever its name. Throws base::InputError, with
// file and line, for malformed files, a file without counts, a benchmark that is there twice, and one that B lacks.
InstructionComparison compare_instructions(const std::filesystem::path& a,
                                           const std::filesystem::path& b);

}  // namespace touchstone::stats
