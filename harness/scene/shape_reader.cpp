// Reads shapes and meshes of scene files, each mesh once.
#include "harness/scene/shape_reader.h"

#include <algorithm>
#include <array>

#include "algorithms/core/nearest_float.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/geometry/mesh.h"
#include "harness/geometry/mesh_solid.h"
#include "harness/scene/body_reader.h"
#include "harness/scene/concave_shape.h"

namespace touchstone::scene {
namespace {

// The rotation that takes the body's z axis to axis 0 (x), 1 (y) or 2 (z): a cyclic permutation.
Mat3d axis_turn(std::size_t axis) {
  Mat3d turn = Mat3d::Zero();
  for (std::size_t column = 0; column < 3; ++column) {
    turn(static_cast<int>((column + axis + 1) % 3), static_cast<int>(column)) = 1;
  }
  return turn;
}

Vec3d read_scale(files::TomlTable& table) {
  const toml::node* node = table.node("scale");
  return node != nullptr && node->is_array()
             ? table.vector("scale", files::positive)
             : Vec3d::Constant(table.number("scale", files::positive, 1.0));
}

geometry::Mesh read_scaled(const std::string& file, const Vec3d& scale) {
  geometry::Mesh mesh = geometry::read_mesh(file);
  for (Vec3d& v : mesh.vertices) {
    v = v.cwiseProduct(scale).eval();
    if (!v.allFinite()) {
      throw base::InputError(file, 0, "not finite at the scene's scale; expected a smaller one");
    }
  }
  return mesh;
}

void expect_closed(files::TomlTable& table, std::string_view key, const geometry::Mesh& mesh,
                   MeshUse use) {
  if (use != MeshUse::solid) return;
  const auto edge = geometry::open_edge(mesh.vertices, mesh.triangles);
  if (!edge) return;
  const auto& [from, to] = *edge;
  table.fail(key, fmt::format("a solid, and the surface is open at the edge from [{}, {}, {}] to "
                              "[{}, {}, {}]; expected a closed one, or as = \"surface\"",
                              from[0], from[1], from[2], to[0], to[1], to[2]));
}

TurnedShape turned(const ConcaveShape& shape) {
  return {shape.hull, Mat3d::Identity(), shape.mesh, shape.body};
}

void add_shape(const TurnedShape& shape, const Pose& pose, std::vector<Pose>& around,
               ConcaveBody& compound) {
  if (shape.body == nullptr) {
    const Pose placed = {base::product(pose.rotation, shape.turn), pose.translation};
    geometry::place_within(around, compound.parts.emplace_back(ConvexPart{shape.shape, placed}));
  } else if (shape.body->mesh != nullptr) {
    geometry::add_surface(shape.body->mesh, pose, around, compound);
  } else {
    around.push_back(pose);
    for (const ConvexPart& part : shape.body->parts) {
      geometry::place_within(around, compound.parts.emplace_back(part));
    }
    around.pop_back();
  }
}

}  // namespace

std::span<const std::string_view> shape_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const ShapeKind kind : all_shape_kinds) all.push_back(to_string(kind));
    return all;
  }();
  return names;
}

std::filesystem::path ShapeReader::existing_file(files::TomlTable& table, std::string_view key,
                                                 std::string_view expected) const {
  return existing_file(table, key, table.text(key), expected);
}

std::filesystem::path ShapeReader::existing_file(files::TomlTable& table, std::string_view key,
                                                 const std::string& name,
                                                 std::string_view expected) const {
  const std::filesystem::path file = folder_ / name;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    table.fail(key, "no file " + file.string() + "; expected " + std::string(expected) +
                        (get_.empty() ? "" : ". To get it: " + get_));
  }
  return file;
}

bool is_concave_name(std::string_view type) {
  return type == "compound" || std::ranges::find(made_names, type) != made_names.end();
}

MeshUses read_mesh_uses(files::TomlTable& table, std::optional<MeshUse> instead) {
  MeshUses uses{{}, instead};
  if (table.has("meshes"))
    uses.own = static_cast<MeshUse>(table.choice("meshes", geometry::mesh_use_names));
  return uses;
}

MeshUse ShapeReader::use_of(files::TomlTable& table, MeshUse fallback) const {
  const auto usual = static_cast<std::size_t>(uses_.own.value_or(fallback));
  const auto own = static_cast<MeshUse>(table.choice("as", geometry::mesh_use_names, usual));
  return uses_.instead.value_or(own);
}

ShapeReader::MeshKey ShapeReader::mesh_key(files::TomlTable& table) const {
  const Vec3d scale = read_scale(table);
  const std::filesystem::path file =
      existing_file(table, "mesh", "a mesh (.obj, .off, .stl, .ply) or a model");
  return {file.lexically_normal().string(), scale.x(), scale.y(), scale.z(), use_of(table)};
}

TurnedShape ShapeReader::read_mesh(files::TomlTable& table) {
  const MeshKey key = mesh_key(table);
  ConcaveShape& known = meshes_[key];
  if (known.mesh == nullptr) {
    const auto& [file, x, y, z, use] = key;
    geometry::Mesh mesh = read_scaled(file, {x, y, z});
    if (use != MeshUse::hull && mesh.triangles.empty()) {
      table.fail("mesh", "the mesh has no triangles; expected some, or as = \"hull\"");
    }
    expect_closed(table, "mesh", mesh, use);
    known = mesh_shape(std::move(mesh), use);
  }
  return turned(known);
}

