// MuJoCo: a body with a free joint for each link, whose geoms its broad phase and its table of pair functions ask.
// Paper:   Todorov, Erez, Tassa, "MuJoCo: A physics engine for model-based control", IROS 2012. The library is MuJoCo
//          2.2: a model that its compiler makes, then mj_kinematics and mj_collision for each configuration.
// Departs: each link has a free joint in place of the robot's own joints, since the poses of links are given. Pairs of
//          bodies of which nothing is asked are excluded in the model; pairs of geoms are left out of the contacts.
// Fails:   a mesh is its convex hull, in floats, and a cavity counts as solid. Pairs without a function of their own are
//          asked by MPR, with a tolerance of 1e-6 m. The rotation of a link is rounded to a quaternion. A mesh without a
//          volume cannot be compiled. Of more than 5,000 contacts the others are not kept.
// Cost:    all contacts of each configuration, where one would do; allocates only when a model is bound.
#include <algorithm>
#include <array>
#include <cstring>
#include <locale>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "algorithms/configuration_query.h"
#include "algorithms/core/mesh/sole_shape.h"

#ifdef TOUCHSTONE_HAS_MUJOCO
#include <mujoco/mujoco.h>

namespace touchstone {
namespace {

// The model as MuJoCo's XML. Parts without points are left out.
class ModelText {
 public:
  explicit ModelText(const ConfigurationModel& model) : model_(model) {
    text_.imbue(std::locale::classic());
    text_.precision(17);
    // Masses are not used, and a thin shape may have too small a one.
    text_ << "<mujoco><compiler angle=\"radian\" boundmass=\"1e-3\" boundinertia=\"1e-3\"/>"
          << "<size nconmax=\"" << most_contacts << "\"/><asset>";
    for (std::uint32_t i = 0; i < model.parts.size(); ++i) write_mesh(i);
    text_ << "</asset><worldbody>";
    write_geoms(ModelPart::world);
    for (std::uint32_t link = 0; link < model.links; ++link) {
      text_ << "<body name=\"l" << link << "\"><freejoint/>"
            << "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>";
      write_geoms(link);
      text_ << "</body>";
    }
    text_ << "</worldbody><contact>";
    write_excluded();
    text_ << "</contact></mujoco>";
  }

  std::string text() const { return text_.str(); }
  // The part of each geom, in MuJoCo's order.
  const std::vector<std::uint32_t>& parts() const { return parts_; }

  static constexpr int most_contacts = 5'000;

 private:
  const std::vector<Vec3d>* vertices_of(std::uint32_t part) const {
    const ConcaveBody& body = model_.parts[part].body;
    if (body.mesh) return &body.mesh->vertices;
    const Shape* const shape = sole_shape(body);
    return shape != nullptr && shape->kind == ShapeKind::hull ? &shape->hull->vertices : nullptr;
  }

  void write_mesh(std::uint32_t part) {
    const std::vector<Vec3d>* const vertices = vertices_of(part);
    if (vertices == nullptr || model_.parts[part].body.part_count() == 0) return;
    text_ << "<mesh name=\"m" << part << "\" vertex=\"";
    for (const Vec3d& v : *vertices) text_ << v[0] << ' ' << v[1] << ' ' << v[2] << ' ';
    text_ << "\"/>";
  }

  void write_vector(const char* name, const Vec3d& v) {
    text_ << ' ' << name << "=\"" << v[0] << ' ' << v[1] << ' ' << v[2] << '"';
  }
  void write_rotation(const Mat3d& rotation) {
    const Eigen::Quaterniond q(rotation);
    text_ << " quat=\"" << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << '"';
  }

  void write_geoms(std::uint32_t link) {
    for (std::uint32_t i = 0; i < model_.parts.size(); ++i) {
      const ModelPart& part = model_.parts[i];
      if (part.link != link || part.body.part_count() == 0) continue;
      parts_.push_back(i);
      text_ << "<geom";
      if (vertices_of(i) != nullptr) {
        text_ << " type=\"mesh\" mesh=\"m" << i << '"';
        write_vector("pos", part.pose.translation);
        write_rotation(part.pose.rotation);
      } else {
        write_shape(*sole_shape(part.body), part.pose);
      }
      text_ << "/>";
    }
  }

  void write_shape(const Shape& shape, const Pose& pose) {
    const auto write = [&](const char* type, const Vec3d& size) {
      text_ << " type=\"" << type << '"';
      write_vector("size", size);
      write_vector("pos", pose.translation);
      write_rotation(pose.rotation);
    };
    const Vec3d round(shape.radius, shape.half_length, 0);
    switch (shape.kind) {
      case ShapeKind::sphere: return write("sphere", round);
      case ShapeKind::capsule: return write("capsule", round);
      case ShapeKind::cylinder: return write("cylinder", round);
      case ShapeKind::box: return write("box", shape.half_extents);
      case ShapeKind::ellipsoid: return write("ellipsoid", shape.radii);
      default: break;
    }
    // A plane without end is solid below its own z = 0.
    const Vec3d turned = pose.rotation * shape.normal;
    const Vec3d normal = turned.stableNormalized();
    const double height = normal.dot(pose.translation) + shape.offset / turned.stableNorm();
    text_ << " type=\"plane\" size=\"0 0 1\"";
    write_vector("pos", height * normal);
    write_rotation(Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), normal).toRotationMatrix());
  }

