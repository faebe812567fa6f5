// Imports bodies, meshes and velocities of a rigid-ipc scene.
#include "harness/scene/rigid_ipc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/mesh.h"
#include "harness/geometry/mesh_solid.h"
#include "harness/scene/concave_shape.h"
#include "harness/scene/json_object.h"

namespace touchstone::scene {
namespace {

using Json = nlohmann::json;

constexpr int frame_cap = 100;

bool has_velocity(const Body& body) {
  return !(body.velocity.isZero(0) && body.angular_velocity.isZero(0));
}

// The rotation about x, then y, then z, in degrees.
Mat3d rotation_of_degrees(const Vec3d& degrees) {
  const base::SinCos x = base::sin_cos_turns(degrees.x() / 360);
  const base::SinCos y = base::sin_cos_turns(degrees.y() / 360);
  const base::SinCos z = base::sin_cos_turns(degrees.z() / 360);
  Mat3d about_x, about_y, about_z;
  about_x << 1, 0, 0, 0, x.cos, -x.sin, 0, x.sin, x.cos;
  about_y << y.cos, 0, y.sin, 0, 1, 0, -y.sin, 0, y.cos;
  about_z << z.cos, -z.sin, 0, z.sin, z.cos, 0, 0, 0, 1;
  return base::product(about_z, base::product(about_y, about_x));
}

class Importer {
 public:
  Importer(std::filesystem::path file, MeshUse use) : file_(std::move(file)), use_(use) {}

  Scene import() {
    const Json json = parse_json(file_, "a rigid-ipc scene");
    const JsonObject top(json, file_.string(), "");
    const Json* problem = top.find("rigid_body_problem");
    if (problem == nullptr) top.fail("no 'rigid_body_problem'; expected a rigid-ipc scene");
    const Json* bodies =
        JsonObject(*problem, file_.string(), "rigid_body_problem").find("rigid_bodies");
    if (bodies == nullptr || !bodies->is_array()) {
      top.fail("no 'rigid_bodies' in 'rigid_body_problem'; expected a list of bodies");
    }
    scene_.name = file_.stem().string();
    for (std::size_t i = 0; i < bodies->size(); ++i) {
      add_body(JsonObject((*bodies)[i], file_.string(), "body " + std::to_string(i)));
    }
    if (scene_.bodies.empty()) top.fail("no enabled bodies; expected at least one");
    set_frames(top);
    return std::move(scene_);
  }

 private:
  // A mesh at its scale: a shape whose vertices are relative to the centre of mass.
  struct Part {
    std::uint32_t shape;
    Vec3d centre;
  };

  void add_body(const JsonObject& body) {
    if (!body.boolean("enabled", true)) return;
    if (body.find("kinematic_poses") != nullptr) {
      body.fail("'kinematic_poses' are not supported; expected a body moved by its velocities");
    }
    const std::string type = body.text("type", "dynamic");
    if (type != "static" && type != "kinematic" && type != "dynamic") {
      body.fail("type '" + type + "'; expected static, kinematic or dynamic");
    }
    const Mat3d rotation = rotation_of_degrees(body.vector("rotation", Vec3d::Zero()));
    const Vec3d position = body.vector("position", Vec3d::Zero());
    Body placed;
    placed.velocity = body.vector("linear_velocity", Vec3d::Zero());
    placed.angular_velocity =
        body.vector("angular_velocity", Vec3d::Zero()) * (std::numbers::pi / 180);
    const std::array<bool, 6> fixed = fixed_freedoms(body);
    for (int k = 0; k < 3; ++k) {
      if (fixed[static_cast<std::size_t>(k)]) placed.velocity[k] = 0;
      if (fixed[static_cast<std::size_t>(k + 3)]) placed.angular_velocity[k] = 0;
    }
    // The importing scene may still give a motion to a dynamic body at rest.
    placed.moving = type == "dynamic" || (type == "kinematic" && has_velocity(placed));
    const double end = body.number("kinematic_max_time", -1);
    if (type == "kinematic" && end >= 0) end_ = std::min(end_, end);

    for (const Part& part : parts_of(body)) {
      placed.shape = part.shape;
      placed.pose.rotation = rotation;
      placed.pose.translation = position;
      for (int k = 0; k < 3; ++k) {
        placed.pose.translation[k] += rotation(k, 0) * part.centre.x() +
                                      rotation(k, 1) * part.centre.y() +
                                      rotation(k, 2) * part.centre.z();
      }
      scene_.bodies.push_back(placed);
    }
  }

  static std::array<bool, 6> fixed_freedoms(const JsonObject& body) {
    std::array<bool, 6> fixed{};
    const Json* value = body.find("is_dof_fixed");
    if (value == nullptr) return fixed;
    if (value->is_boolean()) {
      fixed.fill(value->get<bool>());
      return fixed;
    }
    if (!value->is_array() || value->size() != 6 ||
        !std::all_of(value->begin(), value->end(), [](const Json& v) { return v.is_boolean(); })) {
      body.fail("'is_dof_fixed': expected true, false or six of them");
    }
    for (std::size_t k = 0; k < 6; ++k) fixed[k] = (*value)[k].get<bool>();
    return fixed;
  }

