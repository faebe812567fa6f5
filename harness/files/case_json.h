// Cases of resting and of moving bodies as JSON objects; cases.h has whole files. Bodies have the form
// {"shape": {"type": ...}, "translation": ..., "rotation": ...}.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/files/cases.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

// Throws InputError as described at read_cases. An axis other than z becomes z by a permutation of
// the rotation's columns. `others` are names of shapes that the caller takes, for the message about one that
// nobody knows.
void read_body(const JsonNode& body, Shape& shape, Pose& pose, std::string_view others = "");

// The translation and the rotation of a body; those that are missing are zero and the identity.
Pose read_pose(const JsonNode& body);

// The axis of a capsule, cylinder or cone: 0, 1 or 2; z if the key is missing.
int read_axis(const JsonNode& shape);

OrderedJson body_to_json(const Shape& shape, const Pose& pose);

// Calls `each` for every line that is a case. Throws InputError as for_each_json_line. The first line of a file of
// questions to a peer, which has the key "protocol", is none.
void for_each_case(const std::filesystem::path& file,
                   const std::function<void(const JsonNode&)>& each);

// The id of a case; the number of its line if it has none.
std::string read_id(const JsonNode& line);

// Both throw InputError as described at read_cases.
void read_case(const JsonNode& line, Case& c);
CastCase read_cast_case(const JsonNode& line);

// Rotations are written as matrices.
OrderedJson to_ordered_json(const CastCase& c);

// Cases may have keys of their own, which are ignored. One that is nearly a key of cases is a slip, and what was
// meant would be ignored in silence.
class KeyWarnings {
 public:
  // Prints a warning for each such key of the case, its bodies, their shapes and parts, to standard error; for each key
  // once.
  void look(const JsonNode& line);

 private:
  void look_within(const JsonNode& node, int depth);

  std::set<std::string> seen_;
};

}  // namespace touchstone::files
