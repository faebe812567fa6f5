// The GJK in doubles of hint.h, with bounds on its rounding.
#include "algorithms/oracle/hint.h"

#include <cmath>
#include <limits>

namespace touchstone::oracle {
namespace {

constexpr int max_iterations = 64;
// Error bound of one coordinate of a difference, in the pair's unit.
constexpr double difference_error = 2 * GridCore::coordinate_error;

struct Simplex {
  int size = 0;
  std::array<DifferencePoint, 4> points;
  std::array<Vec3d, 4> at;
};

// The feature of a simplex that is nearest to the origin.
struct Nearest {
  bool inside = false;
  double distance = std::numeric_limits<double>::infinity();
  Vec3d direction =
      Vec3d::Zero();  // from the origin to the nearest point, or normal to its feature
  int size = 0;
  std::array<int, 3> vertices{};
  std::array<double, 3> weights{};  // of the nearest point; not negative, with any sum
};

class Search {
 public:
  explicit Search(const Simplex& simplex) : at_(simplex.at) {}
  Nearest best;

  void vertex(int i) {
    const double distance = at_[i].norm();
    if (distance < best.distance) best = {false, distance, at_[i], 1, {i, 0, 0}, {1, 0, 0}};
  }

  void segment(int i, int j) {
    if (at_[i].squaredNorm() > at_[j].squaredNorm()) std::swap(i, j);
    const Vec3d edge = at_[j] - at_[i];
    const double whole = edge.squaredNorm(), part = -at_[i].dot(edge);
    if (!(part > 0)) return vertex(i);
    if (!(part < whole)) return vertex(j);
    Vec3d direction = at_[i] + part / whole * edge;
    // A second projection removes the rounding along the edge, which would tilt a short direction.
    direction -= direction.dot(edge) / whole * edge;
    const double distance = direction.norm();
    if (distance < best.distance)
      best = {false, distance, direction, 2, {i, j, 0}, {whole - part, part, 0}};
  }

  void triangle(int i, int j, int k) {
    const Vec3d &a = at_[i], &b = at_[j], &c = at_[k];
    const Vec3d normal = (b - a).cross(c - a);
    const double square = normal.squaredNorm();
    const double of_i = normal.dot((c - b).cross(-b)), of_j = normal.dot((a - c).cross(-c)),
                 of_k = normal.dot((b - a).cross(-a));
    if (square > 0 && of_i > 0 && of_j > 0 && of_k > 0) {
      const double height = normal.dot(a);
      const double distance = std::abs(height) / std::sqrt(square);
      if (distance < best.distance) {
        best = {false, distance,  height < 0 ? Vec3d(-normal) : normal,
                3,     {i, j, k}, {of_i, of_j, of_k}};
      }
      return;
    }
    if (!(of_i > 0)) segment(j, k);
    if (!(of_j > 0)) segment(k, i);
    if (!(of_k > 0)) segment(i, j);
  }

  void tetrahedron() {
    static constexpr std::array<std::array<int, 4>, 4> faces = {
        {{1, 2, 3, 0}, {0, 3, 2, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}}};
    bool inside = true;
    for (const auto& [i, j, k, opposite] : faces) {
      const Vec3d normal = (at_[j] - at_[i]).cross(at_[k] - at_[i]);
      const double of_vertex = normal.dot(at_[opposite] - at_[i]);
      const double of_origin = -normal.dot(at_[i]);
      if (of_vertex > 0 ? of_origin > 0 : of_origin < 0) continue;
      inside = false;
      triangle(i, j, k);
    }
    if (inside) best.inside = true;
  }

