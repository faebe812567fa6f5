// A job of a check or a soak: the cases of one family in one round, for all contestants of its kind.
#pragma once

#include <vector>

#include "harness/check/check_request.h"
#include "harness/kinds/kind.h"

namespace touchstone::check {

// The cases of a family in a round: as many as the request says, or fewer.
kinds::BatchRange cases_of_round(const CheckRequest& request, const kinds::Family& family,
                                 std::uint64_t round);

// Asks all contestants for all cases, in every form. A contestant that takes none has no count.
std::vector<FamilyCount> do_family_job(const CheckRequest& request, std::uint32_t family,
                                       std::uint64_t round);

// The same for some cases, as they are drawn alone.
std::vector<FamilyCount> count_as_drawn(const CheckRequest& request, std::uint32_t family,
                                        std::uint64_t round, const kinds::BatchRange& range);

}  // namespace touchstone::check
