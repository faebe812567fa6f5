// The cases of a job, of any kind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/check/kinds/family.h"
#include "harness/check/kinds/family_count.h"

namespace touchstone::check {

// Consecutive cases of a family. A case depends on the family, the seed and its index alone. Exact
// answers are found when they are first needed, and kept.
class CaseBlock {
 public:
  virtual ~CaseBlock() = default;

  // Asks for the cases in a form, in a child process, and grades the answers, one for each case.
  // Forms other than as_drawn are asked for sampled cases alone.
  virtual std::vector<GradedCase> ask(const Contestant& contestant, CaseForm form,
                                      double time_limit) = 0;
  // Writes the case of this place to files whose names begin with the stem, and returns the command
  // that asks for it again.
  virtual std::string write(const Contestant& contestant, std::size_t place,
                            const std::filesystem::path& stem) const = 0;
};

// Cases `first` to `first` + `count` - 1.
struct BlockRange {
  std::uint64_t seed, first;
  std::size_t count;
};

std::unique_ptr<CaseBlock> make_case_block(const CaseFamily& family, const BlockRange& range);

// Those of each kind; `number` is the family's.
std::unique_ptr<CaseBlock> make_concave_block(std::uint32_t number, const BlockRange& range);
std::unique_ptr<CaseBlock> make_ray_block(std::uint32_t number, const BlockRange& range);
std::unique_ptr<CaseBlock> make_point_block(std::uint32_t number, const BlockRange& range);
std::unique_ptr<CaseBlock> make_cast_block(std::uint32_t number, const BlockRange& range);
std::unique_ptr<CaseBlock> make_ccd_block(std::uint32_t number, const BlockRange& range);
std::unique_ptr<CaseBlock> make_scene_ray_block(std::uint32_t number, const BlockRange& range);

}  // namespace touchstone::check
