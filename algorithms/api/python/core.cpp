// The Python module, over the interface in C++.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <touchstone/touchstone.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "algorithms/api/python/arrays.h"

namespace {

using namespace touchstone_python;  // NOLINT(google-build-using-namespace)

ts::Question question_of(const std::string& word) {
  constexpr std::array words = {"intersect", "distance", "penetration", "signed_distance"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (word == words[i]) return static_cast<ts::Question>(i);
  }
  throw ts::Error("found the question '" + word +
                  "'; expected intersect, distance, penetration or signed_distance");
}

// A result as NumPy has it.
py::dtype result_dtype() {
  const auto add = [](py::list& names, py::list& formats, py::list& offsets, const char* name,
                      const char* format, std::size_t offset) {
    names.append(name);
    formats.append(py::dtype::from_args(py::str(format)));
    offsets.append(offset);
  };
  py::list names, formats, offsets;
  add(names, formats, offsets, "answer", "u1", offsetof(ts::Result, answer));
  add(names, formats, offsets, "status", "u1", offsetof(ts::Result, status));
  add(names, formats, offsets, "distance", "f8", offsetof(ts::Result, distance));
  add(names, formats, offsets, "lower", "f8", offsetof(ts::Result, lower));
  add(names, formats, offsets, "upper", "f8", offsetof(ts::Result, upper));
  add(names, formats, offsets, "normal", "(3,)f8", offsetof(ts::Result, normal));
  add(names, formats, offsets, "on_a", "(3,)f8", offsetof(ts::Result, on_a));
  add(names, formats, offsets, "on_b", "(3,)f8", offsetof(ts::Result, on_b));
  return {names, formats, offsets, static_cast<py::ssize_t>(sizeof(ts::Result))};
}

// Bodies in arrays, for many pairs.
struct Bodies {
  std::vector<ts::Body> bodies;

  Bodies(const std::vector<ts::Shape>& shapes, const py::object& places, const Doubles& poses) {
    const auto shape_of = integers_of<Places>(places, "shape_of");
    check(shape_of, {-1}, "shape_of");
    const py::ssize_t count = shape_of.shape(0);
    check(poses, {count, 4, 4}, "poses");
    bodies.reserve(static_cast<std::size_t>(count));
    for (py::ssize_t i = 0; i < count; ++i) {
      if (shape_of.at(i) >= shapes.size()) {
        throw ts::Error("found shape " + std::to_string(shape_of.at(i)) + " of body " +
                        std::to_string(i) + "; expected less than " +
                        std::to_string(shapes.size()));
      }
      bodies.push_back({shapes[shape_of.at(i)], pose_of_matrix(poses.data() + 16 * i)});
    }
  }
  void move(const Doubles& poses) {
    check(poses, {static_cast<py::ssize_t>(bodies.size()), 4, 4}, "poses");
    for (std::size_t i = 0; i < bodies.size(); ++i)
      bodies[i].pose = pose_of_matrix(poses.data() + 16 * i);
  }
};

// Returns the array, or a new one. A new one costs more than many answers: its pages come from the system.
py::array room_for(std::size_t count, const py::dtype& dtype, const py::object& given) {
  if (given.is_none()) return py::array(dtype, std::vector<std::size_t>{count});
  if (!py::isinstance<py::array>(given))
    throw ts::Error("found no array as out; expected what ask returned");
  const auto array = py::reinterpret_borrow<py::array>(given);
  const bool fits = array.dtype().equal(dtype) && array.ndim() == 1 &&
                    array.shape(0) == static_cast<py::ssize_t>(count) && array.writeable() &&
                    (array.flags() & py::array::c_style) != 0 &&
                    reinterpret_cast<std::uintptr_t>(array.data()) % alignof(ts::Result) == 0;
  if (fits) return array;
  throw ts::Error(
      "found out of the shape " + shape_text(array) +
      "; expected an aligned array for writing, without gaps, with the fields of ask and the "
      "length " +
      std::to_string(count));
}

py::array ask_many(ts::Solver& solver, const std::string& question, const Bodies& bodies,
                   const py::object& rows, const py::object& out) {
  const auto pairs = integers_of<Places>(rows, "pairs");
  check(pairs, {-1, 2}, "pairs");
  static const auto& dtype = *new py::dtype(result_dtype());  // Python ends before statics do
  const auto count = static_cast<std::size_t>(pairs.shape(0));
  static_assert(sizeof(ts::IndexPair) == 2 * sizeof(std::uint32_t) &&
                std::is_trivially_copyable_v<ts::Result>);
  py::array results = room_for(count, dtype, out);
  solver.ask(question_of(question), bodies.bodies,
             std::span(reinterpret_cast<const ts::IndexPair*>(pairs.data()), count),
             std::span(static_cast<ts::Result*>(results.mutable_data()), count));
  return results;
}

std::uint64_t number(const ts::Handle& handle) {
  return std::uint64_t{handle.generation} << 32 | handle.slot;
}
ts::Handle handle_of(std::uint64_t number) {
  return {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32)};
}

