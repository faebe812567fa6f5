#include "harness/io/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "harness/error.h"
#include "harness/scene/convex_hull.h"

namespace touchstone {
namespace {

using Json = nlohmann::json;

// A value in a line of the file, and the way to it, which is written out only where it is wrong.
class Node {
 public:
  Node(const std::string& file, std::int64_t line, const Json& value)
      : file_(file), line_(line), value_(value) {}
  Node(const Node&) = delete;  // children know the place of their parent
  Node& operator=(const Node&) = delete;

  [[noreturn]] void fail(const std::string& message) const {
    const std::string way = path();
    throw InputError(file_, line_, way.empty() ? message : way + ": " + message);
  }

  const Json& value() const { return value_; }
  std::size_t size() const { return value_.size(); }
  bool has(const char* key) const { return value_.contains(key); }

  // A member that has to be there; `expected` says what it is.
  Node at(const char* key, std::string_view expected) const {
    const auto member = value_.find(key);
    if (member == value_.end()) fail(fmt::format("no \"{}\"; expected {}", key, expected));
    return {*this, *member, key, 0};
  }
  Node operator[](std::size_t index) const { return {*this, value_[index], nullptr, index}; }

  const Node& as_object(std::string_view expected) const {
    if (!value_.is_object()) fail(fmt::format("found {}; expected {}", found(), expected));
    return *this;
  }
  double number() const {
    if (!value_.is_number()) fail(fmt::format("found {}; expected a number", found()));
    return value_.get<double>();
  }
  double size_number() const {
    const double size = number();
    if (size < 0) fail(fmt::format("found {}; expected a number >= 0", found()));
    return size;
  }
  const std::string& text(std::string_view expected) const {
    const std::string* const string = value_.get_ptr<const std::string*>();
    if (string == nullptr) fail(fmt::format("found {}; expected {}", found(), expected));
    return *string;
  }
  template <std::size_t size>
  std::array<double, size> numbers(double (Node::*read)() const = &Node::number) const {
    if (!value_.is_array() || value_.size() != size) {
      fail(fmt::format("found {}; expected an array of {} numbers", found(), size));
    }
    std::array<double, size> all;
    for (std::size_t i = 0; i < size; ++i) all[i] = ((*this)[i].*read)();
    return all;
  }
  Vec3d vector(double (Node::*read)() const = &Node::number) const {
    return Vec3d(numbers<3>(read).data());
  }

  // The value for a message: as it is written where it is short.
  std::string found() const {
    if (value_.is_array()) return fmt::format("an array of {}", value_.size());
    if (value_.is_object()) return "an object";
    const std::string text = value_.dump();
    return text.size() <= 40 ? text : fmt::format("a {}", value_.type_name());
  }

 private:
  Node(const Node& parent, const Json& value, const char* key, std::size_t index)
      : file_(parent.file_),
        line_(parent.line_),
        value_(value),
        parent_(&parent),
        key_(key),
        index_(index) {}

  std::string path() const {
    if (parent_ == nullptr) return "";
    const std::string above = parent_->path();
    if (key_ == nullptr) return fmt::format("{}[{}]", above, index_);
    return above.empty() ? key_ : above + "." + key_;
  }

