// The families. Truths are exact: coordinates are integers times a power of two unless said.
#include "harness/families/ccd_families.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace touchstone::families {
namespace {

std::string digits(double x) { return fmt::format("{:.0e}", x); }

Vec3d integers(Draws& random, int reach) {
  const auto one = [&] { return static_cast<double>(random.below(2 * reach + 1) - reach); };
  return {one(), one(), one()};
}

// Vertices in place at time t / 4, and how they move in all; integers stay integers.
CcdQuery moving(const std::array<Vec3d, 4>& there, const std::array<Vec3d, 4>& velocity, int t) {
  CcdQuery query;
  for (std::size_t i = 0; i < 4; ++i) {
    query.start[i] = there[i] - t * velocity[i];
    query.end[i] = there[i] + (4 - t) * velocity[i];
  }
  return query;
}

// Where on the features they meet: weights in quarters. For a face, of its three vertices; for
// edges, of the second vertex of each.
using Weights = std::array<int, 3>;

// Features that share a point at time t / 4, with integers; `reach` of velocities.
CcdQuery in_contact_at(Draws& random, FeaturePair pair, const Weights& w, int t, int reach) {
  std::array<Vec3d, 4> x, v;
  for (Vec3d& one : v) one = integers(random, reach);
  if (pair == FeaturePair::vertex_face) {
    for (std::size_t i = 1; i < 4; ++i) x[i] = 4 * integers(random, 8);
    x[0] = (w[0] * x[1] + w[1] * x[2] + w[2] * x[3]) / 4;
  } else {
    const Vec3d meet = 4 * integers(random, 8), a = integers(random, 8), b = integers(random, 8);
    x = {meet - w[0] * a, meet + (4 - w[0]) * a, meet - w[1] * b, meet + (4 - w[1]) * b};
  }
  return moving(x, v, t);
}

Weights inside_of(FeaturePair pair) {
  return pair == FeaturePair::vertex_face ? Weights{1, 1, 2} : Weights{1, 2, 0};
}

constexpr Weights corners_vf[] = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
constexpr Weights corners_ee[] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}};

class Families {
 public:
  std::vector<CcdFamily> all;

  explicit Families() {
    for (const FeaturePair pair : {FeaturePair::vertex_face, FeaturePair::edge_edge}) {
      pair_ = pair;
      add_contacts();
      add_degenerate();
      add_planes();
      add_motions();
    }
  }

 private:
  using Draw = std::function<CcdQuery(Draws&)>;

  void add(const std::string& name, Draw draw, CcdAnswer truth = CcdAnswer::unknown,
           bool is_small = false) {
    std::string joined = (is_face() ? "vertex-face-" : "edge-edge-") + name;
    std::erase(joined, ',');
    std::ranges::replace(joined, ' ', '-');
    all.push_back({std::move(joined), pair_, std::move(draw), truth, is_small});
  }
  bool is_face() const { return pair_ == FeaturePair::vertex_face; }

  void add_contacts() {
    const FeaturePair pair = pair_;
    const Weights inside = inside_of(pair);
    const Weights edge = is_face() ? Weights{2, 2, 0} : Weights{0, 1, 0};
    const auto corner = [pair](Draws& r) {
      return pair == FeaturePair::vertex_face ? corners_vf[r.below(3)] : corners_ee[r.below(4)];
    };
    const auto hit = CcdAnswer::hit;
    add(
        "inside", [=](Draws& r) { return in_contact_at(r, pair, inside, r.below(5), 6); }, hit,
        true);
    add(
        "on an edge", [=](Draws& r) { return in_contact_at(r, pair, edge, r.below(5), 6); }, hit,
        true);
    add(
        "at a corner", [=](Draws& r) { return in_contact_at(r, pair, corner(r), r.below(5), 6); },
        hit, true);
    add(
        "at time 1", [=](Draws& r) { return in_contact_at(r, pair, inside, 4, 6); }, hit, true);
    add(
        "at time 1 and a corner", [=](Draws& r) { return in_contact_at(r, pair, corner(r), 4, 6); },
        hit, true);
    add(
        "from time 0 apart", [=](Draws& r) { return in_contact_at(r, pair, inside, 0, 6); }, hit,
        true);
    // Out of contact by the last bits of a double.
    for (const double off : {1e-15, 1e-9}) {
      add("inside, off by " + digits(off), [=](Draws& r) {
        CcdQuery query = changed(in_contact_at(r, pair, inside, 4, 6), 0x1p-5);
        query.end[0] += off * r.direction();
        return query;
      });
    }
  }

