// Small scenes, and who represents their bodies in tests: balls, and boxes cut into eight.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algorithms/core/bounds.h"
#include "harness/base/error.h"
#include "harness/trade/trade_request.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

// sphere: a ball about the body's origin, which holds it. parts: a box as its eight octants.
inline std::vector<Part> represent_simply(const Shape& shape, const Mesh*,
                                          const Representation& wanted) {
  if (wanted.form == Form::sphere && wanted.side == Side::outer) {
    Part ball;
    ball.shape.kind = ShapeKind::sphere;
    ball.shape.radius = loose_reach(shape, Mat3d::Identity());
    return {ball};
  }
  if (wanted.form == Form::dop26 && shape.kind == ShapeKind::box) {
    std::vector<Part> octants;
    for (int corner = 0; corner < 8; ++corner) {
      Part& octant = octants.emplace_back();
      octant.shape = shape;
      octant.shape.half_extents /= 2;
      for (int axis = 0; axis < 3; ++axis) {
        const double half = octant.shape.half_extents[axis];
        octant.pose.translation[axis] = (corner >> axis & 1) != 0 ? half : -half;
      }
    }
    return octants;
  }
  throw InputError("no such representation in this test");
}

// For scenes that need nobody to stand for their bodies.
inline std::vector<Part> represent_no_body(const Shape&, const Mesh*, const Representation&) {
  throw std::logic_error("a body was represented that need not be");
}

inline Representing simple_representing() {
  return {represent_simply, [](const Shape&, const Mesh*, const std::vector<Part>&) {
            return RepresentationError{};
          }};
}

// A scene from the text of its file.
inline Scene scene_of(const std::string& text) {
  const TemporaryFolder folder;
  return load_scene(folder.write("scene.toml", text));
}

inline Representations all_as(Form form) {
  Representations all;
  all.of.fill(Representation{form, Side::outer, 0});
  return all;
}

// The only configuration of a grid.
inline TradePoint point_of(const TradeGrid& grid, const SceneFrames& frames,
                           StandInLibrary& library, Task task = Task::intersect) {
  const GridPoints made = expand({&grid, 1}, frames, library, task);
  if (made.points.size() != 1) throw std::logic_error("not one configuration");
  return made.points[0];
}

inline TradeGrid grid_with(const std::string& narrow,
                           const std::string& broad = "sweep-and-prune") {
  TradeGrid grid;
  grid.broad = {find_broad_phase(broad)};
  grid.narrow = {parse_chain(narrow)};
  return grid;
}

// A request about a scene, with a grid of narrow phases and representations.
struct SmallRequest {
  SmallRequest(const std::string& scene_text, double seconds) {
    request.scene = folder.write("scene.toml", scene_text);
    request.threads = 1;
    request.seconds = seconds;
    TradeGrid grid = grid_with("gjk");
    grid.narrow = {
        parse_chain("gjk"), parse_chain("closed-form+gjk"), parse_chain("certified"), {}};
    grid.representations = {{}, all_as(Form::sphere)};
    request.grids = {grid};
  }

  TemporaryFolder folder;
  TradeRequest request;
  Representing representing = simple_representing();
};

}  // namespace touchstone
