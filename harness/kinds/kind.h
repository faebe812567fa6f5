// A kind of query, such as rays at meshes: what is asked, who answers, what is right.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/registry.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/batch.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

class Checker;
class Questions;
struct CheckRequest;
struct QuestionInput;
struct QueryOption;

class Kind {
 public:
  struct Words {
    KindWords registry;  // "point": in options, columns, campaigns, folders
    // What an option or a key was called before; empty: the first other word of the registry.
    std::string_view old_name = {};
    std::string_view title;     // "Points": a heading
    std::string_view contract;  // "point query": what messages call its algorithms
    // What its grades mean: what contact is, and the margins and tolerances, the same for every origin.
    std::string_view legend;
    std::span<const std::string_view> tasks;
    std::uint32_t draw_number;          // with a family's number, it decides the draws of a case
    std::string_view counted = "none";  // the algorithms that are counted if no algorithm is named
  };

  explicit Kind(const Words& words) : words_(words) {}
  virtual ~Kind() = default;
  Kind(const Kind&) = delete;
  Kind& operator=(const Kind&) = delete;

  std::string_view name() const { return words_.registry.word; }
  std::string_view old_name() const {
    return words_.old_name.empty() ? words_.registry.other.front() : words_.old_name;
  }
  std::string_view title() const { return words_.title; }
  std::string_view contract() const { return words_.contract; }
  std::string_view legend() const { return words_.legend; }
  std::span<const std::string_view> tasks() const { return words_.tasks; }
  std::uint32_t draw_number() const { return words_.draw_number; }
  std::string_view counted() const { return words_.counted; }

  // What the registry has of the kind, built or not.
  virtual std::vector<const AlgorithmInfo*> algorithms() const = 0;
  // The algorithms of these names and groups, with each of the scalars and tasks that they offer. The oracle
  // belongs to no group. Throws InputError for an unknown name.
  virtual std::vector<Contestant> contestants(const std::vector<std::string>& names,
                                              std::span<const Precision> scalars) const = 0;
  // All families in a stable order, first those that are no values of axes.
  std::span<const Family> families() const;
  virtual std::unique_ptr<Batch> draw(const Family& family, const BatchRange& range) const = 0;
  // What a check does with the families; null: it asks their batches.
  virtual std::unique_ptr<Checker> checker(const CheckRequest& request) const = 0;

  // What of a user's own file is asked (questions.h): its options beside those of every kind.
  virtual std::vector<QueryOption> query_options() const = 0;
  // Selects algorithms, reads the questions and checks the options. Throws InputError for what is wrong in them.
  virtual std::unique_ptr<Questions> read(const QuestionInput& input) const = 0;
  // Verifies proofs in a file; with the file of questions, if any, also that each is of one of them. Prints what is
  // refused and why. Returns true if none is. Throws InputError where the kind has no proofs.
  virtual bool verify(const std::string& proofs, const std::filesystem::path& file) const = 0;

  // The sets that campaigns time, by the keys of a table; files are relative to `home`. Throws InputError with
  // file, line and what was expected.
  virtual std::vector<PlannedSet> timed_sets(files::TomlTable& table,
                                             const std::filesystem::path& home) const = 0;

 private:
  // Lists the families; kind and number are filled in.
  virtual std::vector<Family> list_families() const = 0;

  Words words_;
  mutable std::vector<Family> families_;  // listed when they are first asked for
};

// All kinds that have batches of cases, in the order of pages and tables.
std::span<const Kind* const> kinds();
// These, and pairs and boxes, which have checkers of their own.
std::span<const Kind* const> checked_kinds();
// These, and those that are asked alone.
std::span<const Kind* const> asked_kinds();

// Returns the kind that has batches with this word of the registry; null if there is none.
const Kind* find_kind(std::string_view name);
// Returns any kind with it.
const Kind* find_asked_kind(std::string_view name);

// The families of all kinds, in the order of checked_kinds(): those that are no values of axes, and those that are.
std::vector<const Family*> case_families();
std::vector<const Family*> axis_families();

// Each kind is a room, which defines its own.
const Kind& mesh_kind();
const Kind& ray_kind();
const Kind& point_kind();
const Kind& cast_kind();
const Kind& feature_kind();
const Kind& scene_ray_kind();
const Kind& configuration_kind();
const Kind& pair_kind();
const Kind& box_kind();
const Kind& manifold_kind();

}  // namespace touchstone::kinds
