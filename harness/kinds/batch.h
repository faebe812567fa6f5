// Consecutive cases of a family: asked in child processes, graded, and written to show one again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/kinds/contestant.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// The same case in another form, which has the same exact answer. A form is asked where it is exact; turning
// casts are also reversed and split, where rounding may decide otherwise, and are then graded by that answer.
enum class CaseForm : std::uint8_t {
  as_drawn,
  swapped,   // the bodies, or features, in the other order
  scaled,    // all lengths times a power of two
  moved,     // by a rotation that permutes axes, and a translation that rounds nothing
  reversed,  // the motion, from its end to its start
  split,     // the motion, in two halves that are asked one after the other
};
inline constexpr std::array all_case_forms = {CaseForm::as_drawn, CaseForm::swapped,
                                              CaseForm::scaled,   CaseForm::moved,
                                              CaseForm::reversed, CaseForm::split};
std::string_view to_string(CaseForm form);

// Cases `first` to `first` + `count` - 1.
struct BatchRange {
  std::uint64_t seed, first;
  std::size_t count;
};

// A case depends on the family, the seed and its index alone. Exact answers are found when they are first
// needed, and kept.
class Batch {
 public:
  virtual ~Batch() = default;

  // Asks for the cases in a form, in a child process, and grades the answers, one for each case. Forms other
  // than as_drawn are asked for sampled cases alone. `time_limit`: seconds a query.
  virtual std::vector<Graded> ask(const Contestant& contestant, CaseForm form,
                                  double time_limit) = 0;
  // Writes the case of this place to files whose names begin with the stem, and returns the command
  // that asks for it again.
  virtual std::string write(const Contestant& contestant, std::size_t place,
                            const std::filesystem::path& stem) const = 0;
};

}  // namespace touchstone::kinds
