// What of a user's own file is asked, of every kind, and how its kind is told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/outcome.h"
#include "harness/files/concave_cases.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {

// An option of `query` that some kinds have.
struct QueryOption {
  enum class Value : std::uint8_t {
    flag,
    text,
    file,  // one that is read
    list,  // words, joined by commas in QuestionInput
    choice,
    positive,      // a number
    not_negative,  // a number
    count,         // an integer above 0
    natural,       // an integer from 0
  };

  std::string_view name;  // such as "--start"
  Value value = Value::text;
  std::string_view help;
  std::vector<std::string_view> choices = {};  // of a choice
  // An option that may not stand beside it; none if empty.
  std::string_view excludes = {};
};

// What the command line asks.
struct QuestionInput {
  std::filesystem::path file;             // of the questions; empty where the kind makes them
  std::vector<std::string> names;         // of algorithms and groups
  std::string task;                       // empty: the kind's fullest
  std::optional<double> time_limit = {};  // seconds
  // Of the kind's options those that were given; the text of a flag is empty.
  std::map<std::string, std::string, std::less<>> options = {};

  bool has(std::string_view option) const { return options.contains(option); }
  std::string text(std::string_view option, std::string without = {}) const;
  std::optional<double> number(std::string_view option) const;
  std::optional<int> count(std::string_view option) const;
  Precision scalar() const;  // of --scalar; double without it
  double seconds(double without = 5) const { return time_limit.value_or(without); }
};

// The place of the task that was asked among the kind's tasks; `fullest` if none was. Throws InputError for a task that
// is none of them.
std::size_t asked_task(const QuestionInput& input, std::span<const std::string_view> tasks,
                       std::size_t fullest = 0);

// The file of --in. Throws InputError if there is none.
std::string needed_target(const QuestionInput& input);

// Why some question has no answer of an algorithm.
struct AskFailure {
  std::string label;   // of the question
  std::string reason;  // such as "no answer in time"
};

// What one algorithm says to one question, as a line shows it.
struct ShownAnswer {
  std::string_view verdict;
  Status status = Status::unsupported;
  double number = Outcome::none;  // the distance, time or length that was asked for
  double lower = Outcome::none, upper = Outcome::none;  // certified bounds on it
  std::string more = {};                                // what else is worth reading
};

// The proofs of exact answers, each a line.
struct Proving {
  std::vector<std::string> head = {};  // lines that the proofs refer to
  std::size_t items = 0;
  std::function<process::MakeLine()> setup;
  std::function<std::string(std::size_t item)> label;
};

// The questions, and the answers of the algorithms that were asked, which are numbered as they were selected. A file
// or folder may be read part by part; then these are those of the part.
class Questions {
 public:
  virtual ~Questions() = default;

  // --- what is asked ---
  virtual std::size_t size() const = 0;  // in the order of the file
  virtual std::string label(std::size_t question) const = 0;
  virtual std::vector<files::NamedFile> inputs() const = 0;
  virtual std::vector<files::NamedFile> outputs() const { return {}; }  // beside the answers
  // Goes on to the next part; false if there is none.
  virtual bool next() { return false; }
  virtual std::string_view unit() const = 0;  // of numbers in lines, such as "m"
  // The pairs of resting bodies that are asked; empty for questions of other kinds.
  virtual std::span<const files::ConcaveCase> pairs() const { return {}; }

  // --- who is asked ---
  virtual std::size_t contestants() const = 0;
  virtual const AlgorithmInfo& info(std::size_t contestant) const = 0;
  // The algorithm's name, and its scalar where it is asked in several.
  virtual std::string name(std::size_t contestant) const { return info(contestant).name; }
  // Those that have no answer because they calculate in the other of float and double alone.
  virtual std::vector<std::string> of_other_scalar() const { return {}; }

  // Asks all questions, in a child process, and keeps the answers.
  virtual std::vector<AskFailure> ask(std::size_t contestant) = 0;

