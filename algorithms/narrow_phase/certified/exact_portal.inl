// Part of certified: the portal of exact_contact.h in integers of `size` limbs. Included by
// exact_contact.cpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "algorithms/narrow_phase/certified/grid_body.h"
#include "algorithms/narrow_phase/certified/placed_body.h"
#include "algorithms/narrow_phase/certified/rough_portal.h"

namespace touchstone {
namespace {

// A point of the difference C and the points of the two bodies that it is made of.
template <std::size_t size>
struct PortalCorner {
  std::size_t a = 0, b = 0;
  GridPoint<size> point;
};

template <std::size_t size>
class ExactPortal {
 public:
  using Body = GridBody<size>;
  using Corner = PortalCorner<size>;
  // `metres` is the grid's step, and `unit` and `slab` are in metres. The task says for which
  // answers bounds are needed; these are made close.
  ExactPortal(Body& a, Body& b, double metres, double unit, double slab, Task task)
      : a_(a), b_(b), unit_(unit / metres), slab_(slab), task_(task) {}

  // Returns unknown if nothing is proven. If the answer is another, the proof is valid. `normal` is
  // a direction near which the plane of contact may be.
  Answer decide(RoughPortal& rough, const Vec3d& normal) {
    Answer answer = Answer::unknown;
    for (int attempt = 0; attempt < 3; ++attempt) {
      const RoughPortal::Start start = attempt == 0   ? rough.start_behind(normal)
                                       : attempt == 1 ? rough.start_amid(normal, {9, 5, 3, 2})
                                                      : rough.start_amid(normal, {4, 3, 6, 7});
      if (!rough.find(start, attempt == 0) || !cast_from(start) || !take(rough)) continue;
      const Answer found = refine();
      if (found != Answer::unknown) answer = found;
      if (answer != Answer::unknown && (is_close_ || !asks_for_number(task_, answer)))
        return answer;
    }
    return answer != Answer::unknown ? answer : decide_along(normal);
  }

  // What was proven of the signed distance, in steps of the grid, if the task asks for it.
  struct Proof {
    Vec3d normal = Vec3d::Zero();                             // unit length
    double lower = -std::numeric_limits<double>::infinity();  // along the normal
    double upper = std::numeric_limits<double>::infinity();   // if separated: to a point of C
    std::array<Corner, 3> portal = {};
    Vec3d weights = Vec3d::Zero();  // of that point, in the portal
  };
  const Proof& proof() const { return proof_; }

 private:
  static constexpr int most_portals = 32;
  static constexpr int most_turns = 8;

  Corner corner(std::size_t a, std::size_t b) const {
    return {a, b, GridPoint<size>(a_[a] - b_[b])};
  }

  std::optional<Corner> place(const RoughCorner& rough) {
    const auto a = a_.place(rough.a), b = b_.place(rough.b);
    if (!a || !b) return std::nullopt;
    return corner(*a, *b);
  }

  // The corner whose vertices, which are listed, are nearest to the rough one's.
  Corner nearest(const RoughCorner& rough, const RoughPortal& portal) const {
    return corner(a_.nearest(rough.point.a, portal.unit(), Vec3d::Zero()),
                  b_.nearest(rough.point.b, portal.unit(), portal.centre_b()));
  }

  // The ray passes the origin. It starts inside C if it starts inside a tetrahedron.
  bool cast_from(const RoughPortal::Start& start) {
    FixedVector<size + 1> back;
    std::array<FixedVector<size>, 4> corners = {};
    for (std::size_t k = 0; k < 4; ++k) {
      if (start.weights[k] == 0) continue;
      const auto from = place(start.points[k]);
      if (!from) return false;
      corners[k] = from->point.exact;
      for (std::size_t i = 0; i < 3; ++i) {
        back[i] = back[i] - times(extended(from->point.exact[i]), start.weights[k]);
      }
    }
    ray_ = GridPoint<size + 1>(back);
    starts_inside_ = false;
    if (start.weights[3] > 0) {
      const auto across = cross(corners[1] - corners[0], corners[2] - corners[0]);
      starts_inside_ = dot(across, corners[3] - corners[0]).sign() != 0;
    }
    return true;
  }

