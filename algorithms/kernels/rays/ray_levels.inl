// Blocks of rays at one level of vector instructions: what ray_walk.cpp includes once for each. A file
// that is included here needs those before it.
#include "algorithms/kernels/rays/node_lanes.inl"

#include "algorithms/kernels/rays/ray_block.inl"
#include "algorithms/kernels/rays/ray_finish.inl"
#include "algorithms/kernels/rays/ray_walk.inl"

#include "algorithms/kernels/rays/ray_interval.inl"

#include "algorithms/kernels/rays/ray_packet.inl"

#include "algorithms/kernels/rays/points/winding_walk.inl"

// A ray that is walked with others.
struct Walker {
  std::size_t ray;
  DoubtfulRay doubtful;
  Walk<HitVisitor<DoubtfulRay>> walk;

  TOUCHSTONE_TARGET Walker(const RayMesh& mesh, const RayBlock& block, std::size_t r, RayTask task,
                           FoundHit& found)
      : ray(r),
        doubtful(mesh, block, r),
        walk(mesh, block, r, 0, block.tau_end[r], task, found, doubtful) {}
};

// Walks rays (bits) in turns, a step each, since a step waits for the one before it. Writes the hits of
// those that floats do not decide, and returns the others.
TOUCHSTONE_TARGET unsigned walk_in_turns(const RayMesh& mesh, const RayBlock& block, RayTask task,
                                         unsigned rays, std::span<FoundHit> found,
                                         std::span<RayHit> hits) {
  std::array<std::optional<Walker>, rays_in_turn> walkers;
  unsigned certain = 0;
  std::size_t busy = 0;
  const auto next = [&](std::optional<Walker>& walker) {
    const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
    rays &= rays - 1;
    found[ray] = {};
    walker.emplace(mesh, block, ray, task, found[ray]);
  };
  for (auto& walker : walkers) {
    if (rays == 0) break;
    next(walker);
    ++busy;
  }
  while (busy > 0) {
    for (std::size_t k = 0; k < rays_in_turn; ++k) {
      if (!walkers[k] || walkers[k]->walk.step()) continue;
      const std::size_t ray = walkers[k]->ray;
      if (walkers[k]->doubtful.is_asked()) {
        hits[ray] = walkers[k]->doubtful.hit(found[ray]);
      } else {
        certain |= 1U << ray;
      }
      if (rays != 0) {
        next(walkers[k]);
      } else {
        walkers[k].reset();
        --busy;
      }
    }
  }
  return certain;
}

TOUCHSTONE_TARGET void cast_block(const RayMesh& mesh, RayTask task, std::span<const Ray> rays,
                                  RayBlock& block, std::span<RayHit> hits) {
  localise(mesh, block);
  std::array<FoundHit, RayBlock::most> found;
  unsigned certain = 0;  // the rays whose hits need no query
  Interval interval;
  if (bound(mesh, block, interval)) {
    PacketHits packet;
    walk_packet(mesh, block, interval, task, found, packet);
    certain = block.usable & ~packet.doubtful;
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!block.is_usable(i)) hits[i] = hit_of_all(mesh, task, rays[i]);
  }
  certain |= walk_in_turns(mesh, block, task, block.usable & ~certain, found, hits);
  HitNumbers numbers;
  const unsigned sure = finish(mesh, block, std::span(found).first(rays.size()), numbers);
  for (; certain != 0; certain &= certain - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(certain));
    RayHit hit;
    hit.status = Status::ok;
    if (found[i].is_found()) {
      const Leaf& leaf = mesh.leaves()[found[i].leaf];
      if ((sure >> i & 1) == 0) {
        RayQuery query(rays[i]);
        const auto [a, b, c] = mesh.corners(leaf, found[i].lane);
        query.offer(leaf.triangle[found[i].lane], a, b, c);
        hits[i] = query.hit();
        continue;
      }
      hit.hit = true;
      hit.triangle = leaf.triangle[found[i].lane];
      hit.t = numbers.t[i];
      hit.u = numbers.u[i];
      hit.v = numbers.v[i];
    }
    hits[i] = hit;
  }
}
