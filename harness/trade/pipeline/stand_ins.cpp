// Makes and keeps the representations of bodies.
#include "harness/trade/pipeline/stand_ins.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "algorithms/core/bounds.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/geometry/concave_bodies.h"

namespace touchstone::trade {
namespace {

constexpr std::size_t most_error_bodies = 48;

bool is_plain(const Pose& pose) {
  return pose.rotation == Mat3d::Identity() && pose.translation == Vec3d::Zero();
}

// Appends the corners of a box or a hull, in the body's frame; other shapes have none.
bool append_corners(const proxies::Part& part, std::vector<Vec3d>& corners) {
  if (part.shape.kind == ShapeKind::hull) {
    for (const Vec3d& vertex : part.shape.hull->vertices) corners.push_back(part.pose(vertex));
    return true;
  }
  if (part.shape.kind != ShapeKind::box) return false;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3d at = part.shape.half_extents;
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) == 0) at[axis] = -at[axis];
    }
    corners.push_back(part.pose(at));
  }
  return true;
}

// Many flat-sided parts become the hull of all, so that the body's box costs as much as a hull's.
std::vector<proxies::Part> outline_of(const std::vector<proxies::Part>& parts,
                                      std::int64_t& hulls) {
  if (parts.size() == 1) return parts;
  std::vector<Vec3d> corners;
  for (const proxies::Part& part : parts) {
    if (!append_corners(part, corners)) return parts;
  }
  ++hulls;
  proxies::Part outline;
  outline.shape.kind = ShapeKind::hull;
  outline.shape.hull = make_reduced_hull(corners);
  return {outline};
}

double reach_of(const std::vector<proxies::Part>& parts) {
  // Attitudes are orthonormal up to rounding only.
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  double reach = 0;
  for (const proxies::Part& part : parts) {
    const double from = parts.size() == 1 ? 0 : part.pose.translation.norm();
    reach = std::max(reach, from + loose_reach(part.shape, part.pose.rotation));
  }
  return reach * (1 + rounding);
}

bool same_shape(const Shape& a, const Shape& b) {
  return a.kind == b.kind && a.radius == b.radius && a.half_length == b.half_length &&
         a.half_extents == b.half_extents && a.radii == b.radii && a.hull == b.hull &&
         a.normal == b.normal && a.offset == b.offset;
}

}  // namespace

StandIn::StandIn(std::vector<proxies::Part> from, const Shape& body)
    : parts(std::move(from)), tree(parts), plain(parts.size() == 1 && is_plain(parts[0].pose)) {
  for (const proxies::Part& part : parts) {
    if (part.shape.kind == ShapeKind::hull && part.shape.hull != body.hull) ++hulls;
  }
  outline = outline_of(parts, hulls);
  reach = parts[0].shape.kind == ShapeKind::halfspace ? 0 : reach_of(parts);
}

StandInLibrary::StandInLibrary(const SceneFrames& frames, Representing representing, double seconds)
    : frames_(&frames), representing_(std::move(representing)), most_seconds_(seconds) {}

proxies::Representation StandInLibrary::wanted(const Representations& representations,
                                               std::size_t body) const {
  const Shape& shape = frames_->scene->shapes[frames_->scene->bodies[body].shape];
  if (shape.kind == ShapeKind::halfspace) return {};
  return representations.of[frames_->kind_of(body)].value_or(proxies::Representation{});
}

Representations StandInLibrary::complete(Representations representations) const {
  std::array<bool, body_kinds> present{};
  for (std::size_t body = 0; body < frames_->scene->bodies.size(); ++body) {
    present[frames_->kind_of(body)] = true;
  }
  present[static_cast<std::size_t>(ShapeKind::halfspace)] = false;
  for (std::size_t kind = 0; kind < body_kinds; ++kind) {
    std::optional<proxies::Representation>& of = representations.of[kind];
    if (!present[kind]) of.reset();
    if (present[kind] && (!of || is_the_body(of->form, kind))) of.emplace();
  }
  return representations;
}

StandInLibrary::Made& StandInLibrary::made(std::uint32_t shape,
                                           const proxies::Representation& representation) {
  const auto [place, fresh] = made_.try_emplace({shape, to_string(representation)});
  Made& made = place->second;
  if (!fresh) return made;
  const Shape& given = frames_->scene->shapes[shape];
  const base::Stopwatch watch;
  try {
    std::vector<proxies::Part> parts =
        representation.form == proxies::Form::as_given
            ? std::vector<proxies::Part>{{given, {}}}
            : representing_.represent(given, frames_->mesh_of[shape], representation);
    made.stand_in = std::make_shared<StandIn>(std::move(parts), given);
  } catch (const base::InputError& error) {
    made.fault = error.what();
  }
  made.seconds = watch.seconds();
  return made;
}