  const std::vector<Part>& parts_of(const JsonObject& body) {
    const std::string name = body.text("mesh", "");
    const bool split = body.boolean("split_components", false);
    if (name.empty()) {
      own_parts_ = make_parts(scaled(inline_mesh(body), body), split);
      return own_parts_;
    }
    const auto [at, is_new] = meshes_.try_emplace(name);
    if (is_new) {
      scene_.files.push_back(find_mesh(body, name));
      at->second = geometry::read_mesh(scene_.files.back());
    }
    const Vec3d scale = scale_of(body, at->second);
    const auto [parts, is_new_scale] =
        parts_.try_emplace({name, scale.x(), scale.y(), scale.z(), split});
    if (is_new_scale) parts->second = make_parts(scaled(at->second, body), split);
    return parts->second;
  }

  std::filesystem::path find_mesh(const JsonObject& body, const std::string& name) const {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::absolute(file_).parent_path();
    const auto exists = [&](const std::filesystem::path& p) {
      return std::filesystem::is_regular_file(p, error);
    };
    if (exists(folder / name)) return folder / name;
    for (std::filesystem::path at = folder;; at = at.parent_path()) {
      if (exists(at / "meshes" / name)) return at / "meshes" / name;
      if (at == at.root_path() || at.empty()) break;
    }
    body.fail("mesh '" + name + "' not found; expected it relative to " + folder.string() +
              " or to a folder 'meshes' there or above");
  }

  static geometry::Mesh inline_mesh(const JsonObject& body) {
    geometry::Mesh mesh;
    const Json* vertices = body.find("vertices");
    if (vertices == nullptr || !vertices->is_array() || vertices->empty()) {
      body.fail("expected 'mesh', or 'vertices' with at least one point");
    }
    for (const Json& v : *vertices) mesh.vertices.push_back(body.to_vector(v, "vertices"));
    const Json* faces = body.find("faces");
    if (faces == nullptr) return mesh;
    if (!faces->is_array()) body.fail("'faces': expected a list of triangles");
    for (const Json& face : *faces) {
      std::array<std::uint32_t, 3> triangle{};
      bool good = face.is_array() && face.size() == 3;
      for (std::size_t k = 0; good && k < 3; ++k) {
        good = face[k].is_number_unsigned() && face[k].get<std::uint64_t>() < mesh.vertices.size();
        if (good) triangle[k] = face[k].get<std::uint32_t>();
      }
      if (!good) body.fail("'faces': expected triangles of three vertex indices in range");
      mesh.triangles.push_back(triangle);
    }
    return mesh;
  }

  // Dimensions take precedence over a scale.
  static Vec3d scale_of(const JsonObject& body, const geometry::Mesh& mesh) {
    if (body.find("dimensions") != nullptr) {
      Vec3d low = mesh.vertices.front(), high = low;
      for (const Vec3d& v : mesh.vertices) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
      Vec3d scale = body.vector("dimensions", Vec3d::Ones());
      for (int k = 0; k < 3; ++k) scale[k] /= high[k] > low[k] ? high[k] - low[k] : 1;
      return scale;
    }
    const Json* scale = body.find("scale");
    if (scale != nullptr && scale->is_number()) return Vec3d::Constant(scale->get<double>());
    return body.vector("scale", Vec3d::Ones());
  }

  static geometry::Mesh scaled(geometry::Mesh mesh, const JsonObject& body) {
    const Vec3d scale = scale_of(body, mesh);
    for (Vec3d& v : mesh.vertices) {
      v = v.cwiseProduct(scale).eval();
      if (!v.allFinite()) body.fail("the scaled mesh is not finite; expected a smaller scale");
    }
    return mesh;
  }

  std::vector<Part> make_parts(const geometry::Mesh& mesh, bool split) {
    std::vector<Part> parts;
    for (geometry::Mesh& part :
         split ? geometry::connected_parts(mesh) : std::vector<geometry::Mesh>{mesh}) {
      const Vec3d centre = geometry::centre_of_mass(part);
      for (Vec3d& v : part.vertices) v -= centre;
      // A body of loose points has no triangles, and is their hull.
      const MeshUse use = part.triangles.empty() ? MeshUse::hull : use_;
      ConcaveShape shape = mesh_shape(std::move(part), use);
      parts.push_back({scene_.add_shape(shape.hull, shape.mesh, shape.body), centre});
    }
    return parts;
  }

  void set_frames(const JsonObject& top) {
    const double step = top.number("timestep", 0.01);
    if (!(step > 0)) top.fail("'timestep': expected a number above 0");
    scene_.motion.kind = MotionKind::inertial;
    scene_.motion.time_step = step;
    const bool moves = std::ranges::any_of(
        scene_.bodies, [](const Body& body) { return body.moving && has_velocity(body); });
    if (!moves) return;
    const double time = top.number("max_time", -1);
    double steps = time >= 0 ? std::ceil(time / step) : top.number("max_iterations", 0);
    steps = std::min(steps, std::floor(end_ / step));
    scene_.frames = static_cast<int>(std::clamp(steps + 1, 1.0, double{frame_cap}));
  }

  std::filesystem::path file_;
  MeshUse use_;
  Scene scene_;
  double end_ = std::numeric_limits<double>::infinity();  // seconds
  std::map<std::string, geometry::Mesh> meshes_;
  std::map<std::tuple<std::string, double, double, double, bool>, std::vector<Part>> parts_;
  std::vector<Part> own_parts_;
};

}  // namespace

Scene import_rigid_ipc(const std::filesystem::path& file, MeshUse use) {
  return Importer(file, use).import();
}

}  // namespace touchstone::scene
