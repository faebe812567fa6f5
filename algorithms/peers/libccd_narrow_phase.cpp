// libccd: GJK, GJK with EPA, and MPR (XenoCollide), over our own support functions.
// Paper:   D. Fiser, libccd 2.1; GJK of Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation
//          1988; EPA of van den Bergen, GDC 2001; MPR of Snethen, Game Programming Gems 7, 2008.
// Departs: libccd has no shapes, so the support functions are here: they are those of the affine
//          image of the body under its pose, with balls not deformed; hulls are scanned from end to
//          end. libccd works in world coordinates, and it has neither a distance query nor
//          half-spaces. max_iterations (1000 by default): GJK does not report that its cap has
//          ended a query, and the loops of EPA and MPR have none. So the adapter counts support
//          points (for EPA and MPR over all loops of the query together); past the cap the support
//          functions return points far behind, which end each loop, and the status is
//          not_converged. tolerance reaches MPR as a length, and EPA as its square, which is what
//          EPA compares; the default is libccd's 1e-4. GJK has none to set: it uses 2^-52,
//          absolute. Witness points are not reported: libccd gives one point, an average.
// Fails:   GJK: overlap for gaps below about 1e-8 m; wrong at millimetre scale and far below. EPA:
//          too shallow, at worst 1e-8 for deep hulls, as it replaces one face at a time instead of
//          removing all that the new point sees. MPR: the depth is along the portal and so an upper
//          bound. libccd's -1 stands for "separated" and for "gave up": the status is not_reported.
// Cost:    one support call of both bodies an iteration; EPA allocates its polytope in each query.
#include <cmath>

#include "algorithms/core/bounds.h"
#include "algorithms/narrow_phase.h"

#ifdef TOUCHSTONE_HAS_LIBCCD
#include <ccd/ccd.h>

namespace touchstone {
namespace {

enum class Method : std::uint8_t { gjk, epa, mpr };

constexpr long default_max_iterations = 1000;

// The support calls of a query and their limit; a support point takes two calls, one a body.
struct Query {
  long calls = 0;
  long limit = 0;  // greatest number of calls
  long support_points() const { return calls / 2; }
  bool stopped() const { return calls > limit; }
};

// The object that libccd passes to the support functions.
struct Body {
  const Shape* shape;
  const Pose* pose;
  Vec3d center;  // an interior point, in body coordinates
  Query* query;
};

const Body& body_of(const void* object) { return *static_cast<const Body*>(object); }
Vec3d to_eigen(const ccd_vec3_t& v) { return {v.v[0], v.v[1], v.v[2]}; }
void set(ccd_vec3_t* out, const Vec3d& v) { ccdVec3Set(out, v.x(), v.y(), v.z()); }

// Zero if the direction is zero or NaN, so that the support stays a point of the body.
template <class Direction>
Direction normalized_or_zero(const Direction& direction) {
  const double norm = direction.norm();
  return norm > 0 ? Direction(direction / norm) : Direction(Direction::Zero());
}

Vec3d on_disk(double radius, const Vec3d& direction, double z) {
  const Eigen::Vector2d rim = radius * normalized_or_zero(Eigen::Vector2d(direction.head<2>()));
  return {rim.x(), rim.y(), z};
}

// The furthest point of the shape's core (without the ball), in body coordinates.
template <ShapeKind kind>
Vec3d core_support(const Shape& shape, const Vec3d& direction) {
  if constexpr (kind == ShapeKind::sphere) {
    return Vec3d::Zero();
  } else if constexpr (kind == ShapeKind::capsule) {
    return {0, 0, std::copysign(shape.half_length, direction.z())};
  } else if constexpr (kind == ShapeKind::box) {
    return (direction.array() < 0).select(-shape.half_extents, shape.half_extents);
  } else if constexpr (kind == ShapeKind::cylinder) {
    return on_disk(shape.radius, direction, std::copysign(shape.half_length, direction.z()));
  } else if constexpr (kind == ShapeKind::cone) {
    const Vec3d tip(0, 0, shape.half_length);
    const Vec3d base = on_disk(shape.radius, direction, -shape.half_length);
    return tip.dot(direction) > base.dot(direction) ? tip : base;
  } else if constexpr (kind == ShapeKind::ellipsoid) {
    const Vec3d on_ball = normalized_or_zero(Vec3d(shape.radii.cwiseProduct(direction)));
    return shape.radii.cwiseProduct(on_ball);
  } else {
    static_assert(kind == ShapeKind::hull);
    const std::vector<Vec3d>& vertices = shape.hull->vertices;
    std::size_t best = 0;
    double farthest = vertices[0].dot(direction);
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      const double value = vertices[i].dot(direction);
      if (value > farthest) {
        farthest = value;
        best = i;
      }
    }
    return vertices[best];
  }
}

template <ShapeKind kind>
void support(const void* object, const ccd_vec3_t* ccd_direction, ccd_vec3_t* out) {
  const Body& body = body_of(object);
  const Vec3d direction = to_eigen(*ccd_direction);
  ++body.query->calls;
  if (body.query->stopped()) {
    set(out, -1e100 * direction);
    return;
  }
  const Vec3d local = body.pose->rotation.transpose() * direction;
  Vec3d point = (*body.pose)(core_support<kind>(*body.shape, local));
  if constexpr (kind == ShapeKind::sphere || kind == ShapeKind::capsule) {
    point += body.shape->radius * normalized_or_zero(direction);
  }
  set(out, point);
}

ccd_support_fn support_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere: return support<ShapeKind::sphere>;
    case ShapeKind::capsule: return support<ShapeKind::capsule>;
    case ShapeKind::box: return support<ShapeKind::box>;
    case ShapeKind::cylinder: return support<ShapeKind::cylinder>;
    case ShapeKind::cone: return support<ShapeKind::cone>;
    case ShapeKind::ellipsoid: return support<ShapeKind::ellipsoid>;
    case ShapeKind::hull: return support<ShapeKind::hull>;
    case ShapeKind::halfspace: break;
  }
  return nullptr;
}