  // --- what is answered ---
  virtual std::vector<std::string> columns() const = 0;
  // Writes the rows of an answer, most often one.
  virtual void write(files::CsvWriter& csv, std::size_t question, std::size_t contestant) const = 0;
  // Writes the files of outputs().
  virtual void write_further() {}
  virtual ShownAnswer shown(std::size_t question, std::size_t contestant) const = 0;
  // The verdicts in the order in which a summary counts them.
  virtual std::vector<std::string_view> verdicts() const = 0;
  // Prints a summary of its own. Returns false if it has none, so that answers and statuses are counted.
  // `are_shown`: every answer was printed in a line.
  virtual bool print_summary(bool /*are_shown*/) const { return false; }
  // True if an answer of ours is known to be wrong. Prints which, where that is no part of the summary.
  virtual bool is_wrong() const { return false; }

  // Throws InputError if there are no proofs of what is asked.
  virtual Proving proving() const;
};

// The mesh of --in.
TriangleMesh read_target_mesh(const QuestionInput& input);

// Returns a number of a row. Throws InputError if it is not finite.
double finite_number(const files::CsvReader::Row& row, std::size_t column);

// Writes a number; an empty field where there is none.
template <class Number>
void write_if(files::CsvWriter& csv, bool is_there, Number number) {
  if (is_there) {
    csv.field(static_cast<std::int64_t>(number));
  } else {
    csv.field("");
  }
}

// What is read from a mesh file, in the file's units, which are taken for metres: prints its size, to standard error,
// so that a body of ten metres that was meant to be one of ten millimetres is seen.
void tell_extent(const std::string& file, std::span<const Vec3d> vertices);

// Options that several kinds have.
namespace option {
extern const QueryOption scalar, tolerance, max_iterations, target, saved;
}

// The kind of the questions in a file, and of the proofs in one, by their keys or columns.

// `word` is the kind's name, which decides, or empty. Pairs are those of convex bodies, of any bodies, or moving ones;
// rays are cast at a mesh, or at a scene where --in names one. Throws InputError where the file does not tell, and
// for a word that names no kind.
const Kind& told_kind(const QuestionInput& input, const std::string& word);

// The same for a file of proofs.
const Kind& told_kind_of_proofs(const std::filesystem::path& proofs, const std::string& word);

// Questions that are answered one by one, each by an algorithm in a child process.

// `Entry` is the registry's, `Answer` is trivially copyable and has a status, which is `unsupported` in a new one.
template <class Entry, class Answer>
class AnswersOf : public Questions {
 public:
  std::size_t contestants() const final { return asked_.size(); }
  const AlgorithmInfo& info(std::size_t contestant) const final {
    return asked_[contestant].entry->info;
  }

 protected:
  struct Asked {
    const Entry* entry;
    Precision scalar = Precision::float64;
    std::vector<Answer> answers = {};  // one for each question
  };

  void select(const std::vector<std::string>& names, std::string_view what, Precision scalar) {
    for (const Entry* entry : kinds::select(registry::entries<Entry>(), names, what)) {
      asked_.push_back({.entry = entry, .scalar = scalar});
    }
  }
  const Answer& answer(std::size_t question, std::size_t contestant) const {
    return asked_[contestant].answers[question];
  }

  // The names of the algorithms that are asked and for which `lacks` holds.
  template <class Lacks>
  std::vector<std::string> names_where(const Lacks& lacks) const {
    std::vector<std::string> names;
    for (const Asked& asked : asked_) {
      if (lacks(*asked.entry)) names.push_back(asked.entry->info.name);
    }
    return names;
  }

  // Asks the questions that `takes`. `setup` returns, in the child process, a function from a question to its answer.
  template <class Takes, class Setup>
  std::vector<AskFailure> ask_each(std::size_t contestant, double seconds, const Takes& takes,
                                   const Setup& setup) {
    Asked& asked = asked_[contestant];
    asked.answers.assign(size(), Answer{});
    std::vector<std::size_t> taken;
    for (std::size_t i = 0; i < size(); ++i) {
      if (takes(i)) taken.push_back(i);
    }
    const auto solved = process::isolated_answers<Answer>(
        taken.size(), {.item_seconds = seconds},
        [&] { return [&taken, solve = setup()](std::size_t item) { return solve(taken[item]); }; });
    for (std::size_t item = 0; item < taken.size(); ++item) {
      asked.answers[taken[item]] = solved.answers[item];
    }
    std::vector<AskFailure> failures;
    for (const process::IsolationFailure& failure : solved.failures) {
      failures.push_back({label(taken[failure.item]), failure.reason()});
    }
    return failures;
  }

  std::vector<Asked> asked_;
};

}  // namespace touchstone::kinds
