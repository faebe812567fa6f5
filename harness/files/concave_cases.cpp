// Reads and writes cases with meshes and compounds, and meshes beside them.
#include "harness/files/concave_cases.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/files/case_json.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/geometry/mesh.h"

namespace touchstone::files {
namespace {

using geometry::MeshUse;

Vec3d read_scale(const JsonNode& shape) {
  if (!shape.has("scale")) return Vec3d::Ones();
  const JsonNode node = shape.at("scale", "");
  const Vec3d scale = node.value().is_array() ? node.vector() : Vec3d::Constant(node.number());
  if (!(scale.array() > 0).all()) {
    node.fail(fmt::format("found {}; expected numbers > 0", node.found()));
  }
  return scale;
}

MeshUse read_use(const JsonNode& shape) {
  if (!shape.has("as")) return MeshUse::surface;
  constexpr std::string_view expected = "surface, solid, hull or compound";
  const JsonNode node = shape.at("as", expected);
  const auto at = std::ranges::find(geometry::mesh_use_names, node.text(expected));
  if (at == geometry::mesh_use_names.end()) {
    node.fail(fmt::format("found {}; expected {}", node.found(), expected));
  }
  return static_cast<MeshUse>(at - geometry::mesh_use_names.begin());
}

}  // namespace

bool is_mesh_file(const JsonNode& shape) {
  return shape.value().is_object() && shape.has("mesh") && !shape.has("type");
}

bool names_mesh(const JsonNode& body) {
  if (!body.value().is_object() || !body.has("mesh")) return false;
  if (body.has("shape")) body.fail("\"mesh\" is given beside \"shape\"; expected one of the two");
  return true;
}

const ConcaveBody& MeshFiles::body(const JsonNode& shape) {
  Json said;
  for (const char* key : {"mesh", "scale", "as"}) said[key] = shape.value().value(key, Json());
  const auto [known, is_new] = known_.try_emplace(said.dump(), all_.size());
  if (!is_new) return *all_[known->second].body;
  constexpr std::string_view expected = "a mesh (.obj, .off, .stl, .ply) or a model";
  const JsonNode node = shape.at("mesh", expected);
  const std::filesystem::path file =
      std::filesystem::path(node.file()).parent_path() / node.text(expected);
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    node.fail(fmt::format("no file {}; expected {}", file.string(), expected));
  }
  const Vec3d scale = read_scale(shape);
  const MeshUse use = read_use(shape);
  geometry::Mesh mesh = geometry::read_mesh(file);
  for (Vec3d& v : mesh.vertices) {
    v = v.cwiseProduct(scale).eval();
    if (!v.allFinite()) shape.fail("not finite at this scale; expected a smaller one");
  }
  if (use != MeshUse::hull && mesh.triangles.empty()) {
    node.fail("the mesh has no triangles; expected some, or \"as\":\"hull\"");
  }
  auto body = std::make_shared<const ConcaveBody>(geometry::mesh_body(mesh, use));
  if (use == MeshUse::solid) check_closed(shape, *body->mesh, "\"as\" is \"solid\"");
  all_.push_back({file.string(), std::move(body)});
  return *all_.back().body;
}

namespace {

std::array<std::uint32_t, 3> read_triangle(const JsonNode& node, std::size_t vertices) {
  const std::string expected =
      vertices == 0 ? "no triangle, as there are no vertices"
                    : fmt::format("three numbers of vertices, from 0 to {}", vertices - 1);
  if (!node.value().is_array() || node.size() != 3) {
    node.fail(fmt::format("found {}; expected {}", node.found(), expected));
  }
  std::array<std::uint32_t, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    const JsonNode corner = node[k];
    const bool whole = corner.value().is_number_unsigned();
    const std::uint64_t number = whole ? corner.value().get<std::uint64_t>() : vertices;
    if (number >= vertices) {
      corner.fail(fmt::format("found {}; expected {}", corner.found(), expected));
    }
    corners[k] = static_cast<std::uint32_t>(number);
  }
  return corners;
}

bool has_type(const JsonNode& shape, const char* type) {
  shape.as_object("an object, such as {\"type\":\"sphere\",\"radius\":1}");
  return shape.at("type", "a shape's name").text("a shape's name") == type;
}

constexpr std::size_t most_nested = 1000;

