// The program: one command, one job.
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"

int main(int argc, char** argv) {
  using namespace touchstone;
  CommandLine line("Touchstone: a benchmark of collision detection that checks what it measures");
  std::string isa_name = "best";
  Arguments everywhere = line.everywhere();
  everywhere
      .text("--isa", isa_name, "Vector instructions: best of this machine, or at most this level")
      .among({"baseline", "avx2", "avx512", "best"})
      .show_default();
  everywhere.before_commands([&] {
    if (isa_name == "baseline") limit_isa(Isa::baseline);
    if (isa_name == "avx2") limit_isa(Isa::avx2);
  });
  add_run(line);
  add_compare(line);
  add_tables(line);
  add_check(line);
  add_soak(line);
  add_stress(line);
  add_list(line);
  add_query(line);
  add_manifold(line);
  add_pairs(line);
  add_draw(line);
  add_record(line);
  add_trade(line);
  add_advise(line);
  add_represent(line);
  try {
    return line.run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const InputError& error) {
    std::fprintf(stderr, "touchstone: %s\n", error.what());  // fmt would throw where it fails
  } catch (const std::bad_alloc&) {
    std::fputs("touchstone: out of memory\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "touchstone: %s\n", error.what());
  }
  return exit_bad_request;
}
