// touchstone scene describe: prints what a scene holds. touchstone scene hash: prints its hash.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/registry.h"
#include "harness/base/table.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/report/pair_mix.h"
#include "harness/scene/player.h"
#include "harness/scene/scene.h"

namespace touchstone::commands {
namespace {

struct DescribeOptions {
  std::string scene;
  scene::SceneOverrides overrides;
};

// What a table row says of some bodies.
struct BodyGroup {
  std::string kind;
  std::size_t count = 0, moving = 0;
  std::vector<double> sizes;  // the longest edges of their boxes, metres
};

// Returns one for each kind of body in frame 0, in order of their kinds, and one for all.
std::vector<BodyGroup> groups_of(const scene::Scene& scene, std::span<const Aabb> boxes) {
  std::vector<BodyGroup> groups;
  BodyGroup all{.kind = "all", .sizes = {}};
  for (std::size_t body = 0; body < boxes.size(); ++body) {
    const Aabb& box = boxes[body];
    if (!(box.min[0] <= box.max[0])) continue;  // not present
    std::string kind = "box of a recording";
    bool is_moving = true;
    if (scene.recording.empty()) {
      const std::uint32_t shape = scene.bodies[body].shape;
      kind =
          scene.concave_of(shape) != nullptr ? "not convex" : to_string(scene.shapes[shape].kind);
      is_moving = scene.bodies[body].moving;
    }
    auto at = std::ranges::find(groups, kind, &BodyGroup::kind);
    if (at == groups.end()) at = groups.insert(at, BodyGroup{.kind = kind, .sizes = {}});
    double size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      size = std::max(size, static_cast<double>(box.max[axis]) - box.min[axis]);
    for (BodyGroup* group : {&*at, &all}) {
      ++group->count;
      group->moving += is_moving ? 1 : 0;
      group->sizes.push_back(size);
    }
  }
  std::ranges::sort(groups, {}, &BodyGroup::kind);
  if (groups.size() != 1) groups.push_back(std::move(all));
  for (BodyGroup& group : groups) std::ranges::sort(group.sizes);
  return groups;
}

// Returns the number of pairs of boxes that overlap.
std::size_t overlaps_of(std::span<const Aabb> boxes) {
  Executor executor(1);
  const std::unique_ptr<BroadPhase> broad =
      registry::find<BroadPhaseEntry>("sweep-one-axis")->make(executor);
  PairSink sink;
  broad->build(boxes);
  broad->find_pairs(sink);
  return sink.gather().size();
}

std::string percent(std::size_t part, std::size_t of) {
  return fmt::format("{:.3g} %", 100 * static_cast<double>(part) / static_cast<double>(of));
}

void print_mix(const report::PairMix& mix) {
  if (mix.after_first > 0) {
    fmt::print("Pairs of boxes that overlapped in the frame before too: {}\n",
               percent(mix.again, mix.after_first));
  }
  if (mix.known() > 0) {
    fmt::print("\nOf {} pairs of convex bodies whose boxes overlap, in {} frame{}:\n\n",
               mix.known(), mix.frames, mix.frames == 1 ? "" : "s");
    base::Table moves({"resting", "sliding", "free"});
    moves.add({percent(mix.resting, mix.known()), percent(mix.sliding, mix.known()),
               percent(mix.apart, mix.known())});
    base::Table gaps({"gap, of the smaller body", "pairs"});
    for (std::size_t i = 0; i < mix.gaps.size(); ++i)
      gaps.add({std::string(report::gap_ranges[i]), percent(mix.gaps[i], mix.known())});
    fmt::print("{}\n{}", moves.text(base::page_width()), gaps.text(base::page_width()));
  }
  if (mix.not_convex > 0) {
    fmt::print("{} pairs with a body that is not convex are not among them\n", mix.not_convex);
  }
  if (mix.unknown > 0) fmt::print("Of {} pairs the gap is not known\n", mix.unknown);
}

void describe(const DescribeOptions& options) {
  const scene::Scene scene = scene::load_scene(options.scene, options.overrides);
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  const std::vector<BodyGroup> groups = groups_of(scene, player.boxes());
  base::Table table({"bodies", "number", "may move", "smallest box, m", "median", "largest"});
  for (const BodyGroup& group : groups) {
    const auto size = [&](std::size_t i) { return fmt::format("{:.4g}", group.sizes[i]); };
    const bool is_empty = group.sizes.empty();
    table.add({group.kind, std::to_string(group.count), std::to_string(group.moving),
               is_empty ? "-" : size(0), is_empty ? "-" : size(group.count / 2),
               is_empty ? "-" : size(group.count - 1)});
  }
  const double bodies = std::max<double>(1, static_cast<double>(scene.size()));
  const std::size_t first = overlaps_of(player.boxes());
  std::size_t moved = 0;
  while (player.next()) moved += player.change().moved.size();
  fmt::print("{}: {} bodies, {} frame{}\n\n{}\n", scene.name, scene.size(), player.frame() + 1,
             player.frame() == 0 ? "" : "s", table.text(base::page_width()));
  fmt::print("Pairs of boxes that overlap in frame 0: {}, or {:.3g} a body\n", first,
             static_cast<double>(first) / bodies);
  if (player.frame() > 0) {
    fmt::print("Boxes that change from a frame to the next: {:.3g} % of all\n",
               100 * static_cast<double>(moved) / (bodies * player.frame()));
  }
  if (scene.recording.empty()) print_mix(report::pair_mix(scene));
}

// Adds the options of a scene.
std::shared_ptr<DescribeOptions> described(Arguments& command) {
  auto options = std::make_shared<DescribeOptions>();
  command
      .text("scene", options->scene,
            "Scene file: .toml, rigid-ipc's .json, .urdf, .aabbs or a model")
      .is_read()
      .required();
  command.number("--frames", options->overrides.frames, "Instead of the scene's own")
      .within(1, 1'000'000);
  add_scene_overrides(command, options->overrides);
  return options;
}

}  // namespace

void add_scene_describe(Arguments command) {
  const auto options = described(command);
  command.footer(
      "Sizes are the longest edges of the bodies' boxes in frame 0. Gaps are those of up to 24 "
      "frames. Up to a hundredth of "
      "the smaller body's longest edge apart, bodies are in contact: they rest if they move by "
      "less than a thousandth of it "
      "against each other until the next frame, and else slide. Others are free.");
  command.job([options] {
    describe(*options);
    return exit_done;
  });
}

void add_scene_hash(Arguments command) {
  const auto options = described(command);
  command.job([options] {
    fmt::print("{}\n", scene::scene_hash(scene::load_scene(options->scene, options->overrides)));
    return exit_done;
  });
}

}  // namespace touchstone::commands
