// Which vector instructions the kernels may use: found out at run time, and held down on request.
//
// A kernel has one function a level, compiled with __attribute__((target(...))), and asks `isa()`
// which to call. No source file is compiled with -m flags: an inline function of a library header
// would then be compiled for the newer machine too, and the linker might keep that copy.
#pragma once

#include <cstdint>
#include <string_view>

namespace touchstone {

enum class Isa : std::uint8_t { baseline, avx2, avx512 };  // avx512: F, BW, DQ and VL

// The level in use: the machine's best, or the limit where that is lower.
Isa isa();
// The machine's best.
Isa isa_of_machine();
// Holds every kernel to at most this level. Not to be called while an algorithm runs.
void limit_isa(Isa limit);

std::string_view to_string(Isa level);

}  // namespace touchstone