  void add_degenerate() {
    const FeaturePair pair = pair_;
    for (const int reach : {1, 2, 4}) {
      add(
          "small grid " + std::to_string(reach),
          [=](Draws& r) {
            CcdQuery query;
            for (std::size_t i = 0; i < 4; ++i) {
              query.start[i] = integers(r, reach);
              query.end[i] = integers(r, reach);
            }
            return query;
          },
          CcdAnswer::unknown, true);
    }
    add(
        "a segment or a point",
        [=](Draws& r) {
          CcdQuery query = in_contact_at(r, pair, {0, 0, 4}, r.below(5), 3);
          const bool is_point = r.below(2) == 0;
          for (std::array<Vec3d, 4>* x : {&query.start, &query.end}) {
            (*x)[2] = (*x)[3];
            if (is_point) (*x)[1] = (*x)[pair == FeaturePair::vertex_face ? 3 : 0];
          }
          return query;
        },
        CcdAnswer::unknown, true);
    add(
        "parallel edges",
        [=](Draws& r) {
          const Vec3d along = integers(r, 2);
          CcdQuery query;
          for (std::array<Vec3d, 4>* x : {&query.start, &query.end}) {
            *x = {integers(r, 3), Vec3d::Zero(), integers(r, 3), Vec3d::Zero()};
            (*x)[1] = (*x)[0] + (1 + r.below(3)) * along;
            (*x)[3] = (*x)[2] + (1 + r.below(3)) * along;
          }
          return query;
        },
        CcdAnswer::unknown, true);
    // The volume is (2 t - 1)^2 times a number.
    add(
        "double root",
        [=](Draws& r) {
          CcdQuery query;
          const Vec3d origin = integers(r, 2), more = integers(r, 2);
          const double a = 1 + r.below(2), b = 1 + r.below(2);
          std::array<Vec3d, 4> free;
          for (Vec3d& one : free) one = integers(r, 2);
          query.start = {origin, origin + Vec3d(2, 0, 0), origin + Vec3d(free[0][0], -a, 0),
                         origin + Vec3d(free[1][0], free[1][1], -b)};
          query.end = {origin, origin + Vec3d(2, 0, 0), origin + Vec3d(free[2][0], a, 0),
                       origin + Vec3d(free[3][0], free[3][1], b)};
          for (Vec3d& one : query.end) one += more;
          return query;
        },
        CcdAnswer::unknown, true);
  }

  void add_planes() {
    const FeaturePair pair = pair_;
    add(
        "in one plane",
        [=](Draws& r) {
          CcdQuery query;
          const Vec3d u = integers(r, 2), v = integers(r, 2);
          for (std::array<Vec3d, 4>* x : {&query.start, &query.end}) {
            for (Vec3d& one : *x) one = (r.below(7) - 3) * u + (r.below(7) - 3) * v;
          }
          return query;
        },
        CcdAnswer::unknown, true);
    // The first feature slides above or in the plane of the second.
    for (const double gap : {0.0, 1e-15, 1e-9}) {
      add(
          gap == 0 ? std::string("slides in the plane") : "slides above by " + digits(gap),
          [=](Draws& r) {
            CcdQuery query;
            for (std::array<Vec3d, 4>* x : {&query.start, &query.end}) {
              for (Vec3d& one : *x) one = {r.uniform(-1, 1), r.uniform(-1, 1), 0};
              (*x)[0].z() = gap;
              if (pair == FeaturePair::edge_edge) (*x)[1].z() = gap;
            }
            return query;
          },
          gap == 0 ? CcdAnswer::unknown : CcdAnswer::miss);
    }
  }

  void add_motions() {
    const FeaturePair pair = pair_;
    add("random", [](Draws& r) {
      CcdQuery query;
      for (std::array<Vec3d, 4>* x : {&query.start, &query.end}) {
        for (Vec3d& one : *x) one = r.vector(1);
      }
      return query;
    });
    for (const double reach : {1e-12, 1e-6, 1e-3, 1e3, 1e6}) {
      add("motion of " + digits(reach), [=](Draws& r) { return motion_query(pair, reach, r); });
    }
    add("no motion", [=](Draws& r) {
      CcdQuery query = in_contact_at(r, pair, {r.below(7) - 1, 1, 2}, 0, 6);
      query.end = query.start;
      return query;
    });
    add("all alike", [=](Draws& r) {
      CcdQuery query = in_contact_at(r, pair, {r.below(7) - 1, 1, 2}, 0, 6);
      const Vec3d motion = 64 * integers(r, 100);
      for (std::size_t i = 0; i < 4; ++i) query.end[i] = query.start[i] + motion;
      return query;
    });
  }

  FeaturePair pair_ = FeaturePair::vertex_face;
};

}  // namespace

std::vector<CcdFamily> ccd_families() { return Families().all; }

CcdQuery contact_query(FeaturePair pair, Draws& random) {
  return in_contact_at(random, pair, inside_of(pair), random.below(5), 6);
}

CcdQuery motion_query(FeaturePair pair, double reach, Draws& random) {
  CcdQuery query = in_contact_at(random, pair, inside_of(pair), 0, 6);
  for (std::size_t i = 0; i < 4; ++i) query.end[i] = query.start[i] + reach * random.vector(1);
  query.start[0] += reach * 0.5 * random.vector(1);
  return query;
}

CcdQuery changed(const CcdQuery& query, double factor, double offset) {
  CcdQuery result = query;
  for (std::array<Vec3d, 4>* x : {&result.start, &result.end}) {
    for (Vec3d& one : *x) one = (factor * one).array() + offset;
  }
  return result;
}

}  // namespace touchstone::families
