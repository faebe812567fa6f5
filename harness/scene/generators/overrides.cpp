#include "harness/scene/generators/overrides.h"

#include <fmt/format.h>

#include "harness/base/error.h"

namespace touchstone::scene {

void refuse_seed(const std::string& file, std::int64_t seed) {
  if (seed == -1) return;
  throw base::InputError(file, 0, "a seed was asked for; expected none, as nothing is random");
}

void refuse_gap(const std::string& file, std::optional<double> gap) {
  if (!gap) return;
  throw base::InputError(file, 0,
                         fmt::format("a gap of {} was asked for, but only scenes of the generator "
                                     "`pairs` have gaps",
                                     *gap));
}

void refuse_moving(const std::string& file, std::optional<double> share) {
  if (!share) return;
  throw base::InputError(
      file, 0,
      fmt::format("a share of {} was asked to move; expected a generated scene whose file may have "
                  "the key `moving`",
                  *share));
}

void refuse_for_listed(const std::string& file, const SceneOverrides& overrides) {
  if (overrides.count != -1) {
    throw base::InputError(
        file, 0,
        fmt::format("a count of {} was asked for; expected none, as the bodies are listed and only "
                    "a generator makes as many as one likes",
                    overrides.count));
  }
  refuse_gap(file, overrides.gap);
  refuse_moving(file, overrides.moving);
}

}  // namespace touchstone::scene
