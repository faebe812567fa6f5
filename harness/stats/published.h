// Published results on the cells of a campaign, for comparison with measured ones.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace touchstone::files {
class TomlTable;
}

namespace touchstone::stats {

struct PublishedClaim {
  enum class Kind : std::uint8_t {
    iterations,  // the number for a query: mean and deviation
    faster,      // faster than another algorithm, on every input
    suffices,    // right for every pair of a kind
  };
  Kind kind = Kind::iterations;
  std::string algorithm;  // its label in the tables: "gjk double", "naive"
  std::string than;       // the slower algorithm, for `faster`
  // An empty text means any.
  std::string scene, pair_kind;
  double mean = 0, deviation = 0;  // iterations
  // Iterations that our count includes and the source's does not, such as the last one, which only
  // proves that the search has ended.
  std::int64_t uncounted = 0;
};

struct Published {
  std::string source;  // empty: the campaign reproduces nothing
  std::string note;    // remarks that a comparison needs
  std::vector<PublishedClaim> claims;
};

// Reads the table [published] of a campaign file; see datasets/README.md. Throws InputError with
// file and line.
Published read_published(files::TomlTable& campaign);

}  // namespace touchstone::stats
