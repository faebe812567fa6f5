// Reads cases of pairs, and tells who is asked.
#include "harness/kinds/pair/pair_cases.h"

#include <fmt/format.h>

#include <algorithm>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/geometry/shapes/compound.h"

namespace touchstone::kinds {
namespace {

std::vector<files::ConcaveCase> chosen_cases(const QuestionInput& input, files::MeshFiles& meshes) {
  std::vector<files::ConcaveCase> cases = files::read_concave_cases(input.file, &meshes);
  if (!input.has("--id")) return cases;
  const std::string id = input.text("--id");
  std::erase_if(cases, [&](const files::ConcaveCase& c) { return c.id != id; });
  if (cases.empty()) {
    throw base::InputError(fmt::format("{}: has no case '{}'; expected the id of one for --id",
                                       input.file.string(), id));
  }
  return cases;
}

}  // namespace

std::vector<files::ConcaveCase> asked_pair_cases(const QuestionInput& input) {
  files::MeshFiles meshes;
  std::vector<files::ConcaveCase> cases = chosen_cases(input, meshes);
  for (const auto& [file, body] : meshes.all()) {
    tell_extent(file, body->mesh ? body->mesh->vertices : geometry::surface_of(*body).vertices);
  }
  return cases;
}

bool asks_concave_phases(const QuestionInput& input) {
  const bool is_theirs = std::ranges::any_of(input.names, [](const std::string& name) {
    return registry::find<ConcaveEntry>(name) != nullptr &&
           registry::find<NarrowPhaseEntry>(name) == nullptr;
  });
  if (is_theirs || input.task == "contacts") return true;
  files::MeshFiles meshes;
  return !std::ranges::all_of(chosen_cases(input, meshes), &files::ConcaveCase::is_convex);
}

}  // namespace touchstone::kinds
