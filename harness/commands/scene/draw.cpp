// touchstone scene draw: draws a frame of a scene.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>

#include "algorithms/core/executor/executor.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/draw/scene_picture.h"
#include "harness/grade/pair_groups.h"
#include "harness/measure/narrow_choice.h"
#include "harness/scene/player.h"

namespace touchstone::commands {
namespace {

struct DrawOptions {
  std::string scene, out, view = "corner";
  scene::SceneOverrides overrides;
  int frame = 0, width = 1280, height = 960;
  bool with_fixed = false;
};

Vec3d direction(const std::string& view) {
  if (view == "front") return {0, 1, 0};
  if (view == "side") return {-1, 0, 0};
  if (view == "top") return {0, 0, -1};
  return {-1, 1.6, -1.7};
}

// Pairs with a body that does not move count if `with_fixed` is true: all that stands on a floor is
// in contact with it. They count too where the scene itself leaves out pairs of two such bodies.
std::vector<draw::BodyState> states_of(const scene::Scene& scene, const scene::ScenePlayer& player,
                                       bool with_fixed) {
  std::vector<draw::BodyState> states(player.boxes().size(), draw::BodyState::apart);
  Executor executor(1);
  const std::unique_ptr<BroadPhase> broad =
      registry::find<BroadPhaseEntry>("sweep-one-axis")->make(executor);
  PairSink sink;
  broad->build(player.boxes());
  broad->find_pairs(sink);
  std::vector<IndexPair> pairs = sink.gather();
  scene.filter.apply(pairs);
  if (!with_fixed && !scene.bodies.empty() && scene.filter.rests.empty()) {
    std::erase_if(pairs, [&](const IndexPair& pair) {
      return !scene.bodies[pair.a].moving || !scene.bodies[pair.b].moving;
    });
  }
  const auto mark = [&](std::uint32_t body, draw::BodyState state) {
    states[body] = std::max(states[body], state);
  };
  for (const IndexPair& pair : pairs) {
    mark(pair.a, draw::BodyState::possible);
    mark(pair.b, draw::BodyState::possible);
  }
  if (!scene.recording.empty()) return states;

  std::vector<std::uint32_t> shape_of;
  for (const scene::Body& body : scene.bodies) shape_of.push_back(body.shape);
  std::vector<IndexPair> convex;
  if (scene.concave.empty()) {
    convex = pairs;
  } else {
    const std::vector<ConcaveBody> bodies = measure::concave_bodies(scene);
    const auto fused = measure::concave_choices(std::array{registry::find<ConcaveEntry>("fused")},
                                                {}, std::array{Precision::float64})
                           .at(0)
                           .make_concave(bodies);
    std::vector<IndexPair> parts;
    for (const IndexPair& pair : pairs) {
      const std::uint32_t a = shape_of[pair.a], b = shape_of[pair.b];
      if (scene.concave_of(a) == nullptr && scene.concave_of(b) == nullptr) {
        convex.push_back(pair);
        continue;
      }
      Outcome outcome;
      parts.clear();
      fused->solve(ConcaveTask::intersect, {a, player.poses()[pair.a]}, {b, player.poses()[pair.b]},
                   outcome, parts);
      if (outcome.answer != Answer::overlapping) continue;
      mark(pair.a, draw::BodyState::overlapping);
      mark(pair.b, draw::BodyState::overlapping);
    }
  }
  const std::unique_ptr<NarrowPhase> narrow = registry::find<NarrowPhaseEntry>("gjk")->make({});
  narrow->bind(scene.shapes);
  for (const grade::PairGroup& group : grade::group_by_kind(convex, scene.shapes, shape_of)) {
    std::vector<Outcome> outcomes(group.size());
    narrow->solve(Task::intersect, group.batch(shape_of, player.poses(), 0, group.size()),
                  outcomes);
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (outcomes[i].answer != Answer::overlapping && outcomes[i].answer != Answer::touching)
        continue;
      mark(group.first[i], draw::BodyState::overlapping);
      mark(group.second[i], draw::BodyState::overlapping);
    }
  }
  return states;
}

void draw(const DrawOptions& options) {
  const scene::Scene scene = scene::load_scene(options.scene, options.overrides);
  files::check_outputs(scene.inputs(), std::vector<files::NamedFile>{{"--out", options.out}});
  if (options.frame < 0 || options.frame >= scene.frames) {
    throw base::InputError(fmt::format("--frame {}: {} has frames 0 to {}", options.frame,
                                       options.scene, scene.frames - 1));
  }
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  while (player.frame() < options.frame) player.next();
  const std::vector<draw::BodyState> states = states_of(scene, player, options.with_fixed);
  const bool has_fixed =
      std::ranges::any_of(scene.bodies, [](const scene::Body& body) { return !body.moving; });
  draw::Canvas canvas(options.width, options.height, draw::View(direction(options.view)));
  draw::draw_scene(canvas, scene, player.poses(), player.boxes(), states);
  canvas.write_png(options.out);
  fmt::print(
      "{}: frame {} of {}, {} bodies: {} certainly apart (grey), {} possibly in contact (amber), "
      "{} {} (red){}\n",
      options.out, options.frame, scene.name, scene.size(),
      std::ranges::count(states, draw::BodyState::apart),
      std::ranges::count(states, draw::BodyState::possible),
      std::ranges::count(states, draw::BodyState::overlapping),
      scene.recording.empty() ? "overlapping" : "overlapping: a recording has no bodies to tell",
      has_fixed && !options.with_fixed ? "; contacts with fixed bodies do not count" : "");
}

}  // namespace

void add_scene_draw(Arguments command) {
  auto options = std::make_shared<DrawOptions>();
  command
      .text("scene", options->scene,
            "Scene file: .toml, rigid-ipc's .json, .urdf, .aabbs or a model")
      .is_read()
      .required();
  command.text("--out", options->out, "The picture, .png")
      .required()
      .check([](const std::string& name) {
        return name.ends_with(".png") ? "" : "the picture's name must end in .png";
      });
  command.flag("--with-fixed", options->with_fixed,
               "Colour contacts with bodies that do not move, too");
  command.number("--frame", options->frame, "Which frame").show_default();
  command.text("--view", options->view, "From where")
      .among({"corner", "front", "side", "top"})
      .show_default();
  command.number("--width", options->width, "Pixels").within(16, 8192).show_default();
  command.number("--height", options->height, "Pixels").within(16, 8192).show_default();
  add_scene_overrides(command, options->overrides);
  command.job([options] {
    draw(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
