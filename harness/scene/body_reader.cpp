// Reads rotations and translations, and the shapes and bodies that a scene file lists.
#include "harness/scene/body_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/base/reproducible_math.h"

namespace touchstone::scene {
namespace {

// Reads a row-major matrix. It is used as given if it is a rotation to a thousandth.
Mat3d read_matrix(files::TomlTable& table) {
  const std::vector<double> m = table.numbers("rotation", 9, files::any_number);
  Mat3d rotation;
  rotation << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8];
  if (!base::is_rotation(rotation)) {
    table.fail("rotation", fmt::format("the columns are not orthonormal or not right-handed (off "
                                       "by {:.3g}); expected a rotation matrix, row by row",
                                       orthonormal_error(rotation)));
  }
  return rotation;
}

Mat3d read_rotation(files::TomlTable& table) {
  if (table.has("rotation")) {
    if (table.contains("quaternion_wxyz")) {
      table.fail("quaternion_wxyz", "given beside rotation; expected one of the two");
    }
    return read_matrix(table);
  }
  if (!table.has("quaternion_wxyz")) return Mat3d::Identity();
  const std::vector<double> q = table.numbers("quaternion_wxyz", 4, files::any_number);
  const std::optional<Mat3d> rotation = base::rotation_of_any({q[0], q[1], q[2], q[3]});
  if (!rotation) {
    table.fail("quaternion_wxyz", "found [0, 0, 0, 0]; expected a quaternion that is not zero");
  }
  return *rotation;
}

}  // namespace

Pose read_pose(files::TomlTable& table) {
  Pose pose;
  pose.rotation = read_rotation(table);
  pose.translation = table.vector("translation", files::any_number, Vec3d::Zero());
  return pose;
}

namespace {

// Reads a scene file's lists of shapes and bodies.
class BodyReader {
 public:
  BodyReader(files::TomlTable& table, ShapeReader& shapes, Scene& scene)
      : table_(table), shapes_(shapes), scene_(scene) {}

  // Returns the line of each body.
  std::vector<std::int64_t> read() {
    // Beside a generator it may be the list of that.
    const bool are_generated = table_.contains("generator") && table_.contains("shapes") &&
                               table_.node("shapes")->is_array();
    if (!are_generated && table_.has("shapes")) {
      files::TomlTable named = table_.inside("shapes", "shapes");
      for (const std::string& name : named.keys()) {
        files::TomlTable shape = named.inside(name, "shapes." + name);
        named_.emplace(name, add(shape));
      }
    }
    std::vector<std::int64_t> lines(scene_.bodies.size(), 0);
    for (files::TomlTable& body : table_.tables("body")) {
      read_body(body);
      lines.resize(scene_.bodies.size(), body.line());
    }
    return lines;
  }

 private:
  struct Placed {
    std::uint32_t shape = 0;
    Mat3d turn = Mat3d::Identity();
  };

  Placed add(files::TomlTable& table) {
    const TurnedShape turned = shapes_.read(table);
    table.finish();
    return {scene_.add_shape(turned.shape, turned.mesh, turned.body), turned.turn};
  }

  // The key "shape" is a name or a table; "mesh" and "scale" are keys of the body itself.
  Placed shape_of(files::TomlTable& body) {
    const toml::node* node = body.node("shape");
    if (node == nullptr && body.contains("mesh")) return mesh_of(body);
    if (node == nullptr) body.fail("shape", "missing; expected a table, a name or a mesh");
    if (body.contains("mesh")) body.fail("mesh", "given beside shape; expected one of the two");
    if (!node->is_string()) {
      files::TomlTable shape = body.inside("shape", body.where() + ": shape");
      return add(shape);
    }
    const std::string name = body.text("shape");
    const auto found = named_.find(name);
    if (found != named_.end()) return found->second;
    std::string names;
    for (const auto& [known, placed] : named_) names += (names.empty() ? "" : ", ") + known;
    body.fail("shape", fmt::format("found \"{}\"; expected one of the names in [shapes]: {}", name,
                                   names.empty() ? "there are none" : names));
  }

  // Bodies with the same mesh, scale and use share their shape.
  Placed mesh_of(files::TomlTable& body) {
    const TurnedShape turned = shapes_.read(body);
    return {index_of({turned.shape, turned.mesh, turned.body}), Mat3d::Identity()};
  }

  std::uint32_t index_of(const ConcaveShape& shape) {
    const auto same = std::find_if(
        scene_.shapes.begin(), scene_.shapes.end(),
        [&](const Shape& other) { return other.hull != nullptr && other.hull == shape.hull.hull; });
    if (same == scene_.shapes.end()) return scene_.add_shape(shape.hull, shape.mesh, shape.body);
    return static_cast<std::uint32_t>(same - scene_.shapes.begin());
  }

  void read_body(files::TomlTable& table) {
    // A compound of the mesh's parts is one body, whatever a file that is imported wants.
    const bool parts = table.contains("mesh") && table.boolean("parts", false) &&
                       shapes_.use_of(table) != MeshUse::compound;
    const Placed placed = parts ? Placed{} : shape_of(table);
    const bool halfspace = !parts && scene_.shapes[placed.shape].kind == ShapeKind::halfspace;
    Body body;
    body.shape = placed.shape;
    body.pose = read_pose(table);
    body.pose.rotation = base::product(body.pose.rotation, placed.turn);
    body.velocity = table.vector("velocity", files::any_number, Vec3d::Zero());
    body.angular_velocity = table.vector("angular_velocity", files::any_number, Vec3d::Zero());
    body.moving = table.boolean("moving", !halfspace);
    const std::string name = table.text("name", "");
    const std::size_t before = scene_.bodies.size();
    if (parts) {
      add_parts(table, body);
    } else {
      scene_.bodies.push_back(body);
    }
    if (!name.empty() || !scene_.names.empty()) {
      scene_.names.resize(before);
      scene_.names.resize(scene_.bodies.size(), name);
    }
    table.finish();
  }

  // Adds a body for each part of the mesh, at its place in the whole.
  void add_parts(files::TomlTable& table, const Body& whole) {
    if (whole.angular_velocity != Vec3d::Zero()) {
      table.fail("angular_velocity",
                 "given with parts, which do not turn about a common origin; "
                 "expected parts = false or no angular_velocity");
    }
    for (const MeshPart& part : shapes_.read_parts(table)) {
      Body body = whole;
      body.shape = index_of(part.shape);
      for (int k = 0; k < 3; ++k) {
        body.pose.translation[k] += whole.pose.rotation(k, 0) * part.centre.x() +
                                    whole.pose.rotation(k, 1) * part.centre.y() +
                                    whole.pose.rotation(k, 2) * part.centre.z();
      }
      scene_.bodies.push_back(body);
    }
  }

  files::TomlTable& table_;
  ShapeReader& shapes_;
  Scene& scene_;
  std::map<std::string, Placed> named_;
};

}  // namespace

std::vector<std::int64_t> read_bodies(files::TomlTable& table, ShapeReader& shapes, Scene& scene) {
  return BodyReader(table, shapes, scene).read();
}

}  // namespace touchstone::scene
