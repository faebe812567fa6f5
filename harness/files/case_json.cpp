// Shapes, poses and cases to and from JSON. Keys are compared by the number of letters to insert,
// delete, replace or exchange with the next.
#include "harness/files/case_json.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/input_file.h"
#include "harness/base/nearest_name.h"
#include "harness/base/warning.h"

namespace touchstone::files {
namespace {

constexpr std::string_view axis_names[] = {"x", "y", "z"};

std::shared_ptr<const Hull> read_hull(const JsonNode& vertices) {
  if (!vertices.value().is_array() || vertices.size() == 0) {
    vertices.fail(fmt::format("found {}; expected an array of at least one vertex [x,y,z]",
                              vertices.found()));
  }
  std::vector<Vec3d> points;
  points.reserve(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) points.push_back(vertices[i].vector());
  return make_hull(std::move(points));
}

// The greatest component is scaled to 1 first, so that no square overflows or underflows.
Mat3d read_quaternion(const JsonNode& node) {
  const std::array<double, 4> wxyz = node.numbers<4>();
  double greatest = 0;
  for (const double part : wxyz) greatest = std::max(greatest, std::abs(part));
  if (greatest == 0) node.fail("the zero quaternion; expected one that can be normalised");
  Eigen::Quaterniond q(wxyz[0] / greatest, wxyz[1] / greatest, wxyz[2] / greatest,
                       wxyz[3] / greatest);
  q.coeffs() /= q.norm();
  return q.toRotationMatrix();
}

Shape read_shape(const JsonNode& node, std::string_view others) {
  node.as_object("an object, such as {\"type\":\"sphere\",\"radius\":1}");
  const JsonNode type = node.at("type", "a shape's name");
  const std::string& name = type.text("a shape's name");
  Shape shape;
  const auto kind =
      std::ranges::find_if(all_shape_kinds, [&](ShapeKind k) { return to_string(k) == name; });
  if (kind == all_shape_kinds.end()) {
    std::string known;
    for (const ShapeKind k : all_shape_kinds) {
      known += (known.empty() ? "" : ", ") + std::string(to_string(k));
    }
    type.fail(fmt::format("found {}; expected one of {}{}", type.found(), known, others));
  }
  shape.kind = *kind;
  switch (shape.kind) {
    case ShapeKind::sphere: shape.radius = node.at("radius", "metres").size_number(); break;
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      shape.radius = node.at("radius", "metres").size_number();
      shape.half_length = node.at("half_length", "metres").size_number();
      break;
    case ShapeKind::box:
      shape.half_extents =
          node.at("half_extents", "an array of 3 numbers").vector(&JsonNode::size_number);
      break;
    case ShapeKind::ellipsoid:
      shape.radii = node.at("radii", "an array of 3 numbers").vector(&JsonNode::size_number);
      break;
    case ShapeKind::hull:
      shape.hull = read_hull(node.at("vertices", "an array of at least one vertex [x,y,z]"));
      break;
    case ShapeKind::halfspace: {
      const JsonNode normal = node.at("normal", "an array of 3 numbers");
      shape.normal = normal.vector();
      if (shape.normal == Vec3d::Zero()) normal.fail("the zero vector; expected a direction");
      shape.offset = node.at("offset", "a number").number();
      break;
    }
  }
  return shape;
}

OrderedJson to_array(const Vec3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

Pose read_pose(const JsonNode& body) {
  Pose pose;
  if (body.has("translation")) {
    pose.translation = body.at("translation", "").vector();
  }
  if (body.has("rotation") && body.has("quaternion_wxyz")) {
    body.fail("both \"rotation\" and \"quaternion_wxyz\"; expected one of them");
  }
  if (body.has("rotation")) {
    const std::array<double, 9> rows = body.at("rotation", "").numbers<9>();
    pose.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
  } else if (body.has("quaternion_wxyz")) {
    pose.rotation = read_quaternion(body.at("quaternion_wxyz", ""));
  }
  return pose;
}

int read_axis(const JsonNode& shape) {
  if (!shape.has("axis")) return 2;
  const JsonNode axis = shape.at("axis", "");
  const std::string& name = axis.text("\"x\", \"y\" or \"z\"");
  for (int i = 0; i < 3; ++i) {
    if (name == axis_names[i]) return i;
  }
  axis.fail(fmt::format("found {}; expected \"x\", \"y\" or \"z\"", axis.found()));
}

void read_body(const JsonNode& body, Shape& shape, Pose& pose, std::string_view others) {
  body.as_object("an object with a shape and its pose");
  const JsonNode node = body.at("shape", "an object, such as {\"type\":\"sphere\",\"radius\":1}");
  shape = read_shape(node, others);
  pose = read_pose(body);
  if (shape.kind == ShapeKind::capsule || shape.kind == ShapeKind::cylinder ||
      shape.kind == ShapeKind::cone) {
    // The axis becomes z, and the other two follow in cyclic order.
    const int axis = read_axis(node);
    const Mat3d given = pose.rotation;
    for (int column = 0; column < 3; ++column) {
      pose.rotation.col(column) = given.col((column + axis + 1) % 3);
    }
  }
}

OrderedJson body_to_json(const Shape& shape, const Pose& pose) {
  OrderedJson out;
  out["type"] = to_string(shape.kind);
  switch (shape.kind) {
    case ShapeKind::sphere: out["radius"] = shape.radius; break;
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      out["radius"] = shape.radius;
      out["half_length"] = shape.half_length;
      break;
    case ShapeKind::box: out["half_extents"] = to_array(shape.half_extents); break;
    case ShapeKind::ellipsoid: out["radii"] = to_array(shape.radii); break;
    case ShapeKind::hull:
      for (const Vec3d& vertex : shape.hull->vertices) out["vertices"].push_back(to_array(vertex));
      break;
    case ShapeKind::halfspace:
      out["normal"] = to_array(shape.normal);
      out["offset"] = shape.offset;
      break;
  }
  OrderedJson body;
  body["shape"] = std::move(out);
  body["translation"] = to_array(pose.translation);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      body["rotation"].push_back(pose.rotation(row, column));
    }
  }
  return body;
}

namespace {

Motion read_motion(const JsonNode& body) {
  Motion motion;
  if (body.has("displacement")) motion.displacement = body.at("displacement", "").vector();
  if (body.has("rotation_vector")) motion.rotation_vector = body.at("rotation_vector", "").vector();
  return motion;
}

}  // namespace

void for_each_case(const std::filesystem::path& file,
                   const std::function<void(const JsonNode&)>& each) {
  for_each_json_line(file, "case", [&](const JsonNode& line) {
    if (!line.value().is_object() || !line.has("protocol")) each(line);
  });
}

std::string read_id(const JsonNode& line) {
  return line.has("id") ? line.at("id", "").text("a string") : fmt::format("{}", line.line());
}

void read_case(const JsonNode& line, Case& c) {
  line.as_object("a case: an object with \"a\" and \"b\"");
  c.id = read_id(line);
  read_body(line.at("a", "the first body"), c.shape_a, c.pose_a);
  read_body(line.at("b", "the second body"), c.shape_b, c.pose_b);
}

CastCase read_cast_case(const JsonNode& line) {
  CastCase c;
  read_case(line, c);
  c.motion_a = read_motion(line.at("a", "the first body"));
  c.motion_b = read_motion(line.at("b", "the second body"));
  return c;
}

OrderedJson to_ordered_json(const CastCase& c) {
  const auto body = [](const Shape& shape, const Pose& pose, const Motion& motion) {
    OrderedJson out = body_to_json(shape, pose);
    const auto add = [&](const char* key, const Vec3d& v) { out[key] = {v.x(), v.y(), v.z()}; };
    add("displacement", motion.displacement);
    add("rotation_vector", motion.rotation_vector);
    return out;
  };
  OrderedJson out;
  out["id"] = c.id;
  out["a"] = body(c.shape_a, c.pose_a, c.motion_a);
  out["b"] = body(c.shape_b, c.pose_b, c.motion_b);
  return out;
}

namespace {

constexpr std::array<std::string_view, 25> known_keys = {"id",
                                                         "a",
                                                         "b",
                                                         "shape",
                                                         "translation",
                                                         "rotation",
                                                         "type",
                                                         "radius",
                                                         "quaternion_wxyz",
                                                         "displacement",
                                                         "half_length",
                                                         "axis",
                                                         "half_extents",
                                                         "rotation_vector",
                                                         "radii",
                                                         "vertices",
                                                         "normal",
                                                         "offset",
                                                         "triangles",
                                                         "solid",
                                                         "parts",
                                                         "mesh",
                                                         "scale",
                                                         "as",
                                                         "quaternion_exact"};

// The known key that was meant, if any.
std::optional<std::string_view> meant(const std::string& key) {
  if (key.size() < 3 || key.size() > 40) return {};
  std::string small = key;
  for (char& c : small)
    c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view known : known_keys) {
    const std::size_t most = known.size() < 4 ? 0 : known.size() < 6 ? 1 : 2;
    if (base::edits(small, known) <= most) return known;
  }
  return {};
}

}  // namespace

void KeyWarnings::look(const JsonNode& line) { look_within(line, 0); }

void KeyWarnings::look_within(const JsonNode& node, int depth) {
  constexpr int deepest = 64;
  if (!node.value().is_object() || depth > deepest) return;
  for (const auto& [key, value] : node.value().items()) {
    if (std::ranges::find(known_keys, key) != known_keys.end() || !seen_.insert(key).second) {
      continue;
    }
    if (const auto known = meant(key)) {
      base::warn(node.file(), node.line(),
                 fmt::format("the key \"{}\" is ignored; perhaps \"{}\" was meant",
                             base::shortened(key), *known));
    }
  }
  for (const char* inner : {"a", "b", "shape"}) {
    if (node.has(inner)) look_within(node.at(inner, ""), depth + 1);
  }
  if (!node.has("parts")) return;
  const JsonNode parts = node.at("parts", "");
  if (!parts.value().is_array()) return;
  for (std::size_t i = 0; i < parts.size(); ++i) look_within(parts[i], depth + 1);
}

}  // namespace touchstone::files
