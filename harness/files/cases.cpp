// Reads and writes cases; bodies are in case_json.
#include "harness/files/cases.h"

#include <array>

#include "harness/files/case_json.h"

namespace touchstone::files {
std::vector<Case> read_cases(const std::filesystem::path& file) {
  std::vector<Case> cases;
  KeyWarnings warnings;
  for_each_case(file, [&](const JsonNode& line) {
    read_case(line, cases.emplace_back());
    warnings.look(line);
  });
  return cases;
}

std::vector<CastCase> read_cast_cases(const std::filesystem::path& file) {
  std::vector<CastCase> cases;
  KeyWarnings warnings;
  for_each_case(file, [&](const JsonNode& line) {
    cases.push_back(read_cast_case(line));
    warnings.look(line);
  });
  return cases;
}

std::string to_json(const Case& c) {
  OrderedJson out;
  out["id"] = c.id;
  out["a"] = body_to_json(c.shape_a, c.pose_a);
  out["b"] = body_to_json(c.shape_b, c.pose_b);
  return out.dump();
}

std::string to_json(const CastCase& c) { return to_ordered_json(c).dump(); }

}  // namespace touchstone::files