  // Takes the rough portal, anticlockwise around the ray. If the ray passes just beside it, it turns
  // over its edges. Returns false if it is not found.
  bool take(RoughPortal& rough) {
    if (!rough.is_numbered() && !list_along(rough.normal())) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const RoughCorner& found = rough.portal()[k];
      const auto placed = found.is_numbered() ? place(found) : std::optional(nearest(found, rough));
      if (!placed) return false;
      portal_[k] = *placed;
    }
    auto& [p, q, r] = portal_;
    if (side(p, q) < 0 && side(q, r) < 0 && side(r, p) < 0) std::swap(p, q);
    for (int turn = 0; turn < most_turns; ++turn) {
      const std::array<int, 3> sides = {side(p, q), side(q, r), side(r, p)};
      const auto beyond = std::ranges::find(sides, -1);
      if (beyond == sides.end()) return std::ranges::find(sides, 1) != sides.end();
      // The ray is beyond the edge from i to j.
      const auto i = static_cast<std::size_t>(beyond - sides.begin()), j = (i + 1) % 3;
      const Vec3d start = -ray_.rounded;
      const Vec3d out = (portal_[j].point.rounded - start).cross(portal_[i].point.rounded - start);
      const auto next = place(rough.support(out.stableNormalized()));
      if (!next) return false;
      std::swap(portal_[i], portal_[j]);
      portal_[(i + 2) % 3] = *next;
    }
    return false;
  }

  // Tries the plane along a direction: it separates, or a single point of C is near it, which is the
  // origin. All other points of C are behind it.
  Answer decide_along(const Vec3d& normal) {
    if (!list_along(normal)) return Answer::unknown;
    if (a_.near().size() * b_.near().size() > 4) return Answer::unknown;
    double most = -std::numeric_limits<double>::infinity();
    Corner nearest = corner(a_.near().front(), b_.near().front());
    for (const std::size_t i : a_.near()) {
      for (const std::size_t j : b_.near()) {
        const Corner here = corner(i, j);
        const Vec3d& w = here.point.rounded;
        const double height = listed_.dot(w) + 0x1p-48 * w.cwiseAbs().sum();
        if (!(height > most)) continue;
        most = height;
        nearest = here;
      }
    }
    const bool measured = asks_for_number(task_, Answer::separated);
    const double upper = (1 + 0x1p-48) * nearest.point.rounded.norm();
    proof_ = {listed_, -most, upper, {nearest, nearest, nearest}, Vec3d::Constant(1.0 / 3)};
    if (most < 0 && (!measured || upper + most <= close_enough * unit_)) {
      return Answer::separated;
    }
    const bool is_single = a_.near().size() == 1 && b_.near().size() == 1;
    return is_single && nearest.point.rounded.isZero(0) ? Answer::touching : Answer::unknown;
  }

  // The sign of ray . (p x q).
  int side(const Corner& p, const Corner& q) const {
    const Vec3d &u = p.point.rounded, &v = q.point.rounded;
    const double value = ray_.rounded.dot(u.cross(v));
    // Three factors off by 2^-50 of themselves, and six products of three and their sums.
    const double bound =
        0x1p-45 * ray_.rounded.cwiseAbs().sum() * u.cwiseAbs().sum() * v.cwiseAbs().sum();
    if (std::abs(value) > bound) return value > 0 ? 1 : -1;
    return dot(cross(p.point.exact, q.point.exact), ray_.exact).sign();
  }

  // Pushes the portal along the ray until it decides.
  Answer refine() {
    Answer answer = Answer::unknown;
    for (int turn = 0; turn < most_portals; ++turn) {
      const auto& [p, q, r] = portal_;
      const auto normal = cross(q.point.exact - p.point.exact, r.point.exact - p.point.exact);
      // This is the sum of the three sides, which are not negative.
      if (!is_along_the_ray(normal)) return answer;
      const auto height = dot(normal, p.point.exact);
      // Where the ray passes an edge, the portal and the start alone do not enclose the origin.
      if (height.sign() > 0 && !starts_inside_ &&
          !(side(p, q) > 0 && side(q, r) > 0 && side(r, p) > 0)) {
        return answer;
      }
      if (!list_along(unit_of(normal))) return answer;
      const Reach reach = furthest_along(normal);
      const int above = reach.height.sign();
      if (height.sign() > 0 || above < 0 || (above == 0 && height.sign() == 0)) {
        answer = height.sign() > 0 ? Answer::overlapping
                 : above < 0       ? Answer::separated
                                   : Answer::touching;
        if (!asks_for_number(task_, answer)) return answer;
        keep(normal, reach.height, answer);
        const double off = to_double(reach.height - height) / length_of(normal);
        is_close_ = off <= close_enough * unit_;
        if (is_close_) return answer;
      }
      if ((reach.height - height).sign() <= 0 || !replace_by(corner(reach.a, reach.b))) {
        return answer;
      }
    }
    return answer;
  }

