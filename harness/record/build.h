// What this program was built from.
#pragma once

namespace touchstone::record {

// The sizes are fixed, so that another commit moves no code of the program.
struct Build {
  char commit[64] = "unknown";   // 40 hexadecimal digits; unknown without git
  char tree[16] = "unknown";     // clean or changed: whether the sources differed from the commit
  char sources[32] = "unknown";  // 16 hexadecimal digits, a hash of all sources of the programs
  char id[32] = "unknown";       // the same of sources, compiler, flags and libraries
};

// Sets what `build` returns. Until then all is unknown, as it is in the programs of the tests, which
// so need not be linked again whenever a source changes. `build` must live as long as the program.
void set_build(const Build& build);
const Build& build();

}  // namespace touchstone::record
