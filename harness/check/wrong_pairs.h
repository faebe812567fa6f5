// The pairs that versions of a library get wrong, with what each version answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/check/graded_answers.h"
#include "harness/kinds/check_request.h"

namespace touchstone::check {

inline constexpr std::string_view wrong_pairs_file = "wrong_pairs.jsonl";
inline constexpr std::size_t most_wrong_pairs = 12;  // of a version in a group, the worst

struct WrongPair {
  struct Given {
    std::string algorithm;
    Precision scalar{};
    std::string task;
    AnswerState state{};
    double error = 0;  // a part of the pair's scale
  };

  std::string group, regime;
  std::int64_t index = 0;      // in the regime
  std::vector<Given> answers;  // of all versions of the libraries that have a wrong one
};

// Writes the pairs into wrong_pairs.jsonl of the request's folder: a case a line, as files::read_cases reads it, with the
// keys `group` and `answers`. The versions are asked again, since rows have no points and normals.
void write_wrong_pairs(const kinds::CheckRequest& request, const std::vector<WrongPair>& pairs);

}  // namespace touchstone::check
