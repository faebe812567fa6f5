// A module with a ray cast, a point query, a mesh algorithm, a cast and an algorithm of features. Each answers the easy
// part of its questions and says of all others that it cannot.
#include <touchstone_module.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Vector {
  double x, y, z;
};
Vector at(const double* p) { return {p[0], p[1], p[2]}; }
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(Vector a) { return std::sqrt(dot(a, a)); }

template <class Made, class Settings>
void* create(const Settings* /*settings*/) {
  return new Made{};
}
template <class Made>
void destroy(void* instance) {
  delete static_cast<Made*>(instance);
}

struct OnMesh {
  const TouchstoneModuleMesh* mesh = nullptr;
  Vector corner(std::size_t triangle, int i) const {
    return at(mesh->vertices +
              3 * std::size_t{mesh->triangles[3 * triangle + static_cast<std::size_t>(i)]});
  }
};
void bind_mesh(void* instance, const TouchstoneModuleMesh* mesh) {
  static_cast<OnMesh*>(instance)->mesh = mesh;
}

// --- rays: Moeller and Trumbore; what is near an edge, flat or oblique is not decided ---

void cast(void* instance, std::uint32_t, const TouchstoneModuleRay* rays, std::size_t count,
          TouchstoneModuleHit* hits) {
  const OnMesh& on = *static_cast<const OnMesh*>(instance);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector o = at(rays[i].origin), d = at(rays[i].direction);
    TouchstoneModuleHit found = {
        0, TOUCHSTONE_MODULE_OK, TOUCHSTONE_MODULE_NO_TRIANGLE, none, none, none};
    double second = INFINITY;
    if (!std::isfinite(dot(o, o) + dot(d, d)) || dot(d, d) == 0 || std::isnan(rays[i].t_max)) {
      found.status = TOUCHSTONE_MODULE_DEGENERATE;
    }
    for (std::size_t k = 0; k < on.mesh->triangle_count && found.status == TOUCHSTONE_MODULE_OK;
         ++k) {
      const Vector a = on.corner(k, 0), e = on.corner(k, 1) - a, f = on.corner(k, 2) - a;
      const Vector p = cross(d, f), s = o - a, q = cross(s, e);
      const double det = dot(e, p);
      constexpr double margin = 1e-6;
      if (!(std::abs(det) > margin * length(d) * length(e) * length(f))) {
        found.status = TOUCHSTONE_MODULE_DEGENERATE;
        break;
      }
      const double u = dot(s, p) / det, v = dot(d, q) / det, t = dot(f, q) / det;
      if (u < -margin || v < -margin || u + v > 1 + margin || t < -margin ||
          t > rays[i].t_max * (1 + margin))
        continue;
      if (u < margin || v < margin || u + v > 1 - margin || t < margin ||
          t > rays[i].t_max * (1 - margin)) {
        found.status = TOUCHSTONE_MODULE_DEGENERATE;
        break;
      }
      if (found.hit != 0 && t >= found.t) {
        second = std::min(second, t);
        continue;
      }
      if (found.hit != 0) second = std::min(second, found.t);
      found = {1, TOUCHSTONE_MODULE_OK, static_cast<std::uint32_t>(k), t, u, v};
    }
    if (found.status == TOUCHSTONE_MODULE_OK && found.hit != 0 &&
        second - found.t < 1e-6 * (1 + found.t)) {
      found.status = TOUCHSTONE_MODULE_DEGENERATE;
    }
    if (found.status != TOUCHSTONE_MODULE_OK) {
      found = {0, found.status, TOUCHSTONE_MODULE_NO_TRIANGLE, none, none, none};
    }
    hits[i] = found;
  }
}

// --- points: those whose nearest point is inside of a face ---

void query(void* instance, std::uint32_t, const double* points, std::size_t count,
           TouchstoneModulePointAnswer* answers) {
  const OnMesh& on = *static_cast<const OnMesh*>(instance);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector p = at(points + 3 * i);
    TouchstoneModulePointAnswer best = {TOUCHSTONE_MODULE_OK,
                                        TOUCHSTONE_MODULE_SIDE_UNKNOWN,
                                        TOUCHSTONE_MODULE_NO_TRIANGLE,
                                        INFINITY,
                                        {none, none, none}};
    double nearest_corner = INFINITY;
    for (std::size_t k = 0; k < on.mesh->triangle_count; ++k) {
      const Vector a = on.corner(k, 0), b = on.corner(k, 1), c = on.corner(k, 2),
                   n = cross(b - a, c - a);
      // No point of the triangle is nearer than its plane; one beside it is at a corner or an edge.
      const double area = dot(n, n);
      if (!(area > 1e-6 * dot(b - a, b - a) * dot(c - a, c - a))) nearest_corner = 0;  // a sliver
      const double height = dot(p - a, n) / std::sqrt(area);
      const Vector foot = p - (height / std::sqrt(area)) * n;
      const double u = dot(cross(b - a, foot - a), n) / area,
                   v = dot(cross(c - b, foot - b), n) / area;
      const double w = 1 - u - v;
      if (!(u > 0 && v > 0 && w > 0)) {
        nearest_corner = std::min(nearest_corner, std::abs(height));
        continue;
      }
      if (std::abs(height) < best.distance) {
        best.distance = std::abs(height);
        best.triangle = static_cast<std::uint32_t>(k);
        best.closest[0] = foot.x, best.closest[1] = foot.y, best.closest[2] = foot.z;
      }
    }
    const bool is_sure = best.distance * (1 + 1e-9) < nearest_corner;
    if (!is_sure || !std::isfinite(best.distance)) {
      best = {TOUCHSTONE_MODULE_NOT_CONVERGED,
              TOUCHSTONE_MODULE_SIDE_UNKNOWN,
              TOUCHSTONE_MODULE_NO_TRIANGLE,
              none,
              {none, none, none}};
    }
    answers[i] = best;
  }
}

