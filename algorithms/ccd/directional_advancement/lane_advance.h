// Part of directional-advancement: queries, and where their answers go.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/ccd.h"

namespace touchstone {

// All queries of a call.
struct LaneBatch {
  std::span<const CcdQuery> queries;
  std::span<CcdOutcome> outcomes;
  double tolerance, separation;  // metres
  std::int32_t most_steps;
  bool is_face;  // the queries are of a vertex and a face
};

}  // namespace touchstone
