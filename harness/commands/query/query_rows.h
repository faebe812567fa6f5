// The rows and the summary of touchstone query, for bodies of both kinds.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/vec.h"
#include "algorithms/registry.h"
#include "harness/files/csv.h"

namespace touchstone::commands {

std::vector<std::string> query_columns();

struct QueryRowHead {
  std::string_view id, algorithm, scalar, task;
};

// Writes the fields of query_columns(), and does not end the row.
void write_query_fields(files::CsvWriter& csv, const QueryRowHead& head, const Outcome& outcome);

// The numbers of each status for a summary, such as "ok 5, not_reported 2 (the library has no status)".
std::string status_counts(const std::map<Status, std::size_t>& statuses);

// For algorithms that were left out because they calculate in the other of float and double alone, prints how to ask
// them; nothing if there are none.
void print_scalar_hint(const std::vector<std::string>& names, Precision asked);

// Prints the size of what was read from a mesh file, in the file's units, which are taken for metres; to standard
// error, so that a body of ten metres that was meant to be one of ten millimetres is seen.
void tell_extent(const std::string& file, std::span<const Vec3d> vertices);

// The number of each answer and each status of every algorithm.
class QuerySummary {
 public:
  void count(std::string_view algorithm, const Outcome& outcome);
  void print() const;

 private:
  struct Counts {
    std::string algorithm;
    std::array<std::size_t, 4> answers{};
    std::map<Status, std::size_t> statuses;
  };
  std::vector<Counts> counts_;
};

}  // namespace touchstone::commands
