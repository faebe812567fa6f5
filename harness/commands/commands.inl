// The table of commands. C++ includes it, CMake reads the first program's files from it, and the
// launcher reads all of it: what it says in --help, and which programs it has built. A row is one
// line, because the launcher and CMake read lines.
//
// TOUCHSTONE_COMMAND(program, name, "what it takes", "heading in --help", "one line about it")
//   program: `touchstone` or `touchstone_more`, which have a function add_NAME, or `launcher`.
// TOUCHSTONE_FILES(name, "files of harness/commands, without .cpp")
//   Of a command of `touchstone`: what it alone needs. All files that are in no row, but for those
//   that every command needs (harness/CMakeLists.txt), belong to `touchstone_more`.
// TOUCHSTONE_MORE_OPTION(name, "--option"), TOUCHSTONE_MORE_KEY(name, "key")
//   A command of `touchstone` that `touchstone_more` must do, or help with, where it is given this
//   option, or a file with this key at its top.
// TOUCHSTONE_RENAMED(old name, "what to write instead, behind the name of the program")
//   The old name is refused with this text.
#ifndef TOUCHSTONE_COMMAND
#define TOUCHSTONE_COMMAND(program, name, takes, heading, about)
#endif
#ifndef TOUCHSTONE_FILES
#define TOUCHSTONE_FILES(name, files)
#endif
#ifndef TOUCHSTONE_MORE_OPTION
#define TOUCHSTONE_MORE_OPTION(name, option)
#endif
#ifndef TOUCHSTONE_MORE_KEY
#define TOUCHSTONE_MORE_KEY(name, key)
#endif
#ifndef TOUCHSTONE_RENAMED
#define TOUCHSTONE_RENAMED(name, line)
#endif
// clang-format off

TOUCHSTONE_COMMAND(touchstone, run, "[CAMPAIGN.toml]", "Measure", "Run a campaign: every scene through every algorithm, compared and timed")
TOUCHSTONE_FILES(run, "run pictures/page")
TOUCHSTONE_MORE_OPTION(run, "--plan")
TOUCHSTONE_MORE_OPTION(run, "--report")
TOUCHSTONE_MORE_KEY(run, "trade")
TOUCHSTONE_MORE_KEY(run, "check")
TOUCHSTONE_MORE_KEY(run, "stress")
TOUCHSTONE_MORE_KEY(run, "soak")
TOUCHSTONE_MORE_KEY(run, "cells")
TOUCHSTONE_COMMAND(touchstone, compare, "OLD NEW", "Measure", "Compare two results, or two builds of this program: is B slower than A?")
TOUCHSTONE_FILES(compare, "compare")
TOUCHSTONE_COMMAND(touchstone_more, trade, "SCENE", "Measure", "Speed against accuracy on a scene: every configuration, and the Pareto front")
TOUCHSTONE_COMMAND(touchstone_more, advise, "SCENE --max-error E", "Measure", "The cheapest configuration for a scene that is right enough, by measuring")
TOUCHSTONE_COMMAND(launcher, bench, "[OPTIONS OF GOOGLE BENCHMARK]", "Measure", "Time single kernels, or count their instructions")

TOUCHSTONE_COMMAND(touchstone_more, check, "", "Check", "Grade every algorithm against exact answers, in regimes that are hard")
TOUCHSTONE_COMMAND(touchstone_more, stress, "", "Check", "Drive every narrow phase to where it breaks: scale, proportions, distance, gap, ...")
TOUCHSTONE_COMMAND(touchstone_more, soak, "", "Check", "Count verdicts by the million against exact ones, in regimes that are hard")
TOUCHSTONE_COMMAND(launcher, test, "[OPTIONS OF CTEST]", "Check", "Build and run every test")

TOUCHSTONE_COMMAND(touchstone_more, query, "FILE", "Ask", "Ask algorithms the questions of a file: pairs, boxes, rays, points, moving bodies")
TOUCHSTONE_RENAMED(pairs, "query BOXES.csv --with NAMES")
TOUCHSTONE_RENAMED(rays, "query RAYS.csv --in MESH --with NAMES")
TOUCHSTONE_RENAMED(points, "query POINTS.csv --in MESH --with NAMES")
TOUCHSTONE_RENAMED(cast, "query CASES.jsonl --kind cast --with NAMES")
TOUCHSTONE_RENAMED(ccd, "query QUERIES.csv --kind feature --features vertex-face --with NAMES")
TOUCHSTONE_RENAMED(manifold, "query CASES.jsonl --kind manifold --with NAMES")

TOUCHSTONE_COMMAND(touchstone, tables, "[RESULTS]", "Show", "Write the tables of a results folder, or see whether those of a reference hold here")
TOUCHSTONE_FILES(tables, "tables")
TOUCHSTONE_COMMAND(launcher, plot, "RESULTS", "Show", "Draw figures of a results folder, as SVG, PDF and PNG")
TOUCHSTONE_COMMAND(touchstone_more, report, "RESULTS...", "Show", "Make a page of results and scenes that opens in a browser")
TOUCHSTONE_COMMAND(touchstone, list, "", "Show", "List the algorithms, built or not")
TOUCHSTONE_FILES(list, "list")

TOUCHSTONE_COMMAND(touchstone_more, draw, "SCENE", "Scenes and clusters", "Draw a frame of a scene as a PNG")
TOUCHSTONE_COMMAND(touchstone_more, record, "SCENE", "Scenes and clusters", "Write a scene's boxes as a recording")
TOUCHSTONE_COMMAND(touchstone_more, represent, "SCENE", "Scenes and clusters", "What stands for a scene's bodies, from ball to mesh, and how far off it is")
TOUCHSTONE_COMMAND(touchstone_more, plan, "FILE --shards N --out DIR", "Scenes and clusters", "Cut a campaign, a check or a soak into shards for many machines")
TOUCHSTONE_COMMAND(touchstone_more, status, "DIR", "Scenes and clusters", "How far the shards of a plan are, and which failed")
TOUCHSTONE_COMMAND(touchstone_more, merge, "DIR --out RESULTS", "Scenes and clusters", "Join the shards of a plan")
TOUCHSTONE_COMMAND(launcher, setup, "[--tests]", "Scenes and clusters", "Install the packages that are missing, and build nothing")

// clang-format on
#undef TOUCHSTONE_COMMAND
#undef TOUCHSTONE_FILES
#undef TOUCHSTONE_MORE_OPTION
#undef TOUCHSTONE_MORE_KEY
#undef TOUCHSTONE_RENAMED