ts::Box box_of(const double* numbers) { return {vec(numbers), vec(numbers + 3)}; }

// So that a wrong row changes nothing.
void check_boxes(const Doubles& boxes) {
  for (py::ssize_t i = 0; i < boxes.shape(0); ++i) {
    const double* const box = boxes.data() + 6 * i;
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double most = std::numeric_limits<float>::max();
      if (-most <= box[axis] && box[axis] <= box[axis + 3] && box[axis + 3] <= most) continue;
      throw ts::Error("found a wrong box in row " + std::to_string(i) +
                      "; expected finite floats, minimum <= maximum");
    }
  }
}

// So that a wrong handle changes nothing.
void check_handles(const ts::World& world, const Handles& handles) {
  std::vector<std::uint64_t> all(handles.data(), handles.data() + handles.size());
  for (const std::uint64_t one : all) {
    if (!world.contains(handle_of(one))) {
      throw ts::Error("found the handle " + std::to_string(one) +
                      ", which no body has; expected one of a body in this world");
    }
  }
  std::sort(all.begin(), all.end());
  if (std::adjacent_find(all.begin(), all.end()) != all.end()) {
    throw ts::Error("found a handle twice; expected each once");
  }
}

Handles insert_boxes(ts::World& world, const Doubles& boxes) {
  check(boxes, {-1, 6}, "boxes");
  check_boxes(boxes);
  Handles handles(boxes.shape(0));
  for (py::ssize_t i = 0; i < boxes.shape(0); ++i) {
    handles.mutable_at(i) = number(world.insert(box_of(boxes.data() + 6 * i)));
  }
  return handles;
}

void move_boxes(ts::World& world, const py::object& bodies, const Doubles& boxes) {
  const auto handles = integers_of<Handles>(bodies, "handles");
  check(handles, {-1}, "handles");
  check(boxes, {handles.shape(0), 6}, "boxes");
  check_handles(world, handles);
  check_boxes(boxes);
  for (py::ssize_t i = 0; i < handles.shape(0); ++i) {
    world.move(handle_of(handles.at(i)), box_of(boxes.data() + 6 * i));
  }
}

void remove_all(ts::World& world, const py::object& bodies) {
  const auto handles = integers_of<Handles>(bodies, "handles");
  check(handles, {-1}, "handles");
  check_handles(world, handles);
  for (py::ssize_t i = 0; i < handles.shape(0); ++i) world.remove(handle_of(handles.at(i)));
}

Handles pairs_of(ts::World& world) {
  std::vector<std::uint64_t> numbers;
  world.for_each_pair([&](const ts::Handle& a, const ts::Handle& b) {
    numbers.push_back(number(a));
    numbers.push_back(number(b));
  });
  return Handles({numbers.size() / 2, std::size_t{2}}, numbers.data());
}