// Adds the body of a file as a part of a compound.
void add_file(const ConcaveBody& read, const Pose& pose, std::vector<Pose>& around,
              ConcaveBody& body) {
  if (read.mesh) return geometry::add_surface(read.mesh, pose, around, body);
  around.push_back(pose);
  for (const ConvexPart& part : read.parts) {
    geometry::place_within(around, body.parts.emplace_back(part));
  }
  around.pop_back();
}

// Adds the parts of a compound that lies within others: `around` has their poses, the outermost
// first.
void add_parts(const JsonNode& compound, std::vector<Pose>& around, MeshFiles* files,
               ConcaveBody& body) {
  const JsonNode list = compound.at("parts", "an array of parts");
  list.as_array("an array of parts, each with a shape and its place");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonNode node = list[i];
    node.as_object("a part: an object with a shape and its place");
    if (files != nullptr && names_mesh(node)) {
      add_file(files->body(node), read_pose(node), around, body);
      continue;
    }
    const JsonNode shape =
        node.at("shape", "an object, such as {\"type\":\"sphere\",\"radius\":1}");
    if (files != nullptr && is_mesh_file(shape)) {
      add_file(files->body(shape), read_pose(node), around, body);
      continue;
    }
    if (has_type(shape, "mesh")) {
      geometry::add_surface(read_mesh(shape), read_pose(node), around, body);
      continue;
    }
    if (has_type(shape, "compound")) {
      if (around.size() == most_nested) {
        compound.fail(fmt::format(
            "compounds are more than {} deep within each other; expected fewer", most_nested));
      }
      around.push_back(read_pose(node));
      add_parts(shape, around, files, body);
      around.pop_back();
      continue;
    }
    ConvexPart& part = body.parts.emplace_back();
    read_body(node, part.shape, part.pose, ", mesh, compound");
    geometry::place_within(around, part);
  }
}

OrderedJson placed_mesh_to_json(const TriangleMesh& mesh, const Pose& pose) {
  OrderedJson out = body_to_json(Shape{}, pose);  // for the pose
  out["shape"] = mesh_to_json(mesh);
  return out;
}

// A part, or the mesh whose first triangle it is, within compounds of its own if their product was rounded.
OrderedJson part_to_json(const ConvexPart& part, const TriangleMesh* mesh) {
  const std::vector<Pose> poses = part.poses ? *part.poses : std::vector<Pose>{part.pose};
  OrderedJson out = mesh != nullptr ? placed_mesh_to_json(*mesh, poses.back())
                                    : body_to_json(part.shape, poses.back());
  for (std::size_t i = poses.size() - 1; i > 0; --i) {
    OrderedJson around = body_to_json(Shape{}, poses[i - 1]);  // for the pose
    around["shape"] = OrderedJson();
    around["shape"]["type"] = "compound";
    around["shape"]["parts"] = OrderedJson::array();
    around["shape"]["parts"].push_back(std::move(out));
    out = std::move(around);
  }
  return out;
}

}  // namespace

void check_closed(const JsonNode& node, const TriangleMesh& mesh, std::string_view said) {
  const auto edge = geometry::open_edge(mesh.vertices, mesh.triangles);
  if (!edge) return;
  const auto& [from, to] = *edge;
  node.fail(
      fmt::format("{}, and the surface is open at the edge from [{},{},{}] to [{},{},{}]; "
                  "expected each edge as often in one direction as in the other",
                  said, from[0], from[1], from[2], to[0], to[1], to[2]));
}

std::shared_ptr<const TriangleMesh> read_mesh(const JsonNode& node) {
  TriangleMesh mesh;
  const JsonNode vertices = node.at("vertices", "an array of vertices [x,y,z]");
  vertices.as_array("an array of vertices [x,y,z]");
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.vertices.push_back(vertices[i].vector());
  const JsonNode triangles = node.at("triangles", "an array of triangles [i,j,k]");
  triangles.as_array("an array of triangles [i,j,k]");
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    mesh.triangles.push_back(read_triangle(triangles[i], mesh.vertices.size()));
  }
  if (node.has("solid")) {
    const JsonNode solid = node.at("solid", "");
    if (!solid.value().is_boolean()) {
      solid.fail(fmt::format("found {}; expected true or false", solid.found()));
    }
    mesh.solid = solid.value().get<bool>();
  }
  if (mesh.solid) check_closed(node, mesh, "\"solid\" is true");
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

