// Families of queries of continuous collision: hard ones, by construction.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/ccd.h"
#include "harness/families/draws.h"

namespace touchstone::families {

struct CcdFamily {
  std::string name;  // lower case, words joined by '-'
  FeaturePair pair;
  std::function<CcdQuery(Draws&)> draw;
  // What every query of it is; unknown where they differ.
  CcdAnswer truth = CcdAnswer::unknown;
  bool is_small = false;  // integers for first_contact_of_small
};

// All families at size about 1, for both kinds.
std::vector<CcdFamily> ccd_families();

// Features that are in contact inside of both at a quarter of the time, in integers.
CcdQuery contact_query(FeaturePair pair, Draws& random);
// Features in contact at first, that move by up to so much (metres).
CcdQuery motion_query(FeaturePair pair, double reach, Draws& random);

// The query with each coordinate times a factor, plus an offset along all axes (rounded).
CcdQuery changed(const CcdQuery& query, double factor, double offset = 0);

}  // namespace touchstone::families