Handles rows_of(std::span<const ts::HandlePair> pairs) {
  Handles handles({pairs.size(), std::size_t{2}});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    handles.mutable_at(i, 0) = number(pairs[i].a);
    handles.mutable_at(i, 1) = number(pairs[i].b);
  }
  return handles;
}

py::object hit_of(ts::World& world, const Doubles& origin, const Doubles& direction, double t_max) {
  const ts::RayHit hit =
      world.ray({vec_of(origin, "an origin"), vec_of(direction, "a direction"), t_max});
  if (hit.status != ts::Status::ok) throw ts::Error("the ray could not be answered");
  if (!hit.hit) return py::none();
  return py::make_tuple(number(hit.body), hit.t, array_of(hit.normal));
}

template <class Enum>
const char* word_of(Enum value, std::span<const char* const> words) {
  return words[static_cast<std::size_t>(value)];
}
constexpr std::array<const char*, 4> answers = {"separated", "touching", "overlapping", "unknown"};
constexpr std::array<const char*, 5> statuses = {"ok", "not_converged", "degenerate", "capacity",
                                                 "unsupported"};
constexpr std::array<const char*, 3> cast_answers = {"hit", "miss", "unknown"};
constexpr std::array<const char*, 8> kinds = {"sphere", "capsule",   "box",  "cylinder",
                                              "cone",   "ellipsoid", "hull", "halfspace"};

// The arguments of the function of its kind, by their names.
py::dict parameters_of(const ts::Shape& shape) {
  const std::vector<double> numbers = shape.numbers();
  const auto vector = [&] { return py::array_t<double>(3, numbers.data()); };
  py::dict named;
  switch (shape.kind()) {
    case ts::Kind::sphere: named["radius"] = numbers[0]; break;
    case ts::Kind::capsule:
    case ts::Kind::cylinder:
    case ts::Kind::cone:
      named["radius"] = numbers[0];
      named["half_length"] = numbers[1];
      break;
    case ts::Kind::box: named["half_extents"] = vector(); break;
    case ts::Kind::ellipsoid: named["radii"] = vector(); break;
    case ts::Kind::hull:
      named["points"] = py::array_t<double>({numbers.size() / 3, std::size_t{3}}, numbers.data());
      break;
    case ts::Kind::halfspace:
      named["normal"] = vector();
      named["offset"] = numbers[3];
      break;
  }
  return named;
}

py::array_t<double> matrix_of(const ts::Pose& pose) {
  py::array_t<double> matrix({4, 4});
  const ts::Vec3 &x = pose.x_axis, &y = pose.y_axis, &z = pose.z_axis, &t = pose.translation;
  const std::array rows = {x.x, y.x, z.x, t.x, x.y, y.y, z.y, t.y,
                           x.z, y.z, z.z, t.z, 0.,  0.,  0.,  1.};
  std::copy(rows.begin(), rows.end(), matrix.mutable_data());
  return matrix;
}

