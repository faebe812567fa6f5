// Parts the transforms of nodes into poses and what is left for the vertices.
#include "harness/scene/model_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/reproducible_math.h"
#include "harness/files/text_file.h"
#include "harness/files/toml_table.h"
#include "harness/geometry/mesh_solid.h"
#include "harness/models/model.h"

namespace touchstone::scene {
namespace {

// Of the greatest element. Assimp computes in floats, whose rounding adds up along the path of a node.
constexpr double equal_shapes = 2e-6;

// m = rotation * shape, where the shape is an upper triangle: with no rotation in it, it is the same for all instances of
// a scaled mesh. The last of its diagonal is negative for a mirror.
struct Parted {
  Mat3d rotation, shape;
};

// A unit vector across the unit vector n.
Vec3d across(const Vec3d& n) {
  int least = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(n[k]) < std::abs(n[least])) least = k;
  }
  return base::beside(n, Vec3d::Unit(least));
}

Parted part(const Mat3d& matrix) {
  const double size = matrix.cwiseAbs().maxCoeff();
  const Mat3d m = size > 0 ? Mat3d(matrix / size) : matrix;  // no square overflows
  const Vec3d a = m.col(0), b = m.col(1), c = m.col(2);
  const Vec3d x = base::unit(a);
  const Vec3d rest = b - base::inner(x, b) * x;
  // What is left of a column that is along the first one is rounding.
  constexpr double rounding = 1e-7;
  Vec3d y = base::length(rest) > rounding * base::length(b) ? base::unit(rest) : across(x);
  y = base::unit(y - base::inner(x, y) * x);
  const Vec3d z = base::outer(x, y);
  Parted parted;
  parted.rotation << x, y, z;
  parted.shape << base::inner(x, a), base::inner(x, b), base::inner(x, c),  //
      0, base::inner(y, b), base::inner(y, c),                              //
      0, 0, base::inner(z, c);
  if (size > 0) parted.shape *= size;
  return parted;
}

bool are_equal(const Mat3d& a, const Mat3d& b) {
  return (a - b).cwiseAbs().maxCoeff() <= equal_shapes * b.cwiseAbs().maxCoeff();
}

// With a mark in place of bytes that are no UTF-8.
std::string as_utf8(const std::string& text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

class Placer {
 public:
  Placer(std::string file, models::Model model)
      : file_(std::move(file)), model_(std::move(model)) {}

  PlacedModel place() {
    models::expect_few(file_, model_);
    for (const models::ModelNode& node : model_.nodes) add(node);
    const std::string up = model_.up();
    const auto counted = [](std::size_t count, const char* one, const char* many) {
      return fmt::format("{} {}", count, count == 1 ? one : many);
    };
    placed_.words =
        fmt::format("model: {}, {}; {}, {} up{}", counted(placed_.nodes.size(), "body", "bodies"),
                    counted(placed_.meshes.size(), "shape", "shapes"),
                    model_.metres == 1 ? "metres" : fmt::format("unit {} m", model_.metres), up,
                    up == "z" ? "" : ", turned to z up");
    placed_.left_out = model_.left_out.words();
    return std::move(placed_);
  }

 private:
  struct Known {
    Mat3d shape;
    std::uint32_t mesh;
  };

  void add(const models::ModelNode& node) {
    std::vector<std::uint32_t> meshes;
    for (const std::uint32_t mesh : node.meshes) {
      if (!model_.meshes[mesh].triangles.empty()) meshes.push_back(mesh);
    }
    if (meshes.empty()) return;
    Parted parted = part(base::product(model_.z_up, node.to_file.linear));
    parted.shape *= model_.metres;
    if (are_equal(parted.shape, Mat3d::Identity())) parted.shape.setIdentity();
    PlacedModel::Node& placed = placed_.nodes.emplace_back();
    placed.name = unique_name(as_utf8(node.name));
    // Without zeros of a sign, which a scene file would not keep.
    placed.pose.rotation = parted.rotation.array() + 0.0;
    placed.pose.translation = model_.metres * base::times(model_.z_up, node.to_file.translation);
    placed.mesh = mesh_of(meshes, parted.shape);
    if (!placed.pose.rotation.allFinite() || !placed.pose.translation.allFinite()) {
      throw base::InputError(file_, 0,
                             fmt::format("node \"{}\" is not at a finite place; expected one",
                                         base::shortened(placed.name)));
    }
  }

  std::uint32_t mesh_of(const std::vector<std::uint32_t>& meshes, const Mat3d& shape) {
    std::vector<Known>& known = known_[meshes];
    for (const Known& one : known) {
      if (are_equal(shape, one.shape)) return one.mesh;
    }
    models::Joiner joiner;
    for (const std::uint32_t mesh : meshes) {
      joiner.add(model_.meshes[mesh], {shape, Vec3d::Zero()});
    }
    models::ModelMesh made = joiner.take();
    for (const Vec3d& v : made.vertices) {
      if (v.allFinite()) continue;
      throw base::InputError(file_, 0,
                             "a vertex is not finite at its scale; expected a smaller one");
    }
    known.push_back({shape, static_cast<std::uint32_t>(placed_.meshes.size())});
    placed_.meshes.push_back({std::move(made.vertices), std::move(made.triangles)});
    return known.back().mesh;
  }

  // "chair", "chair-2", "chair-3".
  std::string unique_name(const std::string& name) {
    const std::string base = name.empty() ? "node" : name;
    std::string unique = base;
    int& number = numbers_.try_emplace(base, 1).first->second;
    while (!names_.insert(unique).second) unique = fmt::format("{}-{}", base, ++number);
    return unique;
  }

  std::string file_;
  models::Model model_;
  PlacedModel placed_;
  std::map<std::vector<std::uint32_t>, std::vector<Known>> known_;
  std::set<std::string> names_;
  std::map<std::string, int> numbers_;  // the last behind a name
};

}  // namespace

