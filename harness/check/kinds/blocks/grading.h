// What the blocks of all kinds share.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "algorithms/core/status.h"
#include "algorithms/ray_cast.h"
#include "harness/check/kinds/case_block.h"
#include "harness/families/draws.h"
#include "harness/process/isolate.h"

namespace touchstone::check {

// The draws of one case: different for each family, seed and index.
inline families::RandomDraws draws_of(CaseKind kind, std::uint32_t number, std::uint64_t seed,
                                      std::uint64_t index) {
  const std::uint64_t family = (static_cast<std::uint64_t>(kind) + 1) * 1000 + number;
  return families::RandomDraws(base::mix(seed) + family, index);
}

// The grade that the status alone decides, if it does.
inline std::optional<CaseGrade> grade_of_status(Status status, bool is_unknown) {
  if (status == Status::crashed || status == Status::timed_out) return CaseGrade::lost;
  if (status == Status::unsupported) return CaseGrade::not_asked;
  const bool stands = status == Status::ok || status == Status::not_reported;
  if (!stands || is_unknown) return CaseGrade::honest;
  return std::nullopt;
}

// The grade of a verdict that is not what the exact one is.
inline std::optional<CaseGrade> grade_of_verdict(bool contact, bool truth) {
  if (contact == truth) return std::nullopt;
  return truth ? CaseGrade::missed : CaseGrade::false_hit;
}

// An algorithm may lose so many queries of a job, since each hang costs a time limit.
inline process::IsolationLimits block_limits(double time_limit) {
  return {.item_seconds = time_limit, .failures = 20};
}

// Writes a file of one ray for `touchstone rays`.
void write_ray(const std::filesystem::path& file, const Ray& ray);

// The places of the cases that a form is asked for: every fifth, or all as they are drawn.
inline bool is_asked(CaseForm form, std::uint64_t index) {
  return form == CaseForm::as_drawn || index % 5 == 0;
}

}  // namespace touchstone::check