std::string result_text(const ts::Result& result) {
  return "Result(answer='" + std::string(word_of(result.answer, answers)) + "', status='" +
         word_of(result.status, statuses) + "', distance=" + std::to_string(result.distance) + ")";
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "What of the package touchstone is in C++.";
  module.attr("__name__") = "touchstone";  // where users find its classes
  py::register_exception<ts::Error>(module, "Error", PyExc_ValueError);
  module.attr("__version__") = ts::version();
  module.attr("ANSWERS") = py::tuple(py::cast(answers));
  module.attr("STATUSES") = py::tuple(py::cast(statuses));

  py::class_<ts::Shape>(module, "Shape",
                        "A convex shape, which never changes. Sizes are metres, at least 0.")
      .def_static("sphere", &ts::Shape::sphere, py::arg("radius"))
      .def_static("capsule", &ts::Shape::capsule, py::arg("radius"), py::arg("half_length"),
                  "Along z, with a half ball beyond both ends of -half_length to half_length.")
      .def_static(
          "box", [](const Doubles& half) { return ts::Shape::box(vec_of(half, "half_extents")); },
          py::arg("half_extents"), "half_extents: (3,)")
      .def_static("cylinder", &ts::Shape::cylinder, py::arg("radius"), py::arg("half_length"),
                  "Along z.")
      .def_static("cone", &ts::Shape::cone, py::arg("radius"), py::arg("half_length"),
                  "Along z, with its base at -half_length and its tip at half_length.")
      .def_static(
          "ellipsoid",
          [](const Doubles& radii) { return ts::Shape::ellipsoid(vec_of(radii, "radii")); },
          py::arg("radii"), "radii: (3,)")
      .def_static(
          "hull",
          [](const Doubles& points) {
            check(points, {-1, 3}, "points");
            static_assert(sizeof(ts::Vec3) == 3 * sizeof(double));
            std::vector<ts::Vec3> all(static_cast<std::size_t>(points.shape(0)));
            for (std::size_t i = 0; i < all.size(); ++i) all[i] = vec(points.data() + 3 * i);
            return ts::Shape::hull(all);
          },
          py::arg("points"), "The convex hull of points (n, 3), at least one.")
      .def_static(
          "halfspace",
          [](const Doubles& normal, double offset) {
            return ts::Shape::halfspace(vec_of(normal, "a normal"), offset);
          },
          py::arg("normal"), py::arg("offset"),
          "The points p with normal . p <= offset. normal: (3,)")
      .def_property_readonly(
          "kind", [](const ts::Shape& shape) { return word_of(shape.kind(), kinds); },
          "'sphere', 'capsule', 'box', 'cylinder', 'cone', 'ellipsoid', 'hull' "
          "or 'halfspace'")
      .def_property_readonly(
          "parameters", &parameters_of,
          "The arguments of the function of its kind, a dictionary. Of a hull the "
          "vertices (n, 3); points that are none may be missing.")
      .def("__repr__", [](const ts::Shape& shape) {
        return "<touchstone.Shape " + std::string(word_of(shape.kind(), kinds)) + ">";
      });

  py::class_<ts::Body>(module, "Body", "A shape at a pose.")
      .def(py::init([](const ts::Shape& shape, const py::object& pose) {
             return ts::Body{shape, pose_of(pose)};
           }),
           py::arg("shape"), py::arg("pose") = py::none())
      .def_readonly("shape", &ts::Body::shape)
      .def_property_readonly(
          "pose", [](const ts::Body& body) { return matrix_of(body.pose); }, "(4, 4), a copy")
      .def(
          "move", [](ts::Body& body, const py::object& pose) { body.pose = pose_of(pose); },
          py::arg("pose"));

  py::class_<ts::Result>(module, "Result",
                         "Numbers that were not asked for, or are not known, are NaN.")
      .def_property_readonly(
          "answer", [](const ts::Result& r) { return word_of(r.answer, answers); },
          "'separated', 'touching', 'overlapping' or 'unknown'")
      .def_property_readonly(
          "status", [](const ts::Result& r) { return word_of(r.status, statuses); },
          "'ok', or why the answer is unknown")
      .def_readonly("distance", &ts::Result::distance, "metres: > 0 the gap, < 0 minus the depth")
      .def_readonly("lower", &ts::Result::lower,
                    "bound on the signed distance, where the algorithm has it")
      .def_readonly("upper", &ts::Result::upper,
                    "bound on the signed distance, where the algorithm has it")
      .def_property_readonly(
          "normal", [](const ts::Result& r) { return array_of(r.normal); },
          "(3,), unit vector from a to b")
      .def_property_readonly(
          "on_a", [](const ts::Result& r) { return array_of(r.on_a); }, "(3,), witness point")
      .def_property_readonly(
          "on_b", [](const ts::Result& r) { return array_of(r.on_b); }, "(3,), witness point")
      .def("__bool__",
           [](const ts::Result&) -> bool {
             throw ts::Error("a result is neither true nor false; ask its answer");
           })
      .def("__repr__", &result_text);

  py::class_<ts::CastResult>(module, "CastResult", "What Solver.cast found.")
      .def_property_readonly(
          "answer", [](const ts::CastResult& r) { return word_of(r.answer, cast_answers); },
          "'hit', 'miss' or 'unknown'")
      .def_property_readonly("status",
                             [](const ts::CastResult& r) { return word_of(r.status, statuses); })
      .def_readonly("time", &ts::CastResult::time,
                    "the first at which the bodies share a point, in [0, 1]")
      .def_property_readonly("normal", [](const ts::CastResult& r) { return array_of(r.normal); })
      .def_property_readonly("point", [](const ts::CastResult& r) { return array_of(r.point); });

  py::class_<Bodies>(module, "Bodies", "Many bodies, for Solver.ask.")
      .def(py::init<const std::vector<ts::Shape>&, const py::object&, const Doubles&>(),
           py::arg("shapes"), py::arg("shape_of"), py::arg("poses"),
           "Body i has shapes[shape_of[i]] and the matrix poses[i]. shape_of: (n,); poses: (n, 4, "
           "4)")
      .def("move", &Bodies::move, py::arg("poses"), "poses: (n, 4, 4)")
      .def("__len__", [](const Bodies& bodies) { return bodies.bodies.size(); });

  const auto asks = [](ts::Question question) {
    return [question](ts::Solver& solver, const ts::Body& a, const ts::Body& b) {
      return solver.ask(question, a, b);
    };
  };
  py::class_<ts::Solver>(module, "Solver",
                         "Asks algorithms about pairs. One thread at a time uses it.")
      .def(py::init([](const std::string& algorithm, const std::string& cast_algorithm,
                       std::optional<double> tolerance, std::optional<double> margin) {
             return ts::Solver({algorithm, cast_algorithm, tolerance, margin});
           }),
           py::arg("algorithm") = "", py::arg("cast_algorithm") = "",
           py::arg("tolerance") = py::none(), py::arg("margin") = py::none(),
           "Without a name, what Touchstone's tables recommend for each two kinds. tolerance: part "
           "of the size of a "
           "pair. margin: metres; bodies further apart have no number.")
      .def(
          "prepare",
          [](ts::Solver& solver, const std::vector<ts::Shape>& shapes) { solver.prepare(shapes); },
          py::arg("shapes"),
          "Keeps what algorithms prepare for these, in place of those of the last call.")
      .def("intersects", &ts::Solver::intersects, py::arg("a"), py::arg("b"),
           "Whether the bodies share a point.")
      .def("distance", asks(ts::Question::distance), py::arg("a"), py::arg("b"),
           "As touchstone.distance.")
      .def("penetration", asks(ts::Question::penetration), py::arg("a"), py::arg("b"),
           "As touchstone.penetration.")
      .def("signed_distance", asks(ts::Question::signed_distance), py::arg("a"), py::arg("b"),
           "As touchstone.signed_distance.")
      .def("ask", &ask_many, py::arg("question"), py::arg("bodies"), py::arg("pairs"),
           py::arg("out") = py::none(),
           "Answers each row of pairs (m, 2), two places in bodies: an array (m,) with the fields "
           "answer (place in ANSWERS), status (in STATUSES), distance, lower, upper, normal, on_a, "
           "on_b. question: 'intersect', 'distance', 'penetration' or 'signed_distance'. out: an "
           "array that an earlier call returned, to write into; it saves the memory of a new one.")
      .def(
          "cast",
          [](ts::Solver& solver, const ts::Body& a, const Doubles& by_a, const ts::Body& b,
             const Doubles& by_b) {
            return solver.cast(a, {vec_of(by_a, "a displacement"), {}}, b,
                               {vec_of(by_b, "a displacement"), {}});
          },
          py::arg("a"), py::arg("displacement_a"), py::arg("b"), py::arg("displacement_b"),
          "When the bodies first touch while they move by these, (3,) each, from time 0 to 1.");

  module.def(
      "intersects", [](const ts::Body& a, const ts::Body& b) { return ts::intersects(a, b); },
      py::arg("a"), py::arg("b"),
      "Whether the bodies share a point. Raises touchstone.Error where no algorithm could decide.");
  module.def(
      "distance", [](const ts::Body& a, const ts::Body& b) { return ts::distance(a, b); },
      py::arg("a"), py::arg("b"),
      "The gap between bodies that are apart, in metres, with the closest points; else the answer "
      "alone.");
  module.def(
      "penetration", [](const ts::Body& a, const ts::Body& b) { return ts::penetration(a, b); },
      py::arg("a"), py::arg("b"),
      "The depth of bodies that overlap, as a negative distance in metres; else the answer alone.");
  module.def(
      "signed_distance",
      [](const ts::Body& a, const ts::Body& b) { return ts::signed_distance(a, b); }, py::arg("a"),
      py::arg("b"), "The gap, or minus the depth, in metres.");
  module.def("certificate", &ts::certificate, py::arg("a"), py::arg("b"),
             "The line of JSON of touchstone.exact.");
  module.def("algorithm_names", &ts::algorithm_names, py::arg("kind"),
             "kind: 'pair', 'cast' or 'box'");

  py::class_<ts::World>(
      module, "World",
      "Bodies, and which of their boxes overlap. Handles are integers. Pairs are those of the last "
      "update; rays meet the bodies where they are now.")
      .def(py::init([](const std::string& broad_phase, int threads) {
             return ts::World({broad_phase, threads});
           }),
           py::arg("broad_phase") = "auto", py::arg("threads") = 1)
      .def(
          "insert",
          [](ts::World& world, const ts::Shape& shape, const py::object& pose) {
            return number(world.insert(shape, pose_of(pose)));
          },
          py::arg("shape"), py::arg("pose") = py::none(), "Returns the handle of the new body.")
      .def(
          "move",
          [](ts::World& world, std::uint64_t body, const py::object& pose) {
            world.move(handle_of(body), pose_of(pose));
          },
          py::arg("body"), py::arg("pose"))
      .def("insert_boxes", &insert_boxes, py::arg("boxes"),
           "boxes: (n, 6), minimum and maximum. Returns n handles. No ray meets a box without a "
           "shape.")
      .def("move_boxes", &move_boxes, py::arg("bodies"), py::arg("boxes"),
           "bodies: (n,) handles; boxes: (n, 6)")
      .def(
          "remove", [](ts::World& world, std::uint64_t body) { world.remove(handle_of(body)); },
          py::arg("body"))
      .def("remove", &remove_all, py::arg("bodies"), "bodies: (n,) handles")
      .def("__len__", &ts::World::size)
      .def("__contains__", [](const ts::World& world,
                              std::uint64_t body) { return world.contains(handle_of(body)); })
      .def(
          "body",
          [](const ts::World& world, std::uint64_t body) { return world.body(handle_of(body)); },
          py::arg("body"))
      .def("update", &ts::World::update)
      .def("pairs", &pairs_of, "All pairs of boxes that overlap: (m, 2) handles.")
      .def(
          "changes",
          [](ts::World& world) {
            const ts::World::Changes changes = world.changes();
            return py::make_tuple(rows_of(changes.began), rows_of(changes.ended));
          },
          "Two arrays (m, 2) of handles: pairs that began, and that ended, since the last call.")
      .def("ray", &hit_of, py::arg("origin"), py::arg("direction"),
           py::arg("t_max") = std::numeric_limits<double>::infinity(),
           "None, or (handle, t, normal) of the first body with a shape on origin + t * direction, "
           "(3,) each.");
}
