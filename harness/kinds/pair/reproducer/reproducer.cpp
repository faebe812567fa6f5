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
#include "harness/files/case_json.h"
#include "harness/files/json_line.h"
#include "harness/grade/margins.h"
#include "harness/grade/true_case.h"
#include "harness/kinds/pair/reproducer/library_tests.h"
#include "harness/kinds/pair/reproducer/script_tests.h"

namespace touchstone::kinds {
namespace {

// An id as a comment may have it: in ASCII, for JavaScript ends a comment at other line breaks as well.
std::string in_comment(const std::string& id) { return files::Json(id).dump(-1, ' ', true); }

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

// Why the answer is known, for the reader: lines behind this mark of a comment.
std::string reason_text(const oracle::Measure& truth, int side, std::string_view mark) {
  const std::string normal = numbers_text(Vec3d(truth.normal.normalized()));
  const std::string bounds = truth.lower == truth.upper
                                 ? fmt::format("{}", truth.lower)
                                 : fmt::format("{} to {}", truth.lower, truth.upper);
  if (side > 0) {
    return fmt::format("{}Separated: a plane across ({}) parts them. The exact distance is {} m.\n",
                       mark, normal, bounds);
  }
  if (side < 0) {
    return fmt::format(
        "{0}Overlapping: no translation shorter than the depth separates them; the one along\n"
        "{0}({1}) does. The exact signed distance is {2} m.\n",
        mark, normal, bounds);
  }
  return fmt::format("{}The exact signed distance is {} m: either side of contact is accepted.\n",
                     mark, bounds);
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

// --- Python and JavaScript ---

// The library of an algorithm such as "mujoco@3.10.0"; empty if it has no version.
std::string_view library_of(std::string_view algorithm) {
  const std::size_t at = algorithm.find('@');
  return at == std::string_view::npos ? "" : algorithm.substr(0, at);
}

// The tests of a library, one for each language.
std::vector<const ScriptTest*> scripts_of(std::string_view algorithm) {
  std::vector<const ScriptTest*> found;
  for (const ScriptTest& test : script_tests()) {
    if (test.library == library_of(algorithm)) found.push_back(&test);
  }
  return found;
}

const ScriptTest& script_of(std::string_view algorithm, std::string_view version,
                            const std::filesystem::path& file) {
  std::vector<std::string_view> extensions;
  for (const ScriptTest* test : scripts_of(algorithm)) {
    if (test->lacks == version) continue;
    if (file.extension() == test->extension) return *test;
    extensions.push_back(test->extension);
  }
  throw base::InputError(fmt::format("'{}': a test of {} is no such file; expected one of {}",
                                     file.string(), algorithm, fmt::join(extensions, ", ")));
}

// A case as an object of both languages, behind what is exact of it.
std::string script_case(const ScriptTest& test, const files::Case& c, Task task,
                        oracle::Oracle& oracle) {
  const grade::EncodedPair pair(c, Encoding::as_given);
  const oracle::Measure truth = oracle.measure(pair.a(), pair.b());
  const double tolerance = script_error * grade::pair_size(c);
  const double number = truth.middle();
  const int side = number > tolerance ? 1 : number < -tolerance ? -1 : 0;
  const files::OrderedJson object = {{"id", c.id},
                                     {"a", files::body_to_json(c.shape_a, c.pose_a)},
                                     {"b", files::body_to_json(c.shape_b, c.pose_b)},
                                     {"side", side},
                                     {"number", number},
                                     {"tolerance", tolerance},
                                     {"has_distance", asks_distance(task) ? 1 : 0},
                                     {"has_depth", asks_depth(task) ? 1 : 0}};
  return reason_text(truth, side, test.is_python() ? "    # " : "  // ") +
         (test.is_python() ? "    " : "  ") + object.dump() + ",\n";
}

std::string script_reproducer(std::string_view algorithm, std::span<const files::Case> cases,
                              Task task, const std::filesystem::path& file) {
  const std::string_view version = algorithm.substr(library_of(algorithm).size() + 1);
  const ScriptTest& test = script_of(algorithm, version, file);
  const std::string_view mark = test.is_python() ? "#" : "//";
  const std::string name = base::shell_word(file.filename().string());
  std::string text = fmt::format(
      "{0} Pairs of convex bodies whose answers are known exactly, asked of {1} {2}, {3}.\n"
      "{0} Made by Touchstone. It fails where the answer is on the wrong side of contact, or a "
      "number is off,\n"
      "{0} by more than {4:g} of the pair's size. Lengths are metres{5}.\n"
      "{0}\n"
      "{0}     {6}\n",
      mark, test.package, version, test.function, script_error,
      test.in_float ? "; all numbers are floats" : "",
      test.is_python()
          ? fmt::format("pip install {}=={} && python3 {}", test.package, version, name)
          : fmt::format("npm install {}@{} && node {}", test.package, version, name));
  text += test.head;
  base::replace_all(text, "PACKAGE", test.package);
  text += test.is_python() ? "\n\ncases = [\n" : "\nconst cases = [\n";
  oracle::Oracle oracle;
  bool has_case = false;
  std::string left_out;
  for (const files::Case& given : cases) {
    const files::Case c = test.in_float ? grade::rounded_to_floats(given) : given;
    left_out.clear();
    for (const Shape& shape : {c.shape_a, c.shape_b}) {
      if (test.shapes.find(fmt::format(" {} ", to_string(shape.kind))) != std::string_view::npos)
        continue;
      left_out = fmt::format("the library has no {}", to_string(shape.kind));
    }
    if (!grade::EncodedPair(c, Encoding::as_given).is_finite()) {
      left_out = "a number is beyond the range of floats";
    }
    if (left_out.empty()) {
      text += script_case(test, c, task, oracle);
      has_case = true;
    } else {
      text += fmt::format("{} Case {} is left out: {}.\n", mark, in_comment(c.id), left_out);
    }
  }
  if (!has_case) {
    throw base::InputError(fmt::format("--as-test has no case for {}: {}", algorithm, left_out));
  }
  text += test.is_python() ? "]" : "];\n";
  text += script_end(test);
  return text;
}

}  // namespace

std::string names_with_reproducers() {
  std::vector<std::string_view> names;
  for (const LibraryTest& test : library_tests()) names.push_back(test.algorithm);
  for (const ScriptTest& test : script_tests()) {
    if (std::ranges::find(names, test.library) == names.end()) names.push_back(test.library);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string reproducer_file(std::string_view algorithm) {
  const std::vector<const ScriptTest*> scripts = scripts_of(algorithm);
  if (!scripts.empty()) return fmt::format("{}_test{}", algorithm, scripts.front()->extension);
  const bool is_known = std::ranges::find(library_tests(), algorithm, &LibraryTest::algorithm) !=
                        library_tests().end();
  return is_known ? fmt::format("{}_test.cpp", algorithm) : "";
}

std::string reproducer(std::string_view algorithm, std::span<const files::Case> cases, Task task,
                       const std::filesystem::path& file) {
  if (!scripts_of(algorithm).empty()) return script_reproducer(algorithm, cases, task, file);
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
      text += fmt::format("  // Case {} is left out: {}.\n", in_comment(c.id), left_out);
      continue;
    }
    ++number;
    const oracle::Measure truth = oracle.measure(pair.a(), pair.b());
    const ExpectedAnswer expected = expected_of(truth, c, task, *library);
    if (test->is_googletest) text += fmt::format("\nTEST(ExactPairs, Case{}) {{\n", number);
    text += reason_text(truth, expected.side, "  // ");
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
