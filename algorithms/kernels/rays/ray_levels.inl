// Blocks of rays at one level of vector instructions: what ray_walk.cpp includes once for each.
#include "algorithms/kernels/rays/ray_block.inl"
#include "algorithms/kernels/rays/ray_finish.inl"
#include "algorithms/kernels/rays/ray_walk.inl"

#include "algorithms/kernels/rays/ray_packet.inl"

TOUCHSTONE_TARGET void walk_hit(const RayMesh& mesh, const RayBlock& block, std::size_t ray,
                                RayTask task, FoundHit& found, DoubtfulRay& doubtful) {
  HitVisitor<DoubtfulRay> visitor(mesh, block, ray, task, found, doubtful);
  float tau_end = block.tau_end[ray];
  walk(mesh, block, ray, 0, tau_end, visitor);
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
    if ((certain >> i & 1) != 0) continue;
    found[i] = {};
    if (!block.is_usable(i)) {
      hits[i] = hit_of_all(mesh, task, rays[i]);
      continue;
    }
    DoubtfulRay doubtful(mesh, block, i);
    walk_hit(mesh, block, i, task, found[i], doubtful);
    if (doubtful.is_asked()) {
      hits[i] = doubtful.hit(found[i]);
    } else {
      certain |= 1U << i;
    }
  }
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

TOUCHSTONE_TARGET void wind_block(const RayMesh& mesh, std::span<WindingQuery> queries,
                                  RayBlock& block) {
  localise(mesh, block);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    // A point that is too far for that is outside.
    if (!block.is_usable(i)) continue;
    OfferingVisitor<WindingQuery> visitor(mesh, block, i, queries[i]);
    float tau_end = block.tau_end[i];
    walk(mesh, block, i, 0, tau_end, visitor);
  }
}
