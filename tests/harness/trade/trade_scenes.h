// Small scenes and simple representations for tests: balls, and boxes cut into eight.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algorithms/core/bounds.h"
#include "harness/base/error.h"
#include "harness/trade/trade_request.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

// A sphere is a ball about the body's origin that encloses it; parts are the eight octants of a
// box.
inline std::vector<proxies::Part> represent_simply(const Shape& shape, const geometry::Mesh*,
                                                   const proxies::Representation& wanted) {
  if (wanted.form == proxies::Form::sphere && wanted.side == proxies::Side::outer) {
    proxies::Part ball;
    ball.shape.kind = ShapeKind::sphere;
    ball.shape.radius = loose_reach(shape, Mat3d::Identity());
    return {ball};
  }
  if (wanted.form == proxies::Form::dop26 && shape.kind == ShapeKind::box) {
    std::vector<proxies::Part> octants;
    for (int corner = 0; corner < 8; ++corner) {
      proxies::Part& octant = octants.emplace_back();
      octant.shape = shape;
      octant.shape.half_extents /= 2;
      for (int axis = 0; axis < 3; ++axis) {
        const double half = octant.shape.half_extents[axis];
        octant.pose.translation[axis] = (corner >> axis & 1) != 0 ? half : -half;
      }
    }
    return octants;
  }
  throw base::InputError("no such representation in this test");
}

// Is for scenes whose bodies need no representation.
inline std::vector<proxies::Part> represent_no_body(const Shape&, const geometry::Mesh*,
                                                    const proxies::Representation&) {
  throw std::logic_error("a body was represented that need not be");
}

inline trade::Representing simple_representing() {
  return {represent_simply,
          [](const Shape&, const geometry::Mesh*, const std::vector<proxies::Part>&) {
            return proxies::RepresentationError{};
          }};
}

// Makes a scene from the text of its file.
inline scene::Scene scene_of(const std::string& text) {
  const TemporaryFolder folder;
  return scene::load_scene(folder.write("scene.toml", text));
}

inline trade::Representations all_as(proxies::Form form) {
  trade::Representations all;
  all.of.fill(proxies::Representation{form, proxies::Side::outer, 0});
  return all;
}

// Returns the only configuration of a grid.
inline trade::TradePoint point_of(const trade::TradeGrid& grid, const trade::SceneFrames& frames,
                                  trade::StandInLibrary& library, Task task = Task::intersect) {
  const trade::GridPoints made = trade::expand({&grid, 1}, frames, library, task);
  if (made.points.size() != 1) throw std::logic_error("not one configuration");
  return made.points[0];
}

inline trade::TradeGrid grid_with(const std::string& narrow,
                                  const std::string& broad = "sweep-one-axis") {
  trade::TradeGrid grid;
  grid.broad = {registry::find<BroadPhaseEntry>(broad)};
  grid.narrow = {trade::parse_chain(narrow)};
  return grid;
}

// A request about a scene, with a grid of narrow phases and representations.
struct SmallRequest {
  SmallRequest(const std::string& scene_text, double seconds) {
    request.scene = folder.write("scene.toml", scene_text);
    request.threads = 1;
    request.seconds = seconds;
    trade::TradeGrid grid = grid_with("gjk");
    grid.narrow = {trade::parse_chain("gjk"),
                   trade::parse_chain("closed-form+gjk"),
                   trade::parse_chain("certified"),
                   {}};
    grid.representations = {{}, all_as(proxies::Form::sphere)};
    request.grids = {grid};
  }

  TemporaryFolder folder;
  trade::TradeRequest request;
  trade::Representing representing = simple_representing();
};

}  // namespace touchstone
