// Published results on the cells of a campaign, to be put beside those measured here.
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
    iterations,  // of a query: mean and deviation
    faster,      // than another algorithm, on every input
    suffices,    // answers every pair of a kind rightly
  };
  Kind kind = Kind::iterations;
  std::string algorithm;  // as the tables name it: "gjk double", "naive"
  std::string than;       // faster
  // Empty: any.
  std::string scene, pair_kind;
  double mean = 0, deviation = 0;  // iterations
  // Iterations that ours count and the source does not, such as the one that only proves that the
  // search has ended.
  std::int64_t uncounted = 0;
};

struct Published {
  std::string source;  // empty: the campaign reproduces nothing
  std::string note;    // remarks that a comparison needs
  std::vector<PublishedClaim> claims;
};

// The table [published] of a campaign file; see datasets/README.md. InputError with file and line.
Published read_published(files::TomlTable& campaign);

}  // namespace touchstone::stats
