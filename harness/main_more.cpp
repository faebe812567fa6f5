// The executable `touchstone_more`: all other commands. `touchstone` runs it.
#include "harness/commands/commands.h"
#include "harness/commands/program.h"

int main(int argc, char** argv) {
  using namespace touchstone;
  return commands::run_program(argc, argv,
                               {{"check", commands::add_check},
                                {"soak", commands::add_soak},
                                {"stress", commands::add_stress},
                                {"manifold", commands::add_manifold},
                                {"rays", commands::add_rays},
                                {"points", commands::add_points},
                                {"ccd", commands::add_ccd},
                                {"cast", commands::add_cast},
                                {"draw", commands::add_draw},
                                {"record", commands::add_record},
                                {"trade", commands::add_trade},
                                {"advise", commands::add_advise},
                                {"represent", commands::add_represent},
                                {"report", commands::add_report},
                                {"plan", commands::add_plan},
                                {"merge", commands::add_merge},
                                {"status", commands::add_status},
                                {"run", commands::add_run_file}});
}
