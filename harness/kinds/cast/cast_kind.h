// What the files about moving bodies share.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/cast_outcome.h"
#include "algorithms/oracle/oracle.h"
#include "harness/files/cases.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/batch.h"
#include "harness/kinds/exact_forms.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

// What is right of moving bodies, by the oracle.

// The greatest magnitude of a coordinate of both bodies and their motions, seen from where the first one
// begins (metres).
double span_of_motion(const files::CastCase& c);

// Answers are found when they are first asked for. The cases stay where they are.
class CastTruths {
 public:
  explicit CastTruths(std::span<const files::CastCase> cases);

  // The greatest magnitude of a coordinate of both bodies and their motions (metres).
  double reach(std::size_t i) const { return reaches_[i]; }
  // The greatest length that a point of the bodies moves relative to the other body (metres).
  double path(std::size_t i) const;
  const CastOutcome& of(std::size_t i);
  // Where contact at the start counts only if the bodies approach: unknown where their depth is within
  // rounding of the tolerance, or no exact answer is known.
  CastOutcome of_approach(std::size_t i, double tolerance);
  // True if the bodies are further apart at the time than the tolerance, and rounding of their places.
  bool is_apart(std::size_t i, double time, double tolerance);

 private:
  enum class Depth : std::uint8_t { none, some, unknown };  // more than the tolerance, or not

  oracle::Measure measure_at(std::size_t i, double time);
  Depth depth_on_the_way(std::size_t i, double tolerance);

  std::span<const files::CastCase> cases_;
  std::vector<double> reaches_;
  std::vector<std::optional<CastOutcome>> exact_;
  std::vector<std::optional<oracle::Measure>> least_;  // the depth along the best fixed direction
  oracle::Oracle oracle_;
};

// The families of moving bodies.

std::span<const DrawnFamily<files::CastCase>> cast_families();

// Forms of cases of moving bodies: swapped, scaled, moved, reversed and cut in two.

// One case, or the two halves of one.
using CastParts = std::vector<files::CastCase>;

// Returns the case in that form; nothing if the form would round a number. Bodies that turn are an exception:
// where they are at another time is always rounded.
CastParts parts_in_form(const files::CastCase& c, const FormNumbers& numbers, CaseForm form);

// True if the form rounds where bodies are, so that where rounding decides it has another exact answer.
bool rounds(const files::CastCase& c, CaseForm form);

// Timed sets of moving bodies.

std::vector<PlannedSet> cast_sets(files::TomlTable& table, const std::filesystem::path& home);

// Moving pairs of bodies, one JSON object a line.

std::vector<QueryOption> cast_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_cast_questions(const QuestionInput& input);
// Prints what is refused and why; with the file of questions, if any, also what is of none of them.
bool verify_cast_proofs(const std::string& proofs, const std::filesystem::path& file);

}  // namespace touchstone::kinds
