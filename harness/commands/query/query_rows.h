// The rows and the summary of touchstone query, for bodies of both kinds.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/files/csv.h"

namespace touchstone::commands {

std::vector<std::string> query_columns();

struct QueryRowHead {
  std::string_view id, algorithm, scalar, task;
};

// Writes the fields of query_columns(), and does not end the row.
void write_query_fields(files::CsvWriter& csv, const QueryRowHead& head, const Outcome& outcome);

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
