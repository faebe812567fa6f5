// FCL's two solvers as narrow phases. fcl_narrow_phase.cpp compiles them for double, and describes them;
// fcl_narrow_phase_float.cpp compiles them for float.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "algorithms/core/bounds.h"
#include "algorithms/narrow_phase.h"

#ifdef TOUCHSTONE_HAS_FCL
// GCC warns of the contacts of separated bodies, which are never read, once FCL is inlined here.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
#include <fcl/narrowphase/distance_request.h>

#include "algorithms/peers/fcl_shapes.h"
#include "algorithms/signed_by_two.h"

namespace touchstone::fcl_solvers {

using namespace fcl_shapes;

// Sets on the solver the numbers that the requests of fcl::collide and fcl::distance carry.
template <class S>
void set_tolerance(fcl::detail::GJKSolver_libccd<S>& solver, S tolerance) {
  solver.collision_tolerance = tolerance;
  solver.distance_tolerance = tolerance;
}
template <class S>
void set_tolerance(fcl::detail::GJKSolver_indep<S>& solver, S tolerance) {
  solver.gjk_tolerance = tolerance;
  solver.epa_tolerance = tolerance;
}
template <class S>
void set_max_iterations(fcl::detail::GJKSolver_libccd<S>& solver, unsigned int cap) {
  solver.max_collision_iterations = cap;
  solver.max_distance_iterations = cap;
}
template <class S>
void set_max_iterations(fcl::detail::GJKSolver_indep<S>& solver, unsigned int cap) {
  solver.gjk_max_iterations = static_cast<S>(cap);
  solver.epa_max_iterations = cap;
  solver.epa_max_vertex_num = cap + 4;  // one vertex an iteration, and two faces a vertex
  solver.epa_max_face_num = 2 * solver.epa_max_vertex_num;
}

// True if FCL answers a collision of these kinds without either solver.
constexpr bool has_closed_form(ShapeKind a, ShapeKind b) {
  using enum ShapeKind;
  if (b == halfspace || (a == box && b == box)) return true;
  return a == sphere && (b == sphere || b == capsule || b == box || b == cylinder);
}

// FCL has no distance to a half-space, and no contact of two half-spaces.
inline bool supports(ShapeKind kind_a, ShapeKind kind_b, Task task) {
  if (asks_distance(task)) return kind_b != ShapeKind::halfspace;
  return task == Task::intersect || kind_a != ShapeKind::halfspace;
}

// True if FCL answers a distance of these kinds without fcl-libccd's loops.
constexpr bool has_closed_distance(ShapeKind a, ShapeKind b) {
  using enum ShapeKind;
  if (a == sphere) return b == sphere || b == capsule || b == box || b == cylinder;
  return a == capsule && b == capsule;
}

inline Encoding matrix_encoding(ShapeKind, ShapeKind, Task, Precision scalar) {
  return scalar == Precision::float32 ? Encoding::float32 : Encoding::as_given;
}

// Only libccd's own loops use quaternions.
inline Encoding quaternion_encoding(ShapeKind a, ShapeKind b, Task task, Precision scalar) {
  if ((!asks_distance(task) || has_closed_distance(a, b)) &&
      (task == Task::distance || has_closed_form(a, b))) {
    return matrix_encoding(a, b, task, scalar);
  }
  return scalar == Precision::float32 ? Encoding::quaternion_float32 : Encoding::quaternion;
}

// The two questions to a solver, for one pair of kinds: all else is compiled once for all kinds.
template <class S, template <class> class Solver>
struct Questions {
  using Body = fcl::ShapeBase<S>;
  using Transform = fcl::Transform3<S>;
  using Contacts = std::vector<fcl::ContactPoint<S>>;
  bool (*intersect)(const Solver<S>&, const Body&, const Transform&, const Body&, const Transform&,
                    Contacts*) = nullptr;
  void (*distance)(const Solver<S>&, const Body&, const Transform&, const Body&, const Transform&,
                   S* gap, Vec3<S>* witness_a, Vec3<S>* witness_b) = nullptr;