PlacedModel place_model(const std::filesystem::path& file) {
  return Placer(file.string(), models::read_model(file)).place();
}

Scene import_model(const std::filesystem::path& file, MeshUse use) {
  PlacedModel model = place_model(file);
  Scene scene;
  scene.name = file.stem().string();
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    geometry::Mesh& mesh = model.meshes[i];
    if (use == MeshUse::solid && geometry::open_edge(mesh.vertices, mesh.triangles)) {
      throw base::InputError(
          file.string(), 0,
          fmt::format("solids, and the surface of mesh {} is open; expected closed ones, or "
                      "meshes = \"surface\"",
                      i));
    }
    const ConcaveShape made = mesh_shape(std::move(mesh), use);
    scene.add_shape(made.hull, made.mesh, made.body);
  }
  for (const PlacedModel::Node& node : model.nodes) {
    Body body;
    body.shape = node.mesh;
    body.pose = node.pose;
    scene.bodies.push_back(body);
    scene.names.push_back(node.name);
  }
  return scene;
}

std::vector<std::filesystem::path> write_model(const PlacedModel& model,
                                               const std::filesystem::path& file) {
  std::vector<std::filesystem::path> written;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    names.push_back(fmt::format("{}-{}.off", file.stem().string(), i));
    written.push_back(file.parent_path() / names.back());
    const geometry::Mesh& mesh = model.meshes[i];
    write_off(written.back(), {mesh.vertices, mesh.triangles});
  }
  toml::array bodies;
  for (const PlacedModel::Node& node : model.nodes) {
    toml::array rotation, translation;
    for (int i = 0; i < 9; ++i) rotation.push_back(node.pose.rotation(i / 3, i % 3));
    for (int i = 0; i < 3; ++i) translation.push_back(node.pose.translation[i]);
    bodies.push_back(toml::table{{"name", node.name},
                                 {"mesh", names[node.mesh]},
                                 {"translation", std::move(translation)},
                                 {"rotation", std::move(rotation)}});
  }
  std::ostringstream text;
  text << toml::table{{"body", std::move(bodies)}} << "\n";
  written.push_back(file);
  files::write_text(file, text.str());
  return written;
}

}  // namespace touchstone::scene
