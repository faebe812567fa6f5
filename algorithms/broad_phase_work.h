// What it took a broad phase to find a frame's pairs, in numbers that explain its time and do not
// depend on the machine.
#pragma once

#include <cstdint>

namespace touchstone {

// Of one find_pairs; -1 where it is not counted. Ours count the same things, and their numbers are
// the same at every width of the executor and at every level of vector instructions: a pair that
// only fills a vector up is no test.
struct BroadPhaseWork {
  // Pairs of boxes, or of a box and a node's box, that were compared on at least one axis to learn
  // whether they overlap; by coordinates, or by what stands for them (places in a sorted order). A
  // pair that is compared again, in another cell, counts again. A sweep's last comparison, which
  // ends it, counts; what sorting compares, and in which cells a box lies, does not.
  std::int64_t box_tests = -1;
  // Cells, buckets, nodes and runs of a structure that were looked up or entered, empty ones and
  // repeated visits too. 0 where there is no such structure: naive, sweeps.
  std::int64_t node_visits = -1;
  // Pairs of bodies that came through the structure, so that their own boxes had to be compared in
  // full (on every axis on which the structure had not decided); those that came up twice count
  // twice. candidates / pairs reported - 1 is how many it let through in vain, a pair. Of a peer:
  // the pairs that the library gave, which its adapter tests against the boxes.
  std::int64_t candidates = -1;
  // Memory held between the calls, beside the boxes given and the pairs reported: all that
  // is reserved. Scratch that each thread has for itself is left out, since it depends on the
  // width.
  std::int64_t bytes = -1;
};

}  // namespace touchstone