// --- meshes: apart along an axis of the world ---

struct Meshes {
  const TouchstoneModuleMesh* const* bodies = nullptr;
};

struct Range {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  void add(Vector p) {
    const double x[3] = {p.x, p.y, p.z};
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
  }
  bool is_apart(const Range& other) const {
    for (int i = 0; i < 3; ++i) {
      const double slack = 1e-9 * (std::abs(high[i]) + std::abs(low[i]) + std::abs(other.high[i]) +
                                   std::abs(other.low[i]));
      if (low[i] > other.high[i] + slack || other.low[i] > high[i] + slack) return true;
    }
    return false;
  }
};

Range range_of(const TouchstoneModuleMesh& mesh, const TouchstoneModulePose& pose) {
  Range range;
  for (std::size_t i = 0; i < mesh.vertex_count; ++i) {
    const double* v = mesh.vertices + 3 * i;
    Vector p = at(pose.translation);
    for (int column = 0; column < 3; ++column) p = p + v[column] * at(pose.rotation + 3 * column);
    range.add(p);
  }
  return range;
}

void solve_meshes(void* instance, std::uint32_t, std::uint32_t a,
                  const TouchstoneModulePose* pose_a, std::uint32_t b,
                  const TouchstoneModulePose* pose_b, TouchstoneModuleOutcome* outcome,
                  TouchstoneModuleSink*) {
  const Meshes& mine = *static_cast<const Meshes*>(instance);
  touchstone_module_clear(outcome);
  outcome->status = TOUCHSTONE_MODULE_NOT_CONVERGED;
  if (!range_of(*mine.bodies[a], *pose_a).is_apart(range_of(*mine.bodies[b], *pose_b))) return;
  outcome->answer = TOUCHSTONE_MODULE_SEPARATED;
  outcome->status = TOUCHSTONE_MODULE_OK;
}

// --- casts of spheres: a quadratic equation ---

struct Balls {
  const TouchstoneModuleShape* const* shapes = nullptr;
};

void solve_casts(void* instance, const TouchstoneModuleCastBatch* batch,
                 TouchstoneModuleCastOutcome* outcomes) {
  const Balls& mine = *static_cast<const Balls*>(instance);
  for (std::size_t i = 0; i < batch->count; ++i) {
    const auto a = batch->first[i], b = batch->second[i];
    const double sum =
        mine.shapes[batch->shape_of[a]]->radius + mine.shapes[batch->shape_of[b]]->radius;
    const Vector p = at(batch->poses[b].translation) - at(batch->poses[a].translation);
    const Vector d = at(batch->motions[b].displacement) - at(batch->motions[a].displacement);
    TouchstoneModuleCastOutcome out = {TOUCHSTONE_MODULE_CAST_UNKNOWN,
                                       TOUCHSTONE_MODULE_NOT_CONVERGED,
                                       none,
                                       none,
                                       none,
                                       {none, none, none},
                                       {none, none, none},
                                       -1};
    const double speed = dot(d, d), along = dot(p, d);
    const double best = speed > 0 ? std::clamp(-along / speed, 0.0, 1.0) : 0.0;
    const double gap = length(p + best * d) - sum, size = length(p) + sum + length(d);
    if (gap > 1e-9 * size) {
      out.answer = TOUCHSTONE_MODULE_MISS;
      out.status = TOUCHSTONE_MODULE_OK;
    } else if (gap < -1e-3 * size && length(p) > sum && along < 0) {
      const double excess = dot(p, p) - sum * sum;
      out.toi = excess / (-along + std::sqrt(along * along - speed * excess));
      const Vector now = p + out.toi * d, n = (1 / length(now)) * now;
      const Vector touch = at(batch->poses[a].translation) +
                           out.toi * at(batch->motions[a].displacement) +
                           mine.shapes[batch->shape_of[a]]->radius * n;
      out.normal[0] = n.x, out.normal[1] = n.y, out.normal[2] = n.z;
      out.point[0] = touch.x, out.point[1] = touch.y, out.point[2] = touch.z;
      out.answer = TOUCHSTONE_MODULE_HIT;
      out.status = TOUCHSTONE_MODULE_OK;
    }
    outcomes[i] = out;
  }
}

