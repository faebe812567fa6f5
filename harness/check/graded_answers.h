// The graded answers of a check about pairs, as its grades.csv has them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "algorithms/core/outcome.h"

namespace touchstone::check {

// An answer is wrong if it is on the other side of contact, or a number is off, by more than this part of the pair's
// scale, against the case: far beyond what any library's scalar explains.
inline constexpr double wrong_share = 1e-4;

enum class AnswerState : std::uint8_t {
  right,
  wrong,
  gave_up,  // its status says so, or there is no answer
  failed,   // crashed, gave no answer in time, or cannot be read
};

struct CheckedAnswer {
  std::string algorithm;
  std::string library, version;  // of an algorithm NAME@VERSION; what is built in has no version
  Precision scalar{};
  std::string group, regime;
  std::int64_t index = 0;  // of the case in its regime
  std::string kind_a, kind_b, task;
  std::string exact;                        // the exact answer
  double exact_lower = 0, exact_upper = 0;  // enclose the exact signed distance, metres
  std::string answer;                       // or how it failed
  double error = 0;                         // the greatest of its errors, a part of the scale
  AnswerState state{};

  std::string case_name() const { return regime + "/" + std::to_string(index); }
};

// Returns library and version of a name such as "spheres@1.0"; what follows the version stays with the library.
std::pair<std::string, std::string> library_and_version(std::string_view algorithm);

// Calls `each` with every row of the file, and its line. Throws base::InputError for a file that cannot be read.
void for_each_answer(const std::filesystem::path& grades, double max_error,
                     const std::function<void(CheckedAnswer, std::int64_t line)>& each);

// How an answer changed: `wrong` or `right`, if it became so; `lost`, if it was right and is given up; else `other`.
std::string_view became(AnswerState before, AnswerState after);

}  // namespace touchstone::check
