// The families of moving bodies.
#pragma once

#include <span>

#include "harness/files/cases.h"
#include "harness/kinds/family.h"

namespace touchstone::kinds {

std::span<const DrawnFamily<files::CastCase>> cast_families();

}  // namespace touchstone::kinds
