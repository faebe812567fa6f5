// Part of dynamic-bvh: a BVH with up to 16 children a node, whose bounds are adjacent and tested
// together; all leaves have the same depth. It is loaded in bulk and then changed body by body;
// nodes that this makes bad get new children, a few nodes a frame.
// Papers:  Guttman, "R-Trees: A Dynamic Index Structure for Spatial Searching", SIGMOD 1984; Kamel,
//          Faloutsos, "On Packing R-trees", CIKM 1993 (the bulk load); Bittner, Hapala, Havran,
//          "Incremental BVH Construction for Ray Tracing", Computers & Graphics 47, 2015 (a box
//          goes where it adds the least surface); Catto, "Dynamic Bounding Volume Hierarchies", GDC
//          2019 (subtrees that have grown are rebuilt by medians).
// Departs: a full node is split at the median along the longest axis. Nodes are not merged one by
//          one: a node is regrouped when the surfaces of its children have grown by half since they
//          were made, or when they are less than half full. Its grandchildren, at most 256, are
//          divided anew by medians, and the subtrees below them stay as they are, so that no frame
//          has to rebuild much at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/structure_box.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

// Lists that a search fills; one for each worker.
struct Bvh16Scratch {
  std::vector<std::uint32_t> nodes, children, found;
  std::vector<IndexRange> partners;
};

class Bvh16 {
 public:
  static constexpr std::size_t fan = 16;
  static constexpr std::uint32_t nobody = 0xffffffff;  // the id at a free place

  // Starts a load, with `is_to_change` if changes follow. Bodies get places 0, 1 ... in the order of
  // loading, and have ids below `id_count`. The caller sets each place, in any order, and then calls
  // `load`.
  void start(std::size_t bodies, std::size_t id_count, bool is_to_change);
  void set(std::size_t place, const Aabb& box, std::uint32_t id) {
    boxes_.set(place, box, id);
    place_of_[id] = static_cast<std::uint32_t>(place);
  }
  void load(Executor& executor);
  std::size_t loaded() const { return bodies_; }

  // The boxes of the bodies and of the nodes; those of a leaf are at 16 consecutive places.
  const AabbSoA& boxes() const { return boxes_; }
  std::uint32_t place_of(std::uint32_t id) const { return place_of_[id]; }
  Aabb box_at(std::size_t place) const;
  std::size_t nodes() const { return node_count_; }
  bool is_leaf(std::size_t node) const { return height_of_[node] == 0; }

  // Valid until the first change after a load: leaves are numbered as loaded; the last may not be
  // full.
  std::size_t leaves() const { return leaves_; }
  IndexRange places_of(std::size_t leaf) const;
  Aabb bounds_of_leaf(std::size_t leaf) const;
  // Lists in scratch.partners the places of later leaves that overlap this leaf's bounds.
  void find_partners(std::size_t leaf, Bvh16Scratch& scratch, BroadPhaseWork& work) const;
  // The sum of the sides of the leaves' bounds (metres); a better order makes it smaller.
  double spread() const;

  // Changes of a tree that was loaded to be changed.
  void insert(std::uint32_t id, const Aabb& box);
  void remove(std::uint32_t id);
  // Gives a body another box, and moves it to another leaf if its own would grow much.
  void move(std::uint32_t id, const Aabb& box);
  void make_room_for_ids(std::size_t id_count) { place_of_.resize(id_count); }
  // Regroups nodes that changes have made bad, in the order in which they became so, until `enough`
  // bodies and nodes have new parents, or none is left; the others wait for the next call. Returns
  // the number that got new parents, which is less than `enough` + 256.
  std::size_t rebuild_worn(std::size_t enough);

  // Returns the ids of the bodies whose boxes overlap this one; valid until the next use of the
  // scratch.
  std::span<const std::uint32_t> find(const Aabb& box, Bvh16Scratch& scratch) const;
  // Makes room in a scratch; call it after the last change and before a search.
  void make_room(Bvh16Scratch& scratch) const;

  // Returns the nodes at their depths, for pictures, and if `with_bodies` the bodies' boxes below
  // the leaves.
  std::vector<StructureBox> structure(bool with_bodies) const;

  std::size_t held_bytes() const;

 private:
  // A tree of 2^32 bodies in nodes that are half full has eleven heights.
  static constexpr std::size_t most_heights = 12;
  static constexpr double most_growth = 1.5;

  struct Entry {
    Aabb box;
    std::uint32_t child;
  };
  // Whether a node's children have changed since the last call of rebuild_worn, or it waits.
  enum class Mark : std::uint8_t { none, changed, worn };

  Aabb bounds_of_node(std::size_t node) const;
  std::size_t new_node(std::size_t height);
  void drop_node(std::size_t node);
  void make_node_capacity(std::size_t nodes);
  void put(std::size_t place, const Aabb& box, std::uint32_t child);
  std::size_t best_child(std::size_t node, const Aabb& box) const;
  void add(std::size_t node, const Aabb& box, std::uint32_t child);
  void split(std::size_t node, const Aabb& box, std::uint32_t child);
  void fit_above(std::size_t node);
  void mark(std::size_t node);

  void show(std::size_t node, const StructureBox& own, bool with_bodies,
            std::vector<StructureBox>& nodes) const;

  double cost(std::size_t node) const;
  std::size_t count_children(std::size_t node) const;
  bool is_worn(std::size_t node) const;
  std::size_t regroup(std::size_t node);
  void drop_subtree(std::size_t node);
  std::size_t fill_places(std::size_t place, std::size_t count, std::span<Entry> entries);

  AabbSoA boxes_;                         // 16 places a node; the ids are bodies' or nodes'
  std::vector<std::uint32_t> place_of_;   // place of each body
  std::vector<std::uint32_t> parent_of_;  // place of each node in its parent
  std::vector<std::uint8_t> height_of_;   // height of each node; 0 for a leaf
  std::vector<double> cost_of_;           // cost of each inner node when its children were made
  std::vector<Mark> mark_of_;
  std::vector<std::uint32_t> marked_, worn_, free_nodes_;  // worn_ is the line of those that wait
  std::vector<Entry> entries_;  // grandchildren of a node that is regrouped
  bool is_to_change_ = false;
  std::size_t bodies_ = 0;  // number of bodies loaded
  std::size_t leaves_ = 0;
  std::size_t node_count_ = 0, node_capacity_ = 0;
  std::size_t root_ = 0;
  std::array<std::size_t, most_heights + 1> begins_{};  // first node of each height, as loaded
};

}  // namespace touchstone