void center(const void* object, ccd_vec3_t* out) {
  const Body& body = body_of(object);
  set(out, (*body.pose)(body.center));
}

bool supports(ShapeKind, ShapeKind kind_b, Task) { return kind_b != ShapeKind::halfspace; }

class Libccd final : public NarrowPhase {
 public:
  Libccd(Method method, const NarrowPhaseSettings& settings)
      : method_(method),
        tolerance_(settings.tolerance),
        max_iterations_(settings.max_iterations ? *settings.max_iterations
                                                : default_max_iterations) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = shapes;
    centers_.clear();
    reaches_.clear();
    for (const Shape& shape : shapes) {
      Vec3d sum = Vec3d::Zero();
      if (shape.kind == ShapeKind::hull) {
        for (const Vec3d& vertex : shape.hull->vertices) sum += vertex;
        sum /= static_cast<double>(shape.hull->vertices.size());
      }
      centers_.push_back(sum);
      reaches_.push_back(loose_reach(shape, Mat3d::Identity()));
    }
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = support_of(batch.kind_a);
    ccd.support2 = support_of(batch.kind_b);
    ccd.center1 = center;
    ccd.center2 = center;
    const long limit = support_limit(task);
    // GJK gets one iteration more than allowed, so that using it is detected. MPR reaches its own
    // cap only if its direction is NaN, which no support point can end.
    ccd.max_iterations =
        static_cast<unsigned long>(method_ == Method::mpr ? limit : max_iterations_ + 1);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      Query query{.limit = 2 * limit};
      const Body a = body(batch, batch.pairs.first[i], &query);
      const Body b = body(batch, batch.pairs.second[i], &query);
      if (tolerance_) set_tolerance(ccd, *tolerance_ * size(batch, i));
      if (task == Task::intersect) {
        intersect(ccd, a, b, outcomes[i]);
      } else {
        penetration(ccd, a, b, outcomes[i]);
      }
    }
  }

 private:
  // Limit on a query's support points. GJK computes one before its loop, EPA up to eight between
  // GJK's loop and its own, MPR two before its first loop.
  long support_limit(Task task) const {
    switch (method_) {
      case Method::gjk: return 1 + max_iterations_;
      case Method::epa: return 2 + max_iterations_ + 8 + max_iterations_;
      case Method::mpr: return 2 + max_iterations_ * (task == Task::intersect ? 2 : 3);
    }
    return 0;
  }

  Body body(const PairBatch& batch, std::uint32_t id, Query* query) const {
    const std::uint32_t shape = batch.pairs.shape_of[id];
    return {&shapes_[shape], &batch.pairs.poses[id], centers_[shape], query};
  }

  // The sum of the bodies' reaches, each from its origin (metres).
  double size(const PairBatch& batch, std::size_t i) const {
    return reaches_[batch.pairs.shape_of[batch.pairs.first[i]]] +
           reaches_[batch.pairs.shape_of[batch.pairs.second[i]]];
  }

  static void set_tolerance(ccd_t& ccd, double length) {
    ccd.mpr_tolerance = length;
    ccd.epa_tolerance = length * length;
  }

  void answer(const Query& query, bool found, Outcome& outcome) const {
    // EPA's limit is not that of the GJK before it, which may have used up its own.
    const bool gjk_gave_up = !found && query.support_points() > 1 + max_iterations_;
    const bool gave_up = query.stopped() || (method_ == Method::epa && gjk_gave_up);
    outcome.iterations = -1;
    outcome.support_calls = static_cast<std::int32_t>(query.support_points());
    outcome.status = gave_up ? Status::not_converged : Status::not_reported;
    outcome.answer = found ? Answer::overlapping : gave_up ? Answer::unknown : Answer::separated;
    if (outcome.answer != Answer::separated) clear_numbers(outcome);
  }

  void intersect(const ccd_t& ccd, const Body& a, const Body& b, Outcome& outcome) const {
    const int found =
        method_ == Method::gjk ? ccdGJKIntersect(&a, &b, &ccd) : ccdMPRIntersect(&a, &b, &ccd);
    answer(*a.query, found != 0, outcome);
  }

  void penetration(const ccd_t& ccd, const Body& a, const Body& b, Outcome& outcome) const {
    ccd_real_t depth = Outcome::none;
    ccd_vec3_t direction, position;
    ccdVec3Set(&direction, 0, 0, 0);
    const int result = method_ == Method::epa
                           ? ccdGJKPenetration(&a, &b, &ccd, &depth, &direction, &position)
                           : ccdMPRPenetration(&a, &b, &ccd, &depth, &direction, &position);
    answer(*a.query, result == 0, outcome);
    if (result == -2) {  // out of memory, or a polytope that cannot be expanded
      outcome.answer = Answer::unknown;
      outcome.status = Status::degenerate;
      clear_numbers(outcome);
    }
    if (result != 0) return;
    if (!(depth >= 0)) {
      outcome.status = Status::degenerate;
      return;
    }
    outcome.distance = 0 - depth;
    // libccd moves b by depth along this direction. For touching bodies it is zero or NaN.
    const Vec3d normal = to_eigen(direction);
    if (normal.squaredNorm() > 0.5) outcome.normal = normal;
  }

  Method method_;
  std::optional<double> tolerance_;
  long max_iterations_;
  std::span<const Shape> shapes_;
  std::vector<Vec3d> centers_;
  std::vector<double> reaches_;
};