// --- features: apart along an axis during the whole motion ---

void solve_features(void*, std::uint32_t pair, const TouchstoneModuleFeatures* queries,
                    std::size_t count, TouchstoneModuleFeatureOutcome* outcomes) {
  const int first = pair == TOUCHSTONE_MODULE_VERTEX_FACE ? 1 : 2;
  for (std::size_t i = 0; i < count; ++i) {
    Range a, b;
    for (int k = 0; k < 4; ++k) {
      (k < first ? a : b).add(at(queries[i].start[k]));
      (k < first ? a : b).add(at(queries[i].end[k]));
    }
    const bool is_apart = a.is_apart(b);
    outcomes[i] = {static_cast<std::uint8_t>(is_apart ? TOUCHSTONE_MODULE_MISS
                                                      : TOUCHSTONE_MODULE_CAST_UNKNOWN),
                   static_cast<std::uint8_t>(is_apart ? TOUCHSTONE_MODULE_OK
                                                      : TOUCHSTONE_MODULE_NOT_CONVERGED),
                   none,
                   none,
                   none,
                   -1};
  }
}

template <class Table, class Made, class Settings>
Table table_of(const char* name) {
  Table table{};
  table.struct_size = sizeof table;
  table.name = name;
  table.citation = "a test";
  table.create = create<Made, Settings>;
  table.destroy = destroy<Made>;
  return table;
}

}  // namespace

const TouchstoneModule* touchstone_module(std::uint32_t) {
  static const auto rays = [] {
    auto table = table_of<TouchstoneModuleRays, OnMesh, TouchstoneModuleRaySettings>("easy");
    table.tasks = TOUCHSTONE_MODULE_CLOSEST_HIT | TOUCHSTONE_MODULE_ANY_HIT;
    table.scalars = TOUCHSTONE_MODULE_DOUBLE;
    table.bind = bind_mesh;
    table.cast = cast;
    return table;
  }();
  static const auto points = [] {
    auto table = table_of<TouchstoneModulePoints, OnMesh, TouchstoneModulePointSettings>("easy");
    table.tasks = TOUCHSTONE_MODULE_CLOSEST_POINT;
    table.scalar = TOUCHSTONE_MODULE_DOUBLE;
    table.bind = bind_mesh;
    table.query = query;
    return table;
  }();
  static const auto meshes = [] {
    auto table = table_of<TouchstoneModuleMeshes, Meshes, TouchstoneModuleMeshSettings>("easy");
    table.tasks = TOUCHSTONE_MODULE_MESH_INTERSECT;
    table.scalars = TOUCHSTONE_MODULE_DOUBLE;
    table.takes_solid = 1;
    table.bind = [](void* instance, const TouchstoneModuleMesh* const* bodies, std::size_t) {
      static_cast<Meshes*>(instance)->bodies = bodies;
    };
    table.solve = solve_meshes;
    return table;
  }();
  static const auto casts = [] {
    auto table = table_of<TouchstoneModuleCasts, Balls, TouchstoneModuleCastSettings>("easy");
    table.scalars = TOUCHSTONE_MODULE_DOUBLE;
    table.supports = [](std::uint32_t a, std::uint32_t b, int turns) {
      return a == TOUCHSTONE_MODULE_SPHERE && b == TOUCHSTONE_MODULE_SPHERE && turns == 0 ? 1 : 0;
    };
    table.bind = [](void* instance, const TouchstoneModuleShape* const* shapes, std::size_t) {
      static_cast<Balls*>(instance)->shapes = shapes;
    };
    table.solve = solve_casts;
    return table;
  }();
  static const auto features = [] {
    auto table =
        table_of<TouchstoneModuleFeaturePairs, Balls, TouchstoneModuleFeatureSettings>("easy");
    table.solve = solve_features;
    return table;
  }();
  static const TouchstoneModuleRays* const of_rays[] = {&rays, nullptr};
  static const TouchstoneModulePoints* const of_points[] = {&points, nullptr};
  static const TouchstoneModuleMeshes* const of_meshes[] = {&meshes, nullptr};
  static const TouchstoneModuleCasts* const of_casts[] = {&casts, nullptr};
  static const TouchstoneModuleFeaturePairs* const of_features[] = {&features, nullptr};
  static const TouchstoneModule offer = {sizeof(TouchstoneModule),
                                         TOUCHSTONE_MODULE_ABI,
                                         nullptr,
                                         nullptr,
                                         of_rays,
                                         of_points,
                                         of_meshes,
                                         of_casts,
                                         of_features};
  return &offer;
}
