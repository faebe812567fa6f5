// Counts the instructions of a query with Valgrind's Callgrind. A noisy machine does not change the
// result.
#pragma once

#include <filesystem>
#include <string>

namespace touchstone::bench {

// Runs this program again under Valgrind and writes a row for each narrow-phase benchmark
// (benchmarks.h) whose name matches the expression (as std::regex_search does):
// `benchmark,queries,instructions`, the mean over the pairs of its batch, after one pass that is
// not counted. Valgrind supports at most AVX2. Throws InputError if Valgrind is missing now or was
// missing when this program was built, and for a filter that is malformed or matches nothing.
void count_instructions(const std::string& filter, const std::filesystem::path& out);

// The task of the second run: counts, one dump of Callgrind's per benchmark.
void count_under_valgrind(const std::string& filter);

}  // namespace touchstone::bench