  // Pairs of bodies of which no part is asked.
  void write_excluded() {
    const std::size_t bodies = std::size_t{model_.links} + 1;  // the world is the last
    std::vector<char> asked(bodies * bodies, 0);
    const auto number = [&](std::uint32_t part) {
      return std::min<std::size_t>(model_.parts[part].link, model_.links);
    };
    for (const auto& [a, b] : model_.pairs) {
      const auto [low, high] = std::minmax({number(a), number(b)});
      asked[low * bodies + high] = 1;
    }
    for (std::size_t a = 0; a < bodies; ++a) {
      for (std::size_t b = a + 1; b < bodies; ++b) {
        if (asked[a * bodies + b] != 0) continue;
        text_ << "<exclude body1=\"l" << a << "\" body2=\"";
        if (b == model_.links) {
          text_ << "world\"/>";
        } else {
          text_ << 'l' << b << "\"/>";
        }
      }
    }
  }

  const ConfigurationModel& model_;
  std::ostringstream text_;
  std::vector<std::uint32_t> parts_;
};

struct Freed {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

std::unique_ptr<mjModel, Freed> compile(const std::string& text) {
  const auto files = std::make_unique<mjVFS>();  // megabytes
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "robot.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  std::array<char, 1000> fault{};
  std::unique_ptr<mjModel, Freed> model(
      mj_loadXML("robot.xml", files.get(), fault.data(), static_cast<int>(fault.size())));
  mj_deleteVFS(files.get());
  if (model == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + fault.data());
  return model;
}

class MujocoConfigurations final : public ConfigurationQuery {
 public:
  void bind(const ConfigurationModel& model) override {
    mju_user_warning = [](const char*) {
    };  // else MuJoCo writes MUJOCO_LOG.TXT into the current folder
    const ModelText text(model);
    part_of_ = text.parts();
    data_.reset();
    model_ = compile(text.text());
    data_.reset(mj_makeData(model_.get()));
    parts_ = model.parts.size();
    asked_.assign(parts_ * parts_, 0);
    for (const auto& [a, b] : model.pairs) asked_[a * parts_ + b] = 1;
  }

  void solve(ConfigurationTask task, const Configurations& configurations,
             std::span<ConfigurationAnswer> answers) override {
    if (task == ConfigurationTask::distance) {
      std::ranges::fill(answers, ConfigurationAnswer{});
      return;
    }
    answer_steps(task, configurations, answers,
                 [&](std::span<const Pose> links) { return find(links); });
  }

 private:
  ConfigurationAnswer find(std::span<const Pose> links) {
    mjData& data = *data_;
    for (std::size_t link = 0; link < links.size(); ++link) {
      mjtNum* const q = data.qpos + 7 * link;
      std::array<mjtNum, 9> rows{};
      for (int i = 0; i < 3; ++i) {
        q[i] = links[link].translation[i];
        for (int k = 0; k < 3; ++k)
          rows[static_cast<std::size_t>(3 * i + k)] = links[link].rotation(i, k);
      }
      mju_mat2Quat(q + 3, rows.data());
    }
    mj_kinematics(model_.get(), &data);
    mj_collision(model_.get(), &data);
    ConfigurationAnswer found;
    found.answer = Answer::separated;
    found.status = Status::not_reported;
    for (int i = 0; i < data.ncon; ++i) {
      const mjContact& contact = data.contact[i];
      const auto [a, b] = std::minmax(part_of_[static_cast<std::size_t>(contact.geom1)],
                                      part_of_[static_cast<std::size_t>(contact.geom2)]);
      if (contact.dist > 0 || asked_[a * parts_ + b] == 0) continue;
      found.answer = Answer::overlapping;
      found.pair = {a, b};
      return found;
    }
    if (data.ncon >= ModelText::most_contacts) {
      found.answer = Answer::unknown;
      found.status = Status::capacity;
    }
    return found;
  }

  std::unique_ptr<mjModel, Freed> model_;
  std::unique_ptr<mjData, Freed> data_;
  std::vector<std::uint32_t> part_of_;
  std::size_t parts_ = 0;
  std::vector<char> asked_;
};

std::unique_ptr<ConfigurationQuery> make(const ConfigurationSettings&) {
  return std::make_unique<MujocoConfigurations>();
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<ConfigurationEntry> peers_mujoco_configurations() {
  return {
      {.info = {.name = "mujoco-world",
                .citation = "MuJoCo 2.2: mj_collision of bodies with free joints",
                .origin = Origin::peer,
                .known_defect = "a mesh is its convex hull, in floats; MPR's tolerance is 1e-6 m"},
       .tasks = {ConfigurationTask::free, ConfigurationTask::motion},
       // MuJoCo has no cone, and its planes do not move.
       .supports =
           [](const ConfigurationModel& model) {
             return std::ranges::all_of(model.parts, [](const ModelPart& part) {
               if (part.body.mesh || part.body.part_count() == 0) return true;
               const Shape* const shape = sole_shape(part.body);
               if (shape == nullptr || shape->kind == ShapeKind::cone) return false;
               return shape->kind != ShapeKind::halfspace || part.link == ModelPart::world;
             });
           },
       .approximate = true,
       .make = make}};
}

}  // namespace touchstone::entries