 private:
  const std::array<Vec3d, 4>& at_;
};

Nearest reduce(Simplex& simplex) {
  Search search(simplex);
  switch (simplex.size) {
    case 1: search.vertex(0); break;
    case 2: search.segment(0, 1); break;
    case 3: search.triangle(0, 1, 2); break;
    default:
      search.tetrahedron();
      if (search.best.inside) return search.best;
  }
  const Nearest& best = search.best;
  const Simplex before = simplex;
  simplex.size = best.size;
  for (int i = 0; i < best.size; ++i) {
    simplex.points[i] = before.points[best.vertices[i]];
    simplex.at[i] = before.at[best.vertices[i]];
  }
  return best;
}

// Distance of a point that lies in the simplex for certain, whatever rounding did to the search.
double distance_of_point(const Simplex& simplex, const Nearest& nearest) {
  Vec3d point = Vec3d::Zero();
  double sum = 0;
  for (int i = 0; i < simplex.size; ++i) {
    point += nearest.weights[i] * simplex.at[i];
    sum += nearest.weights[i];
  }
  return point.norm() / sum;
}

// Returns true if the origin is inside, whatever rounding did to the points.
bool surely_inside(const Simplex& simplex, double filter_scale) {
  // A face's normal is made of differences of coordinates up to 10. Its components are off by less
  // than 40 times their error, and its products with a point by less than 3 * (10 * 40 + 200) times
  // that.
  const double bound = filter_scale * 1800 * difference_error;
  const auto& p = simplex.at;
  const auto volume = [](const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    return x.dot(y.cross(z));
  };
  const double v0 = volume(p[1], p[2], p[3]), v1 = -volume(p[0], p[2], p[3]),
               v2 = volume(p[0], p[1], p[3]), v3 = -volume(p[0], p[1], p[2]);
  return (v0 > bound && v1 > bound && v2 > bound && v3 > bound) ||
         (v0 < -bound && v1 < -bound && v2 < -bound && v3 < -bound);
}

}  // namespace

Hint find_hint(GridPair& pair, const Filters& filters, bool decide) {
  // Error bound of a sum of three products of coordinates up to 10 with a direction's components.
  const double plane_bound = filters.plane * 2 * GridCore::dot_error;
  const double radius_bound = filters.radius * 64 * difference_error;
  Hint hint;
  Simplex simplex;
  Nearest nearest;
  nearest.direction = pair.a.origin() - pair.b.origin();
  if (nearest.direction.isZero(0)) nearest.direction = Vec3d::UnitX();
  const auto finish = [&](Answer answer) {
    hint.answer = answer;
    hint.size = simplex.size;
    hint.points = simplex.points;
    return hint;
  };
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Vec3d direction = nearest.direction;
    const double greatest = direction.cwiseAbs().maxCoeff();
    if (!(greatest > 0)) break;
    direction /= greatest;
    const DifferencePoint point = {pair.a.support(-direction), pair.b.support(direction)};
    const Vec3d at = pair.rounded(point);
    const double along = direction.dot(at);
    // Support points of curved cores lie inside the cores, so they do not prove separation.
    if (decide && !pair.is_curved()) {
      const double margin = along - plane_bound;
      if (margin > 0 && (pair.radius == 0 || margin > (pair.radius + radius_bound) *
                                                          direction.norm() * (1 + 0x1p-40))) {
        return finish(Answer::separated);
      }
    }
    bool known = false;
    for (int i = 0; i < simplex.size; ++i) {
      known = known || simplex.points[i] == point || simplex.at[i] == at;
    }
    if (known) break;
    // The new point is no nearer than the simplex, up to rounding.
    if (simplex.size > 0 && !(direction.dot(simplex.at[0]) - along > 0x1p-52 * std::abs(along)))
      break;
    simplex.points[simplex.size] = point;
    simplex.at[simplex.size] = at;
    ++simplex.size;
    nearest = reduce(simplex);
    if (nearest.inside) {
      return finish(surely_inside(simplex, filters.tetrahedron) ? Answer::overlapping
                                                                : Answer::unknown);
    }
    if (decide && pair.radius > 0 &&
        distance_of_point(simplex, nearest) + radius_bound < pair.radius * (1 - 0x1p-40)) {
      return finish(Answer::overlapping);
    }
  }
  return finish(Answer::unknown);
}

}  // namespace touchstone::oracle