template <Method method>
std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  return std::make_unique<Libccd>(method, settings);
}

constexpr auto make_gjk = make<Method::gjk>;
constexpr auto make_epa = make<Method::epa>;
constexpr auto make_mpr = make<Method::mpr>;

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_libccd_narrow_phase() {
  using enum Task;
  const std::vector<Precision> scalars = {Precision::float64};
  return {
      {.info = {.name = "libccd-gjk",
                .citation = "libccd 2.1, ccdGJKIntersect",
                .origin = Origin::peer,
                .known_defect = "thresholds are absolute: gaps below 1e-8 are overlaps"},
       .tasks = {intersect},
       .scalars = scalars,
       .supports = supports,
       .make = make_gjk},
      {.info = {.name = "libccd-epa",
                .citation = "libccd 2.1, ccdGJKPenetration",
                .origin = Origin::peer,
                .known_defect = "expands one face at a time, without a horizon: depths too small"},
       .tasks = {penetration},
       .scalars = scalars,
       .supports = supports,
       .tolerance = "EPA's: the gain of a step of the depth's square, as a square; 1e-4 m",
       .make = make_epa},
      {.info = {.name = "libccd-mpr",
                .citation = "libccd 2.1, ccdMPRIntersect and ccdMPRPenetration",
                .origin = Origin::peer,
                .known_defect = "the depth is along the portal: an upper bound"},
       .tasks = {intersect, penetration},
       .scalars = scalars,
       .supports = supports,
       .traits = {.depth_is_bound = true},
       .tolerance = "how far the surface is beyond the portal, along its normal; 1e-4 m",
       .make = make_mpr},
  };
}

}  // namespace touchstone::entries
