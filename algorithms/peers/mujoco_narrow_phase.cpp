// MuJoCo's table of pair functions: closed forms, its test of two boxes, and libccd's MPR.
// Paper:   Todorov, Erez, Tassa, "MuJoCo: A physics engine for model-based control", IROS 2012; MPR
//          of Snethen, Game Programming Gems 7, 2008, by libccd over MuJoCo's support functions.
// Departs: no model is compiled: the functions read no more of a model than the shapes of its geoms
//          and MPR's options, and no more of its state than their poses, so the adapter fills in
//          two geoms for each query. A hull is a mesh about the mean of its vertices, in floats,
//          and without the graph that MuJoCo climbs: MuJoCo scans all vertices, and supports no
//          pair of a hull and a plane, which is its half-space. The deepest contact is reported.
//          tolerance and max_iterations are MPR's; the defaults are MuJoCo's, 1e-6 m and 50.
//          Witness points are not reported: MuJoCo gives their middle.
// Fails:   two boxes: half of the depth where a face is hit, because that is what MuJoCo puts in a
//          contact. MPR's depth is along the portal, an upper bound. A cylinder that stands on a
//          plane may have no contact. No query reports a failure.
// Cost:    closed forms O(1); otherwise a support call of both bodies an iteration.
#include "algorithms/narrow_phase.h"

#ifdef TOUCHSTONE_HAS_MUJOCO
#include <mujoco/mujoco.h>

#include <algorithm>
#include <utility>

#include "algorithms/core/bounds.h"

namespace touchstone {
namespace {

// MuJoCo has no cone and no function for two planes; its function for a mesh and a plane needs the
// graph.
bool supports(ShapeKind kind_a, ShapeKind kind_b, Task) {
  const bool cone = kind_a == ShapeKind::cone || kind_b == ShapeKind::cone;
  return !cone && (kind_a < ShapeKind::hull || kind_b != ShapeKind::halfspace);
}

Encoding encoding(ShapeKind kind_a, ShapeKind kind_b, Task, Precision) {
  const bool mesh = kind_a == ShapeKind::hull || kind_b == ShapeKind::hull;
  return mesh ? Encoding::float32_relative : Encoding::relative;
}

mjtGeom type_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere: return mjGEOM_SPHERE;
    case ShapeKind::capsule: return mjGEOM_CAPSULE;
    case ShapeKind::box: return mjGEOM_BOX;
    case ShapeKind::cylinder: return mjGEOM_CYLINDER;
    case ShapeKind::ellipsoid: return mjGEOM_ELLIPSOID;
    case ShapeKind::hull: return mjGEOM_MESH;
    default: return mjGEOM_PLANE;
  }
}

Vec3d size_of(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::box: return shape.half_extents;
    case ShapeKind::ellipsoid: return shape.radii;
    default: return {shape.radius, shape.half_length, 0};
  }
}

class Mujoco final : public NarrowPhase {
 public:
  explicit Mujoco(const NarrowPhaseSettings& settings) : tolerance_(settings.tolerance) {
    mj_defaultOption(&model_.opt);
    if (settings.max_iterations) model_.opt.mpr_iterations = *settings.max_iterations;
    model_.ngeom = 2;
    model_.geom_type = types_.data();
    model_.geom_dataid = meshes_.data();
    model_.geom_size = sizes_.data();
    data_.geom_xpos = positions_.data();
    data_.geom_xmat = rotations_.data();
  }

