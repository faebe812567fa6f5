// Reads grades.csv, and says of each answer whether it is right.
#include "harness/check/graded_answers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/files/csv.h"

namespace touchstone::check {
namespace {

// The columns that are read, in the order of their names below.
enum Column : std::size_t {
  c_algorithm,
  c_scalar,
  c_group,
  c_regime,
  c_index,
  c_kind_a,
  c_kind_b,
  c_task,
  c_exact,
  c_exact_lower,
  c_exact_upper,
  c_answer,
  c_status,
  c_verdict,
  c_scale,
  c_margin,
  c_distance_error,
  c_depth_error
};

double number_or_none(std::string_view text) {
  return text.empty() ? Outcome::none : std::strtod(std::string(text).c_str(), nullptr);
}

bool is_off(AnswerState state) {
  return state == AnswerState::wrong || state == AnswerState::failed;
}

}  // namespace

std::pair<std::string, std::string> library_and_version(std::string_view algorithm) {
  const std::size_t at = algorithm.find('@');
  if (at == std::string_view::npos) return {std::string(algorithm), ""};
  const std::size_t end = std::min(algorithm.find(' ', at), algorithm.size());
  return {std::string(algorithm.substr(0, at)) + std::string(algorithm.substr(end)),
          std::string(algorithm.substr(at + 1, end - at - 1))};
}

void for_each_answer(const std::filesystem::path& grades, double max_error,
                     const std::function<void(CheckedAnswer, std::int64_t line)>& each) {
  const std::vector<std::string> columns = {"algorithm",
                                            "scalar",
                                            "group",
                                            "regime",
                                            "index",
                                            "kind_a",
                                            "kind_b",
                                            "task",
                                            "exact",
                                            "exact_lower",
                                            "exact_upper",
                                            "answer",
                                            "status",
                                            "end_verdict",
                                            "scale",
                                            "end_margin",
                                            "end_distance_error",
                                            "end_depth_error"};
  files::CsvReader(grades, columns).read([&](const files::CsvReader::Row& row) {
    CheckedAnswer one;
    one.algorithm = row.text(c_algorithm);
    std::tie(one.library, one.version) = library_and_version(one.algorithm);
    one.scalar = row.text(c_scalar) == "float" ? Precision::float32 : Precision::float64;
    one.group = row.text(c_group);
    one.regime = row.text(c_regime);
    one.index = row.integer(c_index);
    one.kind_a = row.text(c_kind_a);
    one.kind_b = row.text(c_kind_b);
    one.task = row.text(c_task);
    one.exact = row.text(c_exact);
    one.exact_lower = number_or_none(row.text(c_exact_lower));
    one.exact_upper = number_or_none(row.text(c_exact_upper));
    for (const Column column : {c_margin, c_distance_error, c_depth_error}) {
      const double error = std::abs(number_or_none(row.text(column))) / row.number(c_scale);
      if (error > one.error) one.error = error;
    }
    const std::string_view verdict = row.text(c_verdict);
    const bool has_failed = verdict == "crashed" || verdict == "timed_out";
    one.answer = row.text(has_failed ? c_status : c_answer);
    one.state = has_failed                    ? AnswerState::failed
                : verdict == "honest_failure" ? AnswerState::gave_up
                : one.error > max_error       ? AnswerState::wrong
                                              : AnswerState::right;
    each(std::move(one), row.line());
  });
}

std::string_view became(AnswerState before, AnswerState after) {
  if (is_off(after) && !is_off(before)) return "wrong";
  if (after == AnswerState::right && before != AnswerState::right) return "right";
  if (after == AnswerState::gave_up && before == AnswerState::right) return "lost";
  return "other";
}

}  // namespace touchstone::check
