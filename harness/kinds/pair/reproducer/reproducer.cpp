// Writes pairs and their exact answers as the cases of a test.
#include "harness/kinds/pair/reproducer/reproducer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/names.h"
#include "harness/files/json_line.h"
#include "harness/grade/margins.h"
#include "harness/grade/true_case.h"
#include "harness/kinds/pair/reproducer/library_tests.h"

namespace touchstone::kinds {
namespace {

// What a test expects, as its text has it.
struct ExpectedAnswer {
  int side = 0;                                  // 1 separated, -1 overlapping, 0 either
  double number = 0;                             // the signed distance, metres
  double tolerance = 0;                          // of the number, metres
  bool has_distance = false, has_depth = false;  // the number is asked for
};

// A double as C++ reads it back, with the mark of a double.
std::string number_text(double x) {
  std::string text = fmt::format("{}", x);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

template <class Numbers>
std::string numbers_text(const Numbers& numbers) {
  std::vector<std::string> texts;
  for (const double x : numbers) texts.push_back(number_text(x));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string hull_text(const Hull& hull) {
  std::vector<std::string> vertices;
  for (const Vec3d& v : hull.vertices) vertices.push_back("{" + numbers_text(v) + "}");
  std::vector<std::uint32_t> faces;
  for (const Hull::Face& face : hull.faces) {
    faces.push_back(static_cast<std::uint32_t>(face.loop.size()));
    faces.insert(faces.end(), face.loop.begin(), face.loop.end());
  }
  return fmt::format("hull({{{}}}, {{{}}})", fmt::join(vertices, ", "), fmt::join(faces, ", "));
}

std::string body_text(const Shape& shape) {
  const auto call = [&](std::initializer_list<double> sizes) {
    return fmt::format("{}({})", to_string(shape.kind), numbers_text(sizes));
  };
  switch (shape.kind) {
    case ShapeKind::sphere: return call({shape.radius});
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: return call({shape.radius, shape.half_length});
    case ShapeKind::box: return fmt::format("box({})", numbers_text(shape.half_extents));
    case ShapeKind::ellipsoid: return fmt::format("ellipsoid({})", numbers_text(shape.radii));
    case ShapeKind::hull: return hull_text(*shape.hull);
    case ShapeKind::halfspace: break;
  }
  return "";
}

std::string pose_text(const Pose& pose) {
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows.push_back(pose.rotation(row, column));
  }
  return fmt::format("{{{{{}}}, {{{}}}}}", numbers_text(rows), numbers_text(pose.translation));
}

ExpectedAnswer expected_of(const oracle::Measure& truth, const files::Case& c, Task task,
                           const NarrowPhaseEntry& library) {
  const auto has = [&](Task asked) {
    return offers(library, c.shape_a.kind, c.shape_b.kind, asked);
  };
  ExpectedAnswer expected;
  expected.side = truth.answer == Answer::separated     ? 1
                  : truth.answer == Answer::overlapping ? -1
                                                        : 0;
  expected.number = truth.middle();
  expected.tolerance = grade::usual_depth_error * grade::pair_size(c);
  expected.has_distance = expected.side > 0 && asks_distance(task) && has(Task::distance);
  expected.has_depth = expected.side < 0 && asks_depth(task) && has(Task::penetration);
  return expected;
}

// Why the answer is known, for the reader.
std::string reason_text(const oracle::Measure& truth, const ExpectedAnswer& expected) {
  const std::string normal = numbers_text(Vec3d(truth.normal.normalized()));
  const std::string bounds = truth.lower == truth.upper
                                 ? fmt::format("{}", truth.lower)
                                 : fmt::format("{} to {}", truth.lower, truth.upper);
  if (expected.side > 0) {
    return fmt::format(
        "  // Separated: a plane across ({}) parts them. The exact distance is {} m.\n", normal,
        bounds);
  }
  if (expected.side < 0) {
    return fmt::format(
        "  // Overlapping: no translation shorter than the depth separates them; the one along\n"
        "  // ({}) does. The exact signed distance is {} m.\n",
        normal, bounds);
  }
  return fmt::format(
      "  // The exact signed distance is {} m: either side of contact is accepted.\n", bounds);
}

constexpr std::string_view rest_of_program = R"test(
struct Expected {
  int side;  // 1 separated, -1 overlapping, 0 either
  double number, tolerance;
  bool has_distance, has_depth;
};

int failures = 0;

void expect(bool holds, const char* id, const char* what, double found, double exact) {
  if (holds) return;
  ++failures;
  std::printf("%s: %s; found %.17g, exact %.17g\n", id, what, found, exact);
}

void check(const char* id, const Body& a, const Pose& pose_a, const Body& b, const Pose& pose_b,
           const Expected& expected) {
  const double found = signed_distance(a, pose_a, b, pose_b), exact = expected.number;
  if (expected.side != 0) {
    expect((found < 0) == (exact < 0), id,
           exact < 0 ? "no contact of bodies that overlap" : "contact of bodies that are apart",
           found, exact);
  }
  if (expected.has_distance && found > 0)
    expect(std::abs(found - exact) <= expected.tolerance, id, "wrong distance", found, exact);
  if (!expected.has_depth || found > 0) return;
  expect(found - exact <= expected.tolerance, id, "depth too small", found, exact);
  expect(DEPTH_IS_BOUND || exact - found <= expected.tolerance, id, "depth too great", found,
         exact);
}

int main() {
)test";

// Why the library's test cannot have the case; empty if it can.
std::string lack(const LibraryTest& test, const NarrowPhaseEntry& library, const files::Case& c,
                 const grade::EncodedPair& pair) {
  const auto offered = [&](Task task) {
    return offers(library, c.shape_a.kind, c.shape_b.kind, task);
  };
  for (const Shape& shape : {c.shape_a, c.shape_b}) {
    const std::string maker = fmt::format("Body {}(", to_string(shape.kind));
    if (test.preamble.find(maker) != std::string_view::npos) continue;
    return fmt::format("the library has no {}", to_string(shape.kind));
  }
  if (!pair.is_finite()) return "a number is beyond the range of floats";
  if (offered(Task::intersect) || offered(Task::penetration)) return "";
  return fmt::format("{} does not take a {} and a {}", test.algorithm, to_string(c.shape_a.kind),
                     to_string(c.shape_b.kind));
}

// What stands before the cases.
std::string head_of(const LibraryTest& test, const NarrowPhaseEntry& library,
                    const std::filesystem::path& file) {
  std::string text = fmt::format(
      "// Pairs of convex bodies whose answers are known exactly, asked of {}.\n"
      "// Made by Touchstone. It fails where the answer is on the wrong side of contact, or a "
      "number is off\n"
      "// by more than a thousandth of the pair's size. Lengths are metres{}.\n"
      "//\n"
      "//     g++ {} {} -std=c++17 -o reproducer && ./reproducer\n",
      library.info.citation, test.in_float ? "; all numbers are floats" : "",
      base::shell_word(file.filename().string()), test.compile);
  text += test.preamble;
  base::replace_all(text, "SOLVER", test.solver);
  if (!test.is_googletest) {
    std::string end(rest_of_program);
    base::replace_all(end, "DEPTH_IS_BOUND", library.traits.depth_is_bound ? "true" : "false");
    text += end;
  }
  return text;
}

}  // namespace

std::string names_with_reproducers() {
  std::vector<std::string_view> names;
  for (const LibraryTest& test : library_tests()) names.push_back(test.algorithm);
  return fmt::format("{}", fmt::join(names, ", "));
}

bool has_reproducer(std::string_view algorithm) {
  return std::ranges::find(library_tests(), algorithm, &LibraryTest::algorithm) !=
         library_tests().end();
}

std::string reproducer(std::string_view algorithm, std::span<const files::Case> cases, Task task,
                       const std::filesystem::path& file) {
  const auto test = std::ranges::find(library_tests(), algorithm, &LibraryTest::algorithm);
  const NarrowPhaseEntry* const library = registry::find<NarrowPhaseEntry>(algorithm);
  if (test == library_tests().end() || library == nullptr) {
    throw base::InputError(fmt::format("'{}' has no form as a test; expected one of {}", algorithm,
                                       names_with_reproducers()));
  }
  oracle::Oracle oracle;
  std::string text = head_of(*test, *library, file);
  std::size_t number = 0;
  std::string left_out;
  for (const files::Case& given : cases) {
    const files::Case c = test->in_float ? grade::rounded_to_floats(given) : given;
    const grade::EncodedPair pair(c, Encoding::as_given);
    left_out = lack(*test, *library, c, pair);
    if (!left_out.empty()) {
      text += fmt::format("  // Case {} is left out: {}.\n", files::Json(c.id).dump(), left_out);
      continue;
    }
    ++number;
    const oracle::Measure truth = oracle.measure(pair.a(), pair.b());
    const ExpectedAnswer expected = expected_of(truth, c, task, *library);
    if (test->is_googletest) text += fmt::format("\nTEST(ExactPairs, Case{}) {{\n", number);
    text += reason_text(truth, expected);
    text += fmt::format(
        "  check({}, {},\n        {},\n        {},\n        {},\n"
        "        {{{}, {}, {}, {}, {}}});\n",
        files::Json(c.id).dump(), body_text(c.shape_a), pose_text(c.pose_a), body_text(c.shape_b),
        pose_text(c.pose_b), expected.side, number_text(expected.number),
        number_text(expected.tolerance), expected.has_distance, expected.has_depth);
    if (test->is_googletest) text += "}\n";
  }
  if (number == 0) {
    throw base::InputError(fmt::format("--as-test has no case for {}: {}", algorithm, left_out));
  }
  if (!test->is_googletest) text += "  return failures == 0 ? 0 : 1;\n}\n";
  return text;
}

}  // namespace touchstone::kinds
