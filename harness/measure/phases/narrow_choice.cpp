// The label of a narrow phase with its settings.
#include "harness/measure/phases/narrow_choice.h"

#include <limits>

#include "harness/record/raw_row.h"

namespace touchstone::measure {

std::string NarrowChoice::label() const {
  return record::narrow_label(
      entry->info.name, to_string(settings.scalar), settings.tolerance.value_or(Outcome::none),
      settings.duality_gap.value_or(Outcome::none), warm, batch == usual_batch ? -1 : batch);
}

}  // namespace touchstone::measure