  template <ShapeKind kind_a, ShapeKind kind_b>
  static constexpr Questions of_kinds() {
    using A = FclShape<S, kind_a>;
    using B = FclShape<S, kind_b>;
    Questions questions;
    if constexpr (kind_a <= kind_b) {
      questions.intersect = [](const Solver<S>& solver, const Body& a, const Transform& pose_a,
                               const Body& b, const Transform& pose_b, Contacts* contacts) {
        return solver.shapeIntersect(static_cast<const A&>(a), pose_a, static_cast<const B&>(b),
                                     pose_b, contacts);
      };
      if constexpr (kind_b != ShapeKind::halfspace) {
        questions.distance = [](const Solver<S>& solver, const Body& a, const Transform& pose_a,
                                const Body& b, const Transform& pose_b, S* gap, Vec3<S>* witness_a,
                                Vec3<S>* witness_b) {
          solver.shapeDistance(static_cast<const A&>(a), pose_a, static_cast<const B&>(b), pose_b,
                               gap, witness_a, witness_b);
        };
      }
    }
    return questions;
  }

  static const Questions& of(ShapeKind kind_a, ShapeKind kind_b) {
    constexpr std::size_t kinds = std::tuple_size_v<FclShapes<S>>;
    static constexpr auto table = []<std::size_t... place>(std::index_sequence<place...>) {
      return std::array{of_kinds<static_cast<ShapeKind>(place / kinds),
                                 static_cast<ShapeKind>(place % kinds)>()...};
    }
    (std::make_index_sequence<kinds * kinds>());
    return table[static_cast<std::size_t>(kind_a) * kinds + static_cast<std::size_t>(kind_b)];
  }
};

template <class S, template <class> class Solver>
class Fcl final : public NarrowPhase {
 public:
  explicit Fcl(const NarrowPhaseSettings& settings) : tolerance_(settings.tolerance) {
    if (settings.max_iterations) {
      set_max_iterations(solver_, static_cast<unsigned int>(*settings.max_iterations));
    }
  }

  void bind(std::span<const Shape> shapes) override {
    shapes_.clear();
    reaches_.clear();
    for (const Shape& shape : shapes) {
      shapes_.push_back(make_fcl_shape<S>(shape));
      const double reach = loose_reach(shape, Mat3d::Identity());
      reaches_.push_back(std::isfinite(reach) ? reach : 0);
    }
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    if (task == Task::signed_distance) return signed_.solve(*this, batch, outcomes);
    const Questions<S, Solver>& ask = Questions<S, Solver>::of(batch.kind_a, batch.kind_b);
    const bool closed_form = has_closed_form(batch.kind_a, batch.kind_b);
    set_tolerance(solver_, default_tolerance(task));
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
      const std::uint32_t shape_a = batch.pairs.shape_of[first],
                          shape_b = batch.pairs.shape_of[second];
      const fcl::ShapeBase<S>&a = *shapes_[shape_a], &b = *shapes_[shape_b];
      const fcl::Transform3<S> pose_a = to_fcl<S>(batch.pairs.poses[first]);
      const fcl::Transform3<S> pose_b = to_fcl<S>(batch.pairs.poses[second]);
      if (tolerance_) {
        set_tolerance(solver_,
                      static_cast<S>(*tolerance_ * (reaches_[shape_a] + reaches_[shape_b])));
      }
      Outcome& outcome = outcomes[i];
      outcome.status = Status::not_reported;
      outcome.iterations = outcome.support_calls = -1;
      try {
        switch (task) {
          case Task::intersect:
            outcome.answer = ask.intersect(solver_, a, pose_a, b, pose_b, nullptr)
                                 ? Answer::overlapping
                                 : Answer::separated;
            break;
          case Task::distance: {
            if (ask.distance == nullptr) break;
            S gap = std::numeric_limits<S>::quiet_NaN();
            Vec3<S> witness_a, witness_b;
            ask.distance(solver_, a, pose_a, b, pose_b, &gap, &witness_a, &witness_b);
            write_distance(gap, witness_a, witness_b, outcome);
            break;
          }
          case Task::signed_distance: break;  // solved by the other two
          case Task::penetration:
            contacts_.clear();
            if (ask.intersect(solver_, a, pose_a, b, pose_b, &contacts_)) {
              write_depth(closed_form, pose_a, outcome);
            } else {
              outcome.answer = Answer::separated;
            }
            break;
        }
      } catch (...) {
        outcome.answer = Answer::unknown;
        outcome.status = Status::degenerate;
        clear_numbers(outcome);
      }
    }
  }

  static S default_tolerance(Task task) {
    return asks_distance(task) ? fcl::DistanceRequest<S>().distance_tolerance
                               : fcl::CollisionRequest<S>().gjk_tolerance;
  }

