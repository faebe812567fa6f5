// What the files about meshes and compounds share.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/concave_phase.h"
#include "algorithms/core/shape.h"
#include "harness/base/random.h"
#include "harness/files/concave_cases.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/batch.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/timed_set.h"

namespace touchstone::kinds {

// Parts of the families of pairs of bodies that need not be convex.

ConcaveBody triangle_body(const std::array<Vec3d, 3>& corners);

// Adds the families that are values of axes.
void add_mesh_axes(std::vector<DrawnFamily<files::ConcaveCase>>& list);

// The families of pairs of bodies that need not be convex.

std::span<const DrawnFamily<files::ConcaveCase>> mesh_families();

// What cells with meshes share: convex bodies by name, and concave phases that are ready to bind.

inline constexpr std::array<std::string_view, 4> convex_names = {"sphere", "capsule", "box",
                                                                 "hull-32"};

// The shape with this greatest half extent (metres). Its numbers are floats, so that peers see the same body.
Shape convex_shape(std::string_view name, double size, base::Random& random);

// With the mid-phase `wide-bvh` and the narrow phase `certified`, if it takes any.
std::unique_ptr<ConcavePhase> make_phase(const ConcaveEntry& entry, Precision scalar, bool welds);

// Timed sets of pairs of bodies that need not be convex.

std::vector<PlannedSet> mesh_sets(files::TomlTable& table, const std::filesystem::path& home);

// Timed sets of convex bodies that slide on a mesh.

std::vector<PlannedSet> sliding_sets(files::TomlTable& table);

// Certificates of pairs of bodies, convex or not.

// What proves the exact answer of each case.
Proving parts_proving(ConcaveTask task, std::vector<files::ConcaveCase> cases);

// Pairs of bodies that need not be convex, one JSON object a line.

std::vector<QueryOption> mesh_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_mesh_questions(const QuestionInput& input);
// Prints what is refused and why; with the file of questions, if any, also what is of none of them.
bool verify_mesh_proofs(const std::string& proofs, const std::filesystem::path& file);

}  // namespace touchstone::kinds