OrderedJson mesh_to_json(const TriangleMesh& mesh) {
  OrderedJson shape;
  shape["type"] = "mesh";
  shape["vertices"] = OrderedJson::array();
  for (const Vec3d& v : mesh.vertices) {
    shape["vertices"].push_back(std::array{v.x(), v.y(), v.z()});
  }
  shape["triangles"] = OrderedJson::array();
  for (const auto& triangle : mesh.triangles) shape["triangles"].push_back(triangle);
  shape["solid"] = mesh.solid;
  return shape;
}

ConcaveBody read_concave_body(const JsonNode& body, Pose& pose, MeshFiles* files) {
  body.as_object("an object with a shape and its pose");
  if (files != nullptr && names_mesh(body)) {
    pose = read_pose(body);
    return files->body(body);
  }
  const JsonNode node = body.at("shape", "an object, such as {\"type\":\"sphere\",\"radius\":1}");
  ConcaveBody read;
  if (files != nullptr && is_mesh_file(node)) {
    read = files->body(node);
    pose = read_pose(body);
  } else if (has_type(node, "mesh")) {
    read.mesh = read_mesh(node);
    pose = read_pose(body);
  } else if (has_type(node, "compound")) {
    std::vector<Pose> around;
    add_parts(node, around, files, read);
    pose = read_pose(body);
  } else {
    read_body(body, read.parts.emplace_back().shape, pose, ", mesh, compound");
  }
  return read;
}

OrderedJson concave_body_to_json(const ConcaveBody& body, const Pose& pose) {
  const bool is_shape = !body.mesh && body.parts.size() == 1 && body.surfaces.empty() &&
                        !body.parts[0].poses && body.parts[0].pose.rotation.isIdentity(0) &&
                        body.parts[0].pose.translation.isZero(0);
  if (is_shape) return body_to_json(body.parts[0].shape, pose);
  if (body.mesh) return placed_mesh_to_json(*body.mesh, pose);
  OrderedJson out = body_to_json(Shape{}, pose);  // for the pose
  OrderedJson& shape = out["shape"];
  shape = OrderedJson();
  shape["type"] = "compound";
  shape["parts"] = OrderedJson::array();
  auto surface = body.surfaces.begin();
  for (std::size_t i = 0; i < body.parts.size();) {
    const ConvexPart& part = body.parts[i];
    if (surface != body.surfaces.end() && surface->first == i) {
      shape["parts"].push_back(part_to_json(part, surface->mesh.get()));
      i += surface++->mesh->triangles.size();
    } else {
      shape["parts"].push_back(part_to_json(part, nullptr));
      ++i;
    }
  }
  return out;
}

namespace {

bool names_convex(const JsonNode& body, const ConcaveBody& read) {
  if (names_mesh(body)) return !read.mesh && read.parts.size() == 1;
  const JsonNode shape = body.at("shape", "");
  if (is_mesh_file(shape)) return !read.mesh && read.parts.size() == 1;
  const std::string& type = shape.at("type", "a shape's name").text("a shape's name");
  return type != "mesh" && type != "compound";
}

}  // namespace

ConcaveCase read_concave_case(const JsonNode& line, MeshFiles* files) {
  line.as_object("a case: an object with \"a\" and \"b\"");
  ConcaveCase c;
  c.line = line.line();
  c.id = read_id(line);
  const JsonNode a = line.at("a", "the first body"), b = line.at("b", "the second body");
  c.a = read_concave_body(a, c.pose_a, files);
  c.b = read_concave_body(b, c.pose_b, files);
  c.is_convex = names_convex(a, c.a) && names_convex(b, c.b);
  return c;
}

std::vector<ConcaveCase> read_concave_cases(const std::filesystem::path& file, MeshFiles* meshes) {
  std::vector<ConcaveCase> cases;
  MeshFiles own;
  MeshFiles* const files = meshes != nullptr ? meshes : &own;
  KeyWarnings warnings;
  for_each_case(file, [&](const JsonNode& line) {
    cases.push_back(read_concave_case(line, files));
    warnings.look(line);
  });
  return cases;
}

std::string to_json(const ConcaveCase& c) {
  OrderedJson out;
  out["id"] = c.id;
  out["a"] = concave_body_to_json(c.a, c.pose_a);
  out["b"] = concave_body_to_json(c.b, c.pose_b);
  return out.dump();
}

Case convex_case(const ConcaveCase& c) {
  return {c.id, c.a.parts[0].shape, c.b.parts[0].shape, c.pose_a, c.pose_b};
}

}  // namespace touchstone::files
