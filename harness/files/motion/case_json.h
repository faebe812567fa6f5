// Cases of resting and of moving bodies, each from its line and as an object. cases.h has whole files.
#pragma once

#include "harness/files/cases.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

// The id of a case; the number of its line if it has none.
std::string read_id(const JsonNode& line);

// Both throw InputError as described at read_cases.
void read_case(const JsonNode& line, Case& c);
CastCase read_cast_case(const JsonNode& line);

// Rotations are written as matrices.
OrderedJson to_ordered_json(const CastCase& c);

}  // namespace touchstone::files