  static void write_distance(S gap, const Vec3<S>& witness_a, const Vec3<S>& witness_b,
                             Outcome& outcome) {
    if (std::isnan(gap)) {
      outcome.answer = Answer::unknown;
      outcome.status = Status::degenerate;
      clear_numbers(outcome);
    } else if (gap < 0) {
      outcome.answer = Answer::overlapping;
    } else {
      outcome.answer = gap > 0 ? Answer::separated : Answer::touching;
      outcome.distance = static_cast<double>(gap);
      outcome.lower = outcome.upper = Outcome::none;
      outcome.normal.setConstant(Outcome::none);
      outcome.witness_a = witness_a.template cast<double>();
      outcome.witness_b = witness_b.template cast<double>();
    }
  }

  void write_depth(bool closed_form, const fcl::Transform3<S>& pose_a, Outcome& outcome) const {
    outcome.answer = Answer::overlapping;
    clear_numbers(outcome);
    if (contacts_.empty()) return;
    const fcl::ContactPoint<S>& deepest =
        *std::ranges::max_element(contacts_, {}, &fcl::ContactPoint<S>::penetration_depth);
    S depth = deepest.penetration_depth;
    Vec3<S> normal = deepest.normal;
    if (!closed_form && std::is_same_v<Solver<S>, fcl::detail::GJKSolver_indep<S>>) {
      depth = -depth;
      normal = pose_a.linear() * normal;
    }
    if (!(depth >= 0)) {
      outcome.status = Status::degenerate;
      return;
    }
    outcome.distance = 0 - static_cast<double>(depth);
    // FCL returns a zero vector if it has no direction.
    if (normal.squaredNorm() > S(0.5)) outcome.normal = normal.template cast<double>();
  }

  std::optional<double> tolerance_;
  Solver<S> solver_;
  std::vector<std::unique_ptr<fcl::ShapeBase<S>>> shapes_;
  std::vector<double> reaches_;
  std::vector<fcl::ContactPoint<S>> contacts_;
  SignedByTwo signed_;
};

template <class S, template <class> class Solver>
std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  return std::make_unique<Fcl<S, Solver>>(settings);
}

template <class S>
constexpr auto make_libccd = make<S, fcl::detail::GJKSolver_libccd>;
template <class S>
constexpr auto make_indep = make<S, fcl::detail::GJKSolver_indep>;

}  // namespace touchstone::fcl_solvers
#else
#include "algorithms/peers/not_built.h"
namespace touchstone::fcl_solvers {
using not_built::matrix_encoding, not_built::quaternion_encoding, not_built::supports;
template <class S>
constexpr std::nullptr_t make_libccd = nullptr;
template <class S>
constexpr std::nullptr_t make_indep = nullptr;
}  // namespace touchstone::fcl_solvers
#endif

namespace touchstone::fcl_solvers {

// The entries of one scalar.
template <class S>
std::vector<NarrowPhaseEntry> entries() {
  using enum Task;
  const std::vector<Task> tasks(all_tasks.begin(), all_tasks.end());
  const std::vector<Precision> scalars = {std::is_same_v<S, float> ? Precision::float32
                                                                   : Precision::float64};
  return {
      {.info = {.name = "fcl-libccd",
                .citation = "FCL 0.7, GJKSolver_libccd: shapeIntersect, shapeDistance",
                .origin = Origin::peer,
                .known_defect = "the depth is MPR's, an upper bound; cone or half-space on "
                                "half-space is wrong"},
       .tasks = tasks,
       .scalars = scalars,
       .supports = supports,
       .traits = {.depth_is_bound = true},
       .encoding = quaternion_encoding,
       .tolerance = "how far the surface is beyond MPR's portal, and the least gain of a step of a "
                    "distance; 1e-6 m",
       .make = make_libccd<S>},
      {.info = {.name = "fcl-indep",
                .citation = "FCL 0.7, GJKSolver_indep: shapeIntersect, shapeDistance",
                .origin = Origin::peer,
                .known_defect =
                    "gaps below 1e-6 are overlaps; EPA fails on coplanar supports; cone "
                    "on half-space is wrong"},
       .tasks = tasks,
       .scalars = scalars,
       .supports = supports,
       .encoding = matrix_encoding,
       .tolerance = "a length for EPA and for `inside`, and a part of the distance for GJK; 1e-6",
       .make = make_indep<S>},
  };
}

}  // namespace touchstone::fcl_solvers