std::shared_ptr<const StandIns> StandInLibrary::get(const Representations& representations) {
  std::shared_ptr<const StandIns>& whole = whole_[representations.name()];
  if (whole != nullptr) return whole;
  const scene::Scene& scene = *frames_->scene;
  auto all = std::make_shared<StandIns>();
  all->first.push_back(0);
  // For each representation, the shapes of its parts.
  std::map<const StandIn*, std::vector<std::uint32_t>> shapes_of;
  std::array<int, all_shape_kinds.size()> bodies_with{};
  double spent = 0;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    const Made& one = made(scene.bodies[body].shape, wanted(representations, body));
    if (one.stand_in == nullptr) throw base::InputError(one.fault);
    const StandIn& stand_in = *one.stand_in;
    auto [numbers, fresh] = shapes_of.try_emplace(&stand_in);
    if (fresh) {
      spent += one.seconds;
      if (spent > most_seconds_) {
        throw base::InputError(fmt::format("takes more than {:.3g} s to make", most_seconds_));
      }
      all->kept_.push_back(one.stand_in);
      all->hulls += stand_in.hulls;
      for (const proxies::Part& part : stand_in.parts) {
        // Parts of one body are often equal.
        const std::size_t from = all->shapes.size() - std::min<std::size_t>(all->shapes.size(), 4);
        std::size_t at = from;
        while (at < all->shapes.size() && !same_shape(all->shapes[at], part.shape)) ++at;
        if (at == all->shapes.size()) all->shapes.push_back(part.shape);
        numbers->second.push_back(static_cast<std::uint32_t>(at));
      }
    }
    all->of.push_back(&stand_in);
    all->plain = all->plain && stand_in.plain;
    all->single = all->single && stand_in.parts.size() == 1;
    all->shape_of.insert(all->shape_of.end(), numbers->second.begin(), numbers->second.end());
    all->first.push_back(static_cast<std::uint32_t>(all->shape_of.size()));
    std::set<ShapeKind> kinds;
    for (const proxies::Part& part : stand_in.parts) kinds.insert(part.shape.kind);
    for (const ShapeKind kind : kinds) {
      // Each kind is paired with the kinds of the bodies before it.
      for (const ShapeKind other : all_shape_kinds) {
        if (bodies_with[static_cast<std::size_t>(other)] == 0) continue;
        const std::pair pair = std::minmax(kind, other);
        if (std::ranges::find(all->kind_pairs, std::pair<ShapeKind, ShapeKind>(pair)) ==
            all->kind_pairs.end()) {
          all->kind_pairs.emplace_back(pair);
        }
      }
    }
    for (const ShapeKind kind : kinds) ++bodies_with[static_cast<std::size_t>(kind)];
  }
  whole = std::move(all);
  return whole;
}

std::vector<proxies::RepresentationError> StandInLibrary::errors(
    const Representations& representations) {
  std::vector<proxies::RepresentationError> errors;
  const scene::Scene& scene = *frames_->scene;
  const base::Stopwatch watch;
  const std::size_t step = (scene.bodies.size() + most_error_bodies - 1) / most_error_bodies;
  for (std::size_t body = 0; body < scene.bodies.size(); body += step) {
    const std::uint32_t shape = scene.bodies[body].shape;
    if (scene.shapes[shape].kind == ShapeKind::halfspace) continue;
    const proxies::Representation representation = wanted(representations, body);
    Made& one = made(shape, representation);
    if (!one.has_error) {
      if (!errors.empty() && watch.seconds() > most_seconds_) break;
      const geometry::Mesh* mesh = frames_->mesh_of[shape];
      if (representation.form != proxies::Form::as_given) {
        try {
          one.error = representing_.error(scene.shapes[shape], mesh, one.stand_in->parts);
        } catch (const base::InputError&) {
          one.is_measured = false;
        }
      }
      one.has_error = true;
    }
    if (one.is_measured) errors.push_back(one.error);
  }
  return errors;
}

double StandInLibrary::seconds(const Representations& representations) const {
  std::set<Key> counted;
  double sum = 0;
  for (std::size_t body = 0; body < frames_->scene->bodies.size(); ++body) {
    const Key key = {frames_->scene->bodies[body].shape, to_string(wanted(representations, body))};
    if (!counted.insert(key).second) continue;
    const auto found = made_.find(key);
    if (found != made_.end()) sum += found->second.seconds;
  }
  return sum;
}

std::int64_t StandInLibrary::hulls() const {
  std::int64_t hulls = 0;
  for (const auto& [key, made] : made_) {
    if (made.stand_in != nullptr) hulls += made.stand_in->hulls;
  }
  return hulls;
}

std::vector<ConcaveBody> whole_bodies(const SceneFrames& frames, const StandIns& stand_ins,
                                      const Configuration& configuration) {
  const scene::Scene& scene = *frames.scene;
  std::vector<ConcaveBody> bodies(scene.shapes.size());
  std::vector<char> made(scene.shapes.size(), 0);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::uint32_t shape = scene.bodies[i].shape;
    if (made[shape] != 0) continue;
    made[shape] = 1;
    ConcaveBody& body = bodies[shape];
    const geometry::Mesh* mesh = frames.mesh_of[shape];
    const auto& wanted = configuration.representations.of[frames.kind_of(i)];
    const bool is_mesh =
        !wanted || wanted->form == proxies::Form::mesh || wanted->form == proxies::Form::as_given;
    if (mesh != nullptr && is_mesh) {
      const bool closed = !geometry::open_edge(mesh->vertices, mesh->triangles);
      body.mesh = std::make_shared<const TriangleMesh>(
          TriangleMesh{mesh->vertices, mesh->triangles, closed});
      continue;
    }
    for (const proxies::Part& part : stand_ins.of[i]->parts) {
      body.parts.push_back({part.shape, part.pose});
    }
  }
  return bodies;
}

}  // namespace touchstone::trade