// The vertices are rounded to floats at their scale, so that all libraries get the same body.
TurnedShape ShapeReader::read_made(files::TomlTable& table, std::string_view type) {
  geometry::Mesh mesh = made_mesh(table, type, [&](std::string_view key, std::string_view what) {
    return height_files_.emplace_back(existing_file(table, key, what));
  });
  const Vec3d scale = read_scale(table);
  for (Vec3d& v : mesh.vertices) {
    v = nearest_float(Vec3d(v.cwiseProduct(scale)));
    if (!v.allFinite()) table.fail("scale", "the mesh is not finite; expected a smaller scale");
  }
  const bool closed = type != "terrain" && type != "height_field";
  const MeshUse use = use_of(table, closed ? MeshUse::solid : MeshUse::surface);
  expect_closed(table, "type", mesh, use);
  return turned(mesh_shape(std::move(mesh), use));
}

void ShapeReader::add_parts(files::TomlTable& table, std::vector<Pose>& around,
                            ConcaveBody& compound) {
  for (files::TomlTable& part : table.tables("parts")) {
    files::TomlTable shape = part.inside("shape", part.where() + ": shape");
    const Pose pose = read_pose(part);
    if (shape.contains("type") && shape.text("type") == "compound") {
      around.push_back(pose);
      add_parts(shape, around, compound);
      around.pop_back();
    } else {
      add_shape(read(shape), pose, around, compound);
    }
    shape.finish();
    part.finish();
  }
}

TurnedShape ShapeReader::read_compound(files::TomlTable& table) {
  std::vector<Pose> around;
  ConcaveBody body;
  add_parts(table, around, body);
  const bool endless = std::ranges::any_of(
      body.parts, [](const ConvexPart& part) { return part.shape.kind == ShapeKind::halfspace; });
  if (body.parts.empty() || endless) {
    table.fail("parts", body.parts.empty() ? "no parts; expected at least one"
                                           : "a half-space in a compound; expected bounded parts");
  }
  return turned(compound_shape(std::move(body)));
}

const std::vector<MeshPart>& ShapeReader::read_parts(files::TomlTable& table) {
  const MeshKey key = mesh_key(table);
  const auto [found, is_new] = parts_.try_emplace(key);
  if (!is_new) return found->second;
  const auto& [file, x, y, z, use] = key;
  for (geometry::Mesh& part : geometry::connected_parts(read_scaled(file, {x, y, z}))) {
    Vec3d low = part.vertices.front(), high = low;
    for (const Vec3d& v : part.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    const Vec3d centre = 0.5 * low + 0.5 * high;
    for (Vec3d& v : part.vertices) v -= centre;
    expect_closed(table, "mesh", part, use);
    found->second.push_back({mesh_shape(std::move(part), use), centre});
  }
  if (found->second.empty()) {
    table.fail("parts", "the mesh has no triangles, so no parts; expected parts = false");
  }
  return found->second;
}

std::vector<std::filesystem::path> ShapeReader::files() const {
  std::vector<std::filesystem::path> files = height_files_;
  for (const auto& [key, shape] : meshes_) files.emplace_back(std::get<0>(key));
  for (const auto& [key, parts] : parts_) files.emplace_back(std::get<0>(key));
  return files;
}

TurnedShape ShapeReader::read(files::TomlTable& table) {
  if (table.has("mesh")) return read_mesh(table);
  std::vector<std::string_view> names(shape_names().begin(), shape_names().end());
  names.insert(names.end(), made_names.begin(), made_names.end());
  names.push_back("compound");
  const std::size_t type = table.choice("type", names);
  if (names[type] == "compound") return read_compound(table);
  if (type >= shape_names().size()) return read_made(table, names[type]);
  TurnedShape turned;
  Shape& shape = turned.shape;
  shape.kind = all_shape_kinds[type];
  switch (shape.kind) {
    case ShapeKind::sphere: shape.radius = table.number("radius", files::not_negative); break;
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: {
      constexpr std::string_view axes[] = {"x", "y", "z"};
      shape.radius = table.number("radius", files::not_negative);
      shape.half_length = table.number("half_length", files::not_negative);
      turned.turn = axis_turn(table.choice("axis", axes, 2));
      break;
    }
    case ShapeKind::box:
      shape.half_extents = table.vector("half_extents", files::not_negative);
      break;
    case ShapeKind::ellipsoid: shape.radii = table.vector("radii", files::not_negative); break;
    case ShapeKind::hull: shape.hull = make_hull(table.points("vertices")); break;
    case ShapeKind::halfspace:
      shape.normal = table.vector("normal", files::any_number);
      shape.offset = table.number("offset", files::any_number);
      if (shape.normal == Vec3d::Zero()) {
        table.fail("normal", "found [0, 0, 0]; expected a vector that is not zero");
      }
      break;
  }
  return turned;
}

}  // namespace touchstone::scene