  void bind(std::span<const Shape> shapes) override {
    shapes_ = shapes;
    vertices_.clear();
    mesh_begin_.clear();
    mesh_size_.clear();
    centres_.clear();
    for (const Shape& shape : shapes) {
      const Vec3d centre = encoding_centre(shape);
      centres_.push_back(centre);
      mesh_begin_.push_back(static_cast<int>(vertices_.size() / 3));
      mesh_size_.push_back(0);
      if (shape.kind != ShapeKind::hull) continue;
      mesh_size_.back() = static_cast<int>(shape.hull->vertices.size());
      for (const Vec3d& vertex : shape.hull->vertices) {
        for (int k = 0; k < 3; ++k) vertices_.push_back(static_cast<float>(vertex[k] - centre[k]));
      }
    }
    mesh_graph_.assign(shapes.size(), -1);
    model_.nmesh = static_cast<int>(shapes.size());
    model_.mesh_vert = vertices_.data();
    model_.mesh_vertadr = mesh_begin_.data();
    model_.mesh_vertnum = mesh_size_.data();
    model_.mesh_graphadr = mesh_graph_.data();
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    const bool rounds = encoding(batch.kind_a, batch.kind_b, task, Precision::float64) ==
                        Encoding::float32_relative;
    // The table holds each pair only in the order of MuJoCo's types.
    const mjtGeom type_a = type_of(batch.kind_a), type_b = type_of(batch.kind_b);
    const bool swapped = type_a > type_b;
    const mjfCollision collide =
        mjCOLLISIONFUNC[std::min(type_a, type_b)][std::max(type_a, type_b)];
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
      const std::uint32_t a = batch.pairs.shape_of[first], b = batch.pairs.shape_of[second];
      const Pose &pose_a = batch.pairs.poses[first], &pose_b = batch.pairs.poses[second];
      Vec3d origin;
      const Vec3d offset = offset_between(pose_a, centres_[a], pose_b, centres_[b], origin);
      if (tolerance_) {
        model_.opt.mpr_tolerance = *tolerance_ * (loose_reach(shapes_[a], pose_a.rotation) +
                                                  loose_reach(shapes_[b], pose_b.rotation));
      }
      place(0, a, pose_a.rotation, Vec3d::Zero(), rounds);
      if (batch.kind_b == ShapeKind::halfspace) {
        place_plane(shapes_[b], pose_b.rotation, offset);
      } else {
        place(1, b, pose_b.rotation, offset, rounds);
      }
      const int count =
          collide(&model_, &data_, contacts_.data(), swapped ? 1 : 0, swapped ? 0 : 1, 0);
      report(std::span(contacts_).first(static_cast<std::size_t>(count)), swapped, task,
             outcomes[i]);
    }
  }

 private:
  // Rounds MuJoCo's doubles too if the vertices are rounded, so that all numbers of a problem have
  // one encoding.
  static double number(double x, bool rounds) {
    return rounds ? static_cast<double>(static_cast<float>(x)) : x;
  }

  void place(std::size_t geom, std::uint32_t shape, const Mat3d& rotation, const Vec3d& position,
             bool rounds) {
    const Vec3d size = size_of(shapes_[shape]);
    types_[geom] = type_of(shapes_[shape].kind);
    const bool mesh = types_[geom] == mjGEOM_MESH;
    meshes_[geom] = mesh ? static_cast<int>(shape) : -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      sizes_[3 * geom + k] = number(size[row], rounds);
      positions_[3 * geom + k] = number(position[row], rounds);
      for (std::size_t l = 0; l < 3; ++l) {
        const double entry = rotation(row, static_cast<Eigen::Index>(l));
        rotations_[9 * geom + 3 * k + l] = number(entry, rounds);
      }
    }
  }

  // Places a plane, which is solid below z = 0. `offset` leads from the origin to the origin of the
  // half-space's body.
  void place_plane(const Shape& shape, const Mat3d& rotation, const Vec3d& offset) {
    const Vec3d turned = rotation * shape.normal;
    const Vec3d normal = turned.stableNormalized();
    const Vec3d across = normal.unitOrthogonal();
    const double height = normal.dot(offset) + shape.offset / turned.stableNorm();
    Mat3d frame;
    frame << across, normal.cross(across), normal;
    types_[1] = mjGEOM_PLANE;
    meshes_[1] = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      sizes_[3 + k] = 0;
      positions_[3 + k] = height * normal[row];
      for (std::size_t l = 0; l < 3; ++l) {
        rotations_[9 + 3 * k + l] = frame(row, static_cast<Eigen::Index>(l));
      }
    }
  }

  static void report(std::span<const mjContact> contacts, bool swapped, Task task,
                     Outcome& outcome) {
    outcome.status = Status::not_reported;
    outcome.iterations = outcome.support_calls = -1;
    outcome.answer = contacts.empty() ? Answer::separated : Answer::overlapping;
    if (contacts.empty() || task != Task::penetration) return;
    const mjContact& deepest = *std::ranges::min_element(contacts, {}, &mjContact::dist);
    clear_numbers(outcome);
    outcome.distance = deepest.dist;
    outcome.normal = Vec3d(deepest.frame[0], deepest.frame[1], deepest.frame[2]);
    if (swapped) outcome.normal = -outcome.normal;
  }

  std::optional<double> tolerance_;
  std::span<const Shape> shapes_;
  std::vector<Vec3d> centres_;
  std::vector<float> vertices_;
  std::vector<int> mesh_begin_, mesh_size_, mesh_graph_;
  // Data of the two geoms; matrices row by row.
  std::array<int, 2> types_{}, meshes_{};
  std::array<mjtNum, 6> sizes_{}, positions_{};
  std::array<mjtNum, 18> rotations_{};
  mjModel model_{};
  mjData data_{};
  std::array<mjContact, mjMAXCONPAIR> contacts_;
};

std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  return std::make_unique<Mujoco>(settings);
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_mujoco_narrow_phase() {
  return {{.info = {.name = "mujoco",
                    .citation = "MuJoCo 2.2, the functions of mjCOLLISIONFUNC",
                    .origin = Origin::peer,
                    .known_defect = "two boxes: half of the depth; MPR: the depth is along the "
                                    "portal, an upper bound"},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = {Precision::float64},
           .supports = supports,
           .traits = {.depth_is_bound = true},
           .encoding = encoding,
           .tolerance = "MPR's: how far the surface is beyond the portal; 1e-6 m",
           .make = make}};
}

}  // namespace touchstone::entries