  const std::string& file_;
  std::int64_t line_;
  const Json& value_;
  const Node* parent_ = nullptr;
  const char* key_ = nullptr;
  std::size_t index_ = 0;
};

constexpr std::string_view axis_names[] = {"x", "y", "z"};

// The axis that a capsule, cylinder or cone lies along: 0, 1 or 2.
int read_axis(const Node& shape) {
  if (!shape.has("axis")) return 2;
  const Node axis = shape.at("axis", "");
  const std::string& name = axis.text("\"x\", \"y\" or \"z\"");
  for (int i = 0; i < 3; ++i) {
    if (name == axis_names[i]) return i;
  }
  axis.fail(fmt::format("found {}; expected \"x\", \"y\" or \"z\"", axis.found()));
}

std::shared_ptr<const Hull> read_hull(const Node& vertices) {
  if (!vertices.value().is_array() || vertices.size() == 0) {
    vertices.fail(fmt::format("found {}; expected an array of at least one vertex [x,y,z]",
                              vertices.found()));
  }
  std::vector<Vec3d> points;
  points.reserve(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) points.push_back(vertices[i].vector());
  return make_hull(std::move(points));
}

Shape read_shape(const Node& node) {
  node.as_object("an object, such as {\"type\":\"sphere\",\"radius\":1}");
  const Node type = node.at("type", "a shape's name");
  const std::string& name = type.text("a shape's name");
  Shape shape;
  const auto kind =
      std::ranges::find_if(all_shape_kinds, [&](ShapeKind k) { return to_string(k) == name; });
  if (kind == all_shape_kinds.end()) {
    std::string known;
    for (const ShapeKind k : all_shape_kinds) {
      known += (known.empty() ? "" : ", ") + std::string(to_string(k));
    }
    type.fail(fmt::format("found {}; expected one of {}", type.found(), known));
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
          node.at("half_extents", "an array of 3 numbers").vector(&Node::size_number);
      break;
    case ShapeKind::ellipsoid:
      shape.radii = node.at("radii", "an array of 3 numbers").vector(&Node::size_number);
      break;
    case ShapeKind::hull:
      shape.hull = read_hull(node.at("vertices", "an array of at least one vertex [x,y,z]"));
      break;
    case ShapeKind::halfspace: {
      const Node normal = node.at("normal", "an array of 3 numbers");
      shape.normal = normal.vector();
      if (shape.normal == Vec3d::Zero()) normal.fail("the zero vector; expected a direction");
      shape.offset = node.at("offset", "a number").number();
      break;
    }
  }
  return shape;
}

// The greatest part is scaled to 1 first, so that no square overflows or vanishes.
Mat3d read_quaternion(const Node& node) {
  const std::array<double, 4> wxyz = node.numbers<4>();
  double greatest = 0;
  for (const double part : wxyz) greatest = std::max(greatest, std::abs(part));
  if (greatest == 0) node.fail("the zero quaternion; expected one that can be normalised");
  Eigen::Quaterniond q(wxyz[0] / greatest, wxyz[1] / greatest, wxyz[2] / greatest,
                       wxyz[3] / greatest);
  q.coeffs() /= q.norm();
  return q.toRotationMatrix();
}

Pose read_pose(const Node& body) {
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

void read_body(const Node& body, Shape& shape, Pose& pose) {
  body.as_object("an object with a shape and its pose");
  const Node node = body.at("shape", "an object, such as {\"type\":\"sphere\",\"radius\":1}");
  shape = read_shape(node);
  pose = read_pose(body);
  if (shape.kind == ShapeKind::capsule || shape.kind == ShapeKind::cylinder ||
      shape.kind == ShapeKind::cone) {
    // The axis becomes z, and the other two follow it in turn.
    const int axis = read_axis(node);
    const Mat3d given = pose.rotation;
    for (int column = 0; column < 3; ++column) {
      pose.rotation.col(column) = given.col((column + axis + 1) % 3);
    }
  }
}

Case read_case(const Node& node) {
  node.as_object("a case: an object with \"id\", \"a\" and \"b\"");
  Case c;
  c.id = node.at("id", "a string").text("a string");
  read_body(node.at("a", "the first body"), c.shape_a, c.pose_a);
  read_body(node.at("b", "the second body"), c.shape_b, c.pose_b);
  return c;
}

Json parse_line(const std::string& file, std::int64_t number, std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    // The library counts its own lines; its text begins with a name in brackets.
    std::string message = error.what();
    if (const auto end = message.find("] "); end != std::string::npos) message.erase(0, end + 2);
    if (message.starts_with("parse error at line 1, ")) message.erase(0, 23);
    throw InputError(file, number, "malformed JSON: " + message);
  }
}

nlohmann::ordered_json to_array(const Vec3d& v) { return {v[0], v[1], v[2]}; }

nlohmann::ordered_json body_to_json(const Shape& shape, const Pose& pose) {
  nlohmann::ordered_json out;
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
  nlohmann::ordered_json body;
  body["shape"] = std::move(out);
  body["translation"] = to_array(pose.translation);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      body["rotation"].push_back(pose.rotation(row, column));
    }
  }
  return body;
}

}  // namespace

std::vector<Case> read_cases(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError(file, 0, "a directory; expected a file of cases, one JSON object a line");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(file, 0, std::strerror(errno));
  std::vector<Case> cases;
  std::string line;
  for (std::int64_t number = 1; std::getline(stream, line); ++number) {
    std::string_view text = line;
    if (number == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    if (text.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const Json value = parse_line(file, number, text);
    cases.push_back(read_case(Node(file, number, value)));
  }
  if (stream.bad()) throw InputError(file, 0, std::strerror(errno));
  if (cases.empty()) {
    throw InputError(file, 1, "no case; expected one JSON object a line");
  }
  return cases;
}

std::string to_json(const Case& c) {
  nlohmann::ordered_json out;
  out["id"] = c.id;
  out["a"] = body_to_json(c.shape_a, c.pose_a);
  out["b"] = body_to_json(c.shape_b, c.pose_b);
  return out.dump();
}

}  // namespace touchstone
