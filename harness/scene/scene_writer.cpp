// Writes scenes as TOML.
#include "harness/scene/scene.h"

#include <fmt/format.h>

#include <string>

#include "harness/files/text_file.h"

namespace touchstone::scene {
namespace {

// A float in TOML; a zero keeps its sign.
std::string number(double x) {
  std::string text = fmt::format("{}", x);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string vector(const Vec3d& v) {
  return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}

std::string place(const Pose& pose) {
  std::string rotation;
  for (int i = 0; i < 9; ++i) {
    rotation += (i == 0 ? "" : ", ") + number(pose.rotation(i / 3, i % 3));
  }
  return fmt::format("translation = {}, rotation = [{}]", vector(pose.translation), rotation);
}

std::string table_of(const Shape& shape) {
  std::string text = fmt::format("{{type = \"{}\"", to_string(shape.kind));
  switch (shape.kind) {
    case ShapeKind::sphere: text += ", radius = " + number(shape.radius); break;
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      text += fmt::format(", radius = {}, half_length = {}", number(shape.radius),
                          number(shape.half_length));
      break;
    case ShapeKind::box: text += ", half_extents = " + vector(shape.half_extents); break;
    case ShapeKind::ellipsoid: text += ", radii = " + vector(shape.radii); break;
    case ShapeKind::hull:
      text += ", vertices = [";
      for (const Vec3d& vertex : shape.hull->vertices) text += vector(vertex) + ", ";
      text += "]";
      break;
    case ShapeKind::halfspace:
      text += fmt::format(", normal = {}, offset = {}", vector(shape.normal), number(shape.offset));
      break;
  }
  return text + "}";
}

class Writer {
 public:
  explicit Writer(const std::filesystem::path& file) : file_(file) {}

  // `name`: none if empty.
  void add(const SceneBody& placed, const std::string& name) {
    text_ += fmt::format("  {{{}{}, moving = false, shape = {}}},\n",
                         name.empty() ? "" : fmt::format("name = \"{}\", ", name),
                         place(placed.pose), table_of(placed.body));
  }

  void write(const std::string& keys) const {
    files::write_text(file_, keys + "body = [\n" + text_ + "]\n");
  }

 private:
  std::string table_of(const TriangleMesh& mesh) {
    const std::string name = fmt::format("{}-{}.off", file_.stem().string(), meshes_++);
    write_off(file_.parent_path() / name, mesh);
    return fmt::format("{{mesh = \"{}\", as = \"{}\"}}", name, mesh.solid ? "solid" : "surface");
  }

  std::string table_of(const ConcaveBody& body) {
    if (body.mesh) return table_of(*body.mesh);
    const bool is_shape = body.parts.size() == 1 && body.surfaces.empty() &&
                          body.parts[0].pose.rotation.isIdentity(0) &&
                          body.parts[0].pose.translation.isZero(0);
    if (is_shape) return scene::table_of(body.parts[0].shape);
    std::string text = "{type = \"compound\", parts = [";
    auto surface = body.surfaces.begin();
    for (std::size_t i = 0; i < body.parts.size();) {
      const ConvexPart& part = body.parts[i];
      const bool is_mesh = surface != body.surfaces.end() && surface->first == i;
      text += fmt::format("{{{}, shape = {}}}, ", place(part.pose),
                          is_mesh ? table_of(*surface->mesh) : scene::table_of(part.shape));
      i += is_mesh ? surface++->mesh->triangles.size() : 1;
    }
    return text + "]}";
  }

  std::filesystem::path file_;
  std::string text_;
  int meshes_ = 0;
};

}  // namespace

void write_scene(const std::filesystem::path& file, std::span<const SceneBody> bodies,
                 std::span<const std::string> names, const std::string& keys) {
  Writer writer(file);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    writer.add(bodies[i], names.empty() ? "" : names[i]);
  }
  writer.write(keys);
}

void write_off(const std::filesystem::path& file, const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3d& v : mesh.vertices) text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  files::write_text(file, text);
}

}  // namespace touchstone::scene
