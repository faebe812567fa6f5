// Part of directional-advancement: a query as the lanes have it, and where answers go.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/ccd.h"
#include "algorithms/kernels/features/scaled_edges.h"

namespace touchstone {

struct LaneQuery {
  ScaledEdges edges;
  // In the unit of the edges:
  double threshold;  // a gap of this length along a direction is free of contact
  double near;       // witness points nearer than this are a hit
};

// All queries of a call.
struct LaneBatch {
  std::span<const CcdQuery> queries;
  std::span<CcdOutcome> outcomes;
  double tolerance, separation;  // metres
  std::int32_t most_steps;
  bool is_face;  // the queries are of a vertex and a face
};

// Returns false if the query has its outcome: the edges overflow, or one of the axes parts the features at all
// times.
bool load_lane(const CcdQuery& query, const LaneBatch& batch, LaneQuery& lane);

}  // namespace touchstone
