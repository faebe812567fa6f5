// Meshes that rays are cast at and points are asked about, for the blocks of both.
#pragma once

#include <algorithm>
#include <vector>

#include "harness/check/kinds/blocks/exact_forms.h"
#include "harness/families/meshes.h"

namespace touchstone::check {

// So many consecutive cases have one mesh.
inline constexpr std::uint64_t cases_of_a_mesh = 25;

// The mesh of a group of cases: one of the list, at a scale. Every sixteenth may be a large one.
struct MeshTarget {
  TriangleMesh mesh;
  double scale = 1;  // a power of two

  MeshTarget(const std::vector<families::NamedMesh>& list, std::uint64_t seed,
             std::uint64_t group) {
    constexpr std::size_t large = 400;  // triangles
    base::Random random(seed, ~group);
    std::vector<const families::NamedMesh*> usual, any;
    for (const families::NamedMesh& named : list) {
      any.push_back(&named);
      if (named.mesh.triangles.size() < large) usual.push_back(&named);
    }
    const auto& from = random.below(16) == 0 ? any : usual;
    constexpr std::array scales = {1.0, 1.0, 0x1p-20, 0x1p20};
    scale = scales[random.below(4)];
    mesh = from[random.below(from.size())]->mesh;
    for (Vec3d& vertex : mesh.vertices) vertex *= scale;
  }
};

// The mesh in another form, or nothing if that rounds a vertex.
inline std::optional<TriangleMesh> moved_mesh(TriangleMesh mesh, const FormNumbers& numbers,
                                              const Vec3d& shift) {
  for (Vec3d& vertex : mesh.vertices) {
    const auto sum = exact_sum(numbers.turn(vertex), shift);
    if (!sum) return std::nullopt;
    vertex = *sum;
  }
  return mesh;
}

}  // namespace touchstone::check
