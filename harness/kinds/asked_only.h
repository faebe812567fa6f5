// Kinds that have no families and no timed sets, and are asked with a user's own file alone.
#pragma once

#include <stdexcept>

#include "harness/kinds/grading.h"
#include "harness/kinds/kind.h"

namespace touchstone::kinds {

class AskedOnly : public Kind {
 public:
  using Kind::Kind;

  std::vector<Contestant> contestants(const std::vector<std::string>& /*names*/,
                                      std::span<const Precision> /*scalars*/) const final {
    throw std::logic_error("a kind without families has no contestants");
  }
  std::unique_ptr<Batch> draw(const Family& /*family*/, const BatchRange& /*range*/) const final {
    throw std::logic_error("a kind without families draws nothing");
  }
  std::vector<PlannedSet> timed_sets(files::TomlTable& table,
                                     const std::filesystem::path& /*home*/) const final {
    table.fail("kind", "these have no timed sets of this form");
  }

 private:
  std::vector<Family> list_families() const final { return {}; }
};

}  // namespace touchstone::kinds
