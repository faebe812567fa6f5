// What the files about moving features share.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/ccd.h"
#include "algorithms/oracle/oracle.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/batch.h"
#include "harness/kinds/exact_forms.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

// The size of a query of continuous collision, and the lengths that it is asked with.

// Metres. Queries of one call have them in common.
struct Lengths {
  double tolerance = 0, separation = 0;

  bool operator==(const Lengths&) const = default;
};

inline constexpr std::uint64_t queries_of_a_call = 50;

// The size of the features (metres) of the query with this number, and its lengths without a separation.
struct CcdSize {
  double scale, tolerance;
};
CcdSize ccd_size(std::uint64_t index);

// The lengths of the query with this number where a separation counts as contact. Of every sixteenth query it is
// half the tolerance more or less than a least distance to which the features come, so that the verdict is a
// close one.
Lengths separated_lengths(std::uint64_t index, const CcdQuery& query, int first_count,
                          oracle::Oracle& oracle);

// Forms of queries of continuous collision: swapped, scaled, moved, reversed and cut in two.

// The query in that form, which is not `split`; nothing if the form would round a number. The first
// feature has `first_count` vertices; `scale` is the size of the features (metres).
std::optional<CcdQuery> query_in_form(const CcdQuery& query, int first_count, double scale,
                                      const FormNumbers& numbers, CaseForm form);

// The vertices halfway, if they are exact.
std::optional<std::array<Vec3d, 4>> vertices_halfway(const CcdQuery& query);

// The distance of the features at a time (metres), up to the rounding of their places; 0 where they share a point.
double distance_at(const CcdQuery& query, int first_count, double time, oracle::Oracle& oracle);

// 1 if the features are further apart than that at the time (metres), -1 if they are nearer, both by more
// than rounding and what they move in 2^-38 of the time; 0 between.
int side_of_distance(const CcdQuery& query, int first_count, double time, double distance,
                     oracle::Oracle& oracle);

// True if the features are further apart than that at the time, beyond rounding (metres).
bool are_further_apart(const CcdQuery& query, int first_count, double time, double distance,
                       oracle::Oracle& oracle);

// Timed sets of moving features.

std::vector<PlannedSet> feature_sets(files::TomlTable& table, const std::filesystem::path& home);

// Moving vertices, faces and edges of a CSV file, or of a folder of them.

std::vector<QueryOption> feature_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_feature_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
