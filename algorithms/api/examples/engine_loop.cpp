// An engine's loop: boxes fall onto a floor, and the world says which contacts begin.
#include <cstdio>
#include <touchstone/touchstone.hpp>
#include <vector>

int main() {
  touchstone::World world;
  touchstone::Solver solver;
  const touchstone::Shape crate = touchstone::Shape::box({0.5, 0.5, 0.5});
  const touchstone::Handle floor =
      world.insert(touchstone::Shape::box({10, 10, 0.5}), touchstone::Pose::at({0, 0, -0.5}));
  std::vector<touchstone::Handle> crates;
  for (int i = 0; i < 5; ++i)
    crates.push_back(world.insert(crate, touchstone::Pose::at({2.0 * i - 4, 0, 1.0 + i})));

  for (int frame = 0; frame < 60; ++frame) {
    for (const touchstone::Handle body : crates) {
      touchstone::Pose pose = world.body(body).pose;
      pose.translation.z -= 0.1;
      world.move(body, pose);
    }
    world.update();
    world.for_each_pair([&](touchstone::Handle a, touchstone::Handle b) {
      const touchstone::Result contact = solver.penetration(world.body(a), world.body(b));
      if (contact.answer != touchstone::Answer::overlapping) return;
      const touchstone::Handle body = a == floor ? b : a;
      touchstone::Pose pose = world.body(body).pose;  // out of the floor again
      pose.translation.z -= contact.distance;
      world.move(body, pose);
    });
    for (const touchstone::HandlePair& pair : world.changes().began) {
      std::printf("frame %d: body %u meets body %u\n", frame, pair.a.slot, pair.b.slot);
    }
  }
  for (const touchstone::Handle body : crates)
    std::printf("%.3f\n", world.body(body).pose.translation.z);
}
