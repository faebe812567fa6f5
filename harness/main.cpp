// The program: one subcommand, one job.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "algorithms/core/isa.h"
#include "harness/base/error.h"
#include "harness/commands/commands.h"

int main(int argc, char** argv) {
  using namespace touchstone;
  CLI::App app{"Touchstone: a benchmark of collision detection that checks what it measures"};
  app.name("touchstone");
  app.require_subcommand(1);
  app.fallthrough();
  std::string isa_name = "best";
  app.add_option("--isa", isa_name,
                 "Vector instructions: best of this machine, or at most this level")
      ->check(CLI::IsMember({"baseline", "avx2", "avx512", "best"}))
      ->capture_default_str();
  app.parse_complete_callback([&] {
    if (isa_name == "baseline") limit_isa(Isa::baseline);
    if (isa_name == "avx2") limit_isa(Isa::avx2);
  });
  int status = exit_done;
  add_run(app, status);
  add_compare(app, status);
  add_tables(app, status);
  add_check(app, status);
  add_soak(app, status);
  add_stress(app, status);
  add_list(app, status);
  add_query(app, status);
  add_manifold(app, status);
  add_pairs(app, status);
  add_draw(app, status);
  add_record(app, status);
  add_trade(app, status);
  add_advise(app, status);
  add_represent(app, status);
  try {
    app.parse(argc, argv);
    return status;
  } catch (const CLI::ParseError& error) {
    const bool help = error.get_exit_code() == 0;
    if (help || !app.get_subcommands().empty()) {
      return app.exit(error) == 0 ? exit_done : exit_bad_request;
    }
    std::fprintf(stderr, "touchstone: %s\nExpected a command, one of:", error.what());
    for (const CLI::App* command : app.get_subcommands({})) {
      std::fprintf(stderr, " %s", command->get_name().c_str());
    }
    std::fputs(". Run with --help for more information.\n", stderr);
  } catch (const InputError& error) {
    std::fprintf(stderr, "touchstone: %s\n", error.what());  // fmt would throw where it fails
  } catch (const std::bad_alloc&) {
    std::fputs("touchstone: out of memory\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "touchstone: %s\n", error.what());
  }
  return exit_bad_request;
}
