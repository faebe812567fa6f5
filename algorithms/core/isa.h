// The level of vector instructions that kernels may use: detected at run time, and limited on
// request.
//
// A kernel has one function for each level, compiled with __attribute__((target(...))), and calls
// the one that `isa()` allows. No source file is compiled with -m flags: an inline function of a
// library header would then be compiled for the newer machine too, and the linker might keep that
// copy.
#pragma once

#include <cstdint>
#include <string_view>

namespace touchstone {

enum class Isa : std::uint8_t { baseline, avx2, avx512 };  // avx512: F, BW, DQ, VL, and BMI2

// Returns the level in use: the machine's best, or the limit if that is lower.
Isa isa();
// Returns the machine's best level.
Isa isa_of_machine();
// Limits every kernel to this level. Do not call this while an algorithm runs.
void limit_isa(Isa limit);

std::string_view to_string(Isa level);

}  // namespace touchstone