  bool is_along_the_ray(const FixedVector<2 * size>& normal) const {
    const Vec3d direction = rounded(normal);
    const double value = direction.dot(ray_.rounded);
    const double bound = 0x1p-46 * direction.cwiseAbs().dot(ray_.rounded.cwiseAbs());
    return value > bound || (value >= -bound && dot(normal, ray_.exact).sign() > 0);
  }

  // Lists what is near the support planes along a direction, unless that is listed.
  bool list_along(const Vec3d& direction) {
    if (is_same_direction(direction, listed_)) return true;
    const bool listed = a_.list_near(direction, slab_) && b_.list_near(-direction, slab_);
    listed_ = listed ? direction : Vec3d::Zero();
    return listed;
  }

  static Vec3d unit_of(const FixedVector<2 * size>& v) { return rounded(v).stableNormalized(); }
  static double length_of(const FixedVector<2 * size>& v) { return rounded(v).stableNorm(); }

  // The points whose difference is furthest along the normal, and its height.
  struct Reach {
    std::size_t a = 0, b = 0;
    FixedInteger<3 * size> height;
  };
  Reach furthest_along(const FixedVector<2 * size>& normal) const {
    Reach reach{a_.near().front(), b_.near().front(), {}};
    auto most = dot(normal, a_[reach.a]), least = dot(normal, b_[reach.b]);
    for (const std::size_t i : a_.near().subspan(1)) {
      const auto value = dot(normal, a_[i]);
      if ((value - most).sign() <= 0) continue;
      most = value;
      reach.a = i;
    }
    for (const std::size_t i : b_.near().subspan(1)) {
      const auto value = dot(normal, b_[i]);
      if ((least - value).sign() <= 0) continue;
      least = value;
      reach.b = i;
    }
    reach.height = most - least;
    return reach;
  }

  // Keeps what the portal proves, with its normal and the height of C along it, if that is closer
  // than what is kept.
  void keep(const FixedVector<2 * size>& normal, const FixedInteger<3 * size>& height,
            Answer answer) {
    const double length = length_of(normal), along = -to_double(height) / length;
    if (!(along > proof_.lower)) return;
    proof_.normal = unit_of(normal);
    proof_.lower = along;
    proof_.portal = portal_;
    proof_.weights = weights();
    if (answer == Answer::separated)
      proof_.upper = std::min(proof_.upper, furthest(normal, length));
  }

  // Bounds the distance of the origin from where the ray passes the portal, along the ray, which
  // passes the origin.
  double furthest(const FixedVector<2 * size>& normal, double length) const {
    const auto& [p, q, r] = portal_;
    const double steep = unit_of(normal).dot(ray_.rounded.stableNormalized());
    if (!(steep > 0x1p-20)) {
      return (1 + 0x1p-48) *
             std::max({p.point.rounded.norm(), q.point.rounded.norm(), r.point.rounded.norm()});
    }
    const double height = std::abs(to_double(dot(normal, p.point.exact))) / length;
    // The height is off by 2^-49 of itself, each of the directions by 2^-49.
    return height * (1 + 0x1p-48) / (steep - 0x1p-47);
  }

  // Weights of the point where the ray passes the portal.
  Vec3d weights() const {
    const auto& [p, q, r] = portal_;
    const auto part = [&](const Corner& x, const Corner& y) {
      return std::max(0.0, ray_.rounded.dot(x.point.rounded.cross(y.point.rounded)));
    };
    const Vec3d parts(part(q, r), part(r, p), part(p, q));
    const double sum = parts.sum();
    return sum > 0 ? Vec3d(parts / sum) : Vec3d::Constant(1.0 / 3);
  }

  // Replaces a corner so that the ray still passes through the portal.
  bool replace_by(const Corner& next) {
    const std::array<int, 3> sides = {side(next, portal_[0]), side(next, portal_[1]),
                                      side(next, portal_[2])};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      // The portal of corners i and j and the new one, unless it is seen edge-on along the ray.
      if (sides[i] < 0 || -sides[j] < 0) continue;
      if (sides[i] == 0 && sides[j] == 0 && side(portal_[i], portal_[j]) <= 0) continue;
      portal_[(i + 2) % 3] = next;
      return true;
    }
    return false;
  }

  static constexpr double close_enough = 0x1p-51;  // in units

  Body &a_, &b_;
  Vec3d listed_ = Vec3d::Zero();  // the direction along which the bodies have listed what is near
  double unit_;                   // in steps of the grid
  double slab_;                   // metres
  Task task_;
  bool is_close_ = false;
  GridPoint<size + 1> ray_;  // a sum of points
  bool starts_inside_ = false;
  std::array<Corner, 3> portal_;
  Proof proof_;
};

}  // namespace
}  // namespace touchstone
