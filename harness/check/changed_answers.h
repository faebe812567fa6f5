// Two checks of the same cases, such as of a library before and after a change: which answers changed.
//
// A library is called by its name without its version, so that two versions can be compared. Answers about pairs are
// compared one by one. Of other kinds a check keeps counts alone, and so the counts of right answers are compared.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/check/versions.h"

namespace touchstone::check {

// What changed of one library in one scalar.
struct AnswerCount {
  std::string library;
  Precision scalar{};
  std::string version_a, version_b;  // empty for what is built in
  std::int64_t compared = 0;         // answers in both
  std::int64_t wrong = 0, lost = 0;  // these became so (graded_answers.h), and had not been
  std::int64_t right = 0, other = 0;
};

struct AnswerComparison {
  std::vector<AnswerCount> counts;     // in the order of the names
  std::vector<VersionChange> changes;  // of pairs, one an answer; of other kinds, one a family
  std::vector<std::string> remarks;    // what only B has, a line each

  bool has_regressed() const;  // an answer became wrong or was lost
};

// Returns whether the folder has files of a check of cases.
bool is_of_check(const std::filesystem::path& folder);

// Compares two folders of a check. An answer is wrong beyond `max_error`, a part of the pair's scale. Throws
// base::InputError, with file and line where there is one, for a folder without the files of a check, for other cases in
// B than in A, for several versions of a library in one folder, for a library that B lacks, and for malformed files.
AnswerComparison compare_answers(const std::filesystem::path& a, const std::filesystem::path& b,
                                 double max_error);

}  // namespace touchstone::check
