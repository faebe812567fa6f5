// How many instructions a query takes, counted by Valgrind's Callgrind: a number that a noisy
// machine does not change.
#pragma once

#include <filesystem>
#include <string>

namespace touchstone {

// Runs this program again under Valgrind and writes a row a narrow-phase benchmark (benchmarks.h)
// whose name matches the expression (as std::regex_search does):
// `benchmark,queries,instructions`, the mean of a query over the pairs of its batch, after one pass
// that is not counted. Valgrind offers AVX2 at most. InputError where Valgrind is not there, or was
// not when this program was built, and for a filter that is no expression or matches nothing.
void count_instructions(const std::string& filter, const std::filesystem::path& out);

// What the program does when it is run again: counts, one dump of Callgrind's a benchmark.
void count_under_valgrind(const std::string& filter);

}  // namespace touchstone
