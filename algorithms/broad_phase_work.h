// The work of a broad phase to find a frame's pairs, in numbers that explain its time and do not
// depend on the machine.
#pragma once

#include <cstdint>

namespace touchstone {

// The work of one find_pairs; -1 if it is not counted. All of ours count alike, and their numbers
// are equal at every width of the executor and at every level of vector instructions: a pair that
// only fills up a vector is no test.
struct BroadPhaseWork {
  // Pairs of boxes, or of a box and a node's box, compared on at least one axis to decide whether
  // they overlap, by coordinates or by places in a sorted order. A pair that is compared again, in
  // another cell, counts again. The last comparison of a sweep, which ends it, counts; comparisons
  // of a sort, and finding the cells of a box, do not.
  std::int64_t box_tests = -1;
  // Cells, buckets, nodes and runs of a structure that were looked up or entered, including empty
  // ones and repeated visits. 0 if there is no such structure: naive, sweeps.
  std::int64_t node_visits = -1;
  // Pairs of bodies that the structure did not reject, so that their own boxes had to be compared
  // in full (on every axis on which the structure had not decided); a pair that came up twice
  // counts twice. candidates / pairs reported - 1 is the number that it let through in vain for
  // each pair. For a peer: the pairs that the library returned, which its adapter tests against the
  // boxes.
  std::int64_t candidates = -1;
  // Memory held between the calls, all that is reserved, apart from the boxes given and the pairs
  // reported. Scratch of single threads is left out, since it depends on the width.
  std::int64_t bytes = -1;
  // Bodies, nodes and pairs that the last build or update, and the find_pairs after it, put into
  // the structure: new ones, and old ones that got another place. It tells long frames. dynamic-bvh
  // alone counts it, and no table has it.
  std::int64_t placed = -1;
};

}  // namespace touchstone
