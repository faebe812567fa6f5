// The table of commands. C++ includes it, CMake reads the first program's files from it, and the
// launcher reads all of it: what it says in --help, and which programs it has built. A row is one
// line, because the launcher and CMake read lines.
//
// TOUCHSTONE_COMMAND(program, name, "what it takes", "heading in --help", "one line about it")
//   program: `touchstone` or `touchstone_more`, which have a function add_NAME, or `launcher`.
// TOUCHSTONE_FILES(name, "files of harness/commands, without .cpp")
//   Of a command of `touchstone`: what it alone needs. What such a command cannot do there it hands over. All files that are in no row, but for those
//   that every command needs (harness/CMakeLists.txt), belong to `touchstone_more`.
// TOUCHSTONE_NESTED(name, word, "what it takes", "one line about it")
//   A command within a command of `touchstone_more`, which has a function add_NAME_WORD.
// TOUCHSTONE_RENAMED(old name, "what to write instead, behind the name of the program")
//   The old name is refused with this text. The user's words take the place of `...`; an option of
//   the text is left out where they have it.
// TOUCHSTONE_RENAMED_OPTION(old name, "--old --new")
//   Among these words, the second option takes the place of the first.
#ifndef TOUCHSTONE_COMMAND
#define TOUCHSTONE_COMMAND(program, name, takes, heading, about)
#endif
#ifndef TOUCHSTONE_FILES
#define TOUCHSTONE_FILES(name, files)
#endif
#ifndef TOUCHSTONE_NESTED
#define TOUCHSTONE_NESTED(command, name, takes, about)
#endif
#ifndef TOUCHSTONE_RENAMED
#define TOUCHSTONE_RENAMED(name, line)
#endif
#ifndef TOUCHSTONE_RENAMED_OPTION
#define TOUCHSTONE_RENAMED_OPTION(name, options)
#endif
// clang-format off

TOUCHSTONE_COMMAND(touchstone, run, "[CAMPAIGN.toml]", "Measure", "Run a campaign: every scene through every algorithm, compared and timed")
TOUCHSTONE_FILES(run, "run run_modules pictures")
TOUCHSTONE_COMMAND(touchstone_more, compare, "OLD NEW", "Measure", "Compare two results, or two builds: is B slower than A, or wrong where A is right?")
TOUCHSTONE_COMMAND(touchstone_more, advise, "SCENE --max-error E", "Measure", "Find the cheapest setup for a scene within an error budget, or all that no other beats")
TOUCHSTONE_COMMAND(launcher, bench, "[OPTIONS OF GOOGLE BENCHMARK]", "Measure", "Time single kernels, or count their instructions")

TOUCHSTONE_COMMAND(touchstone_more, check, "[PAIRS.jsonl]", "Check", "Grade every algorithm against exact answers: on hard cases, to its limits, by the million")
TOUCHSTONE_COMMAND(touchstone_more, reproduce, "[REFERENCE]", "Check", "Measure the reference results again, and compare its tables")
TOUCHSTONE_COMMAND(launcher, test, "[ROOM] [OPTIONS OF CTEST]", "Check", "Build and run every test, or those of one room such as harness/stats")

TOUCHSTONE_COMMAND(touchstone_more, query, "FILE", "Ask", "Ask algorithms the questions of a file: pairs, boxes, rays, points, moving bodies")
TOUCHSTONE_RENAMED(pairs, "query ...")
TOUCHSTONE_RENAMED(rays, "query RAYS.csv --in MESH --with NAMES")
TOUCHSTONE_RENAMED(points, "query POINTS.csv --in MESH --with NAMES")
TOUCHSTONE_RENAMED(cast, "query --kind cast ...")
TOUCHSTONE_RENAMED(ccd, "query --kind=feature ...")
TOUCHSTONE_RENAMED_OPTION(ccd, "--kind --features")
TOUCHSTONE_RENAMED(manifold, "query --kind manifold ...")

TOUCHSTONE_COMMAND(touchstone, show, "RESULTS", "Show", "Print the summary of a results folder again; write its tables, draw its figures")
TOUCHSTONE_FILES(show, "show")
TOUCHSTONE_COMMAND(touchstone_more, report, "RESULTS...", "Show", "Make a page of results and scenes that opens in a browser")
TOUCHSTONE_COMMAND(touchstone_more, list, "", "Show", "List the algorithms, built or not")

TOUCHSTONE_COMMAND(touchstone_more, scene, "draw|record|represent|describe|simulate|import|hash SCENE", "Scenes and clusters", "Draw, record, represent, describe, simulate or import a scene, or print its hash")
TOUCHSTONE_NESTED(scene, draw, "SCENE --out PICTURE.png", "Draw a frame of a scene as a PNG")
TOUCHSTONE_NESTED(scene, record, "SCENE --out BOXES.aabbs", "Write a scene's boxes as a recording")
TOUCHSTONE_NESTED(scene, represent, "SCENE --out ERRORS.csv", "Fit proxies, from ball to mesh, to the bodies, and measure their errors")
TOUCHSTONE_NESTED(scene, describe, "SCENE", "Print bodies, kinds, sizes and overlaps, which pairs rest, slide or are free, and their gaps")
TOUCHSTONE_NESTED(scene, simulate, "SCENE --seconds S --out LOG.csv", "Let the bodies fall and collide by Bullet's dynamics, and write their poses")
TOUCHSTONE_NESTED(scene, import, "FILE... --out FOLDER", "Make a folder of a robot, model, log, recording or scene, with all files that it needs")
TOUCHSTONE_NESTED(scene, hash, "SCENE", "Print the hash of a scene: the same bodies and motion have the same")
TOUCHSTONE_COMMAND(touchstone_more, robot, "ROBOT.urdf", "Scenes and clusters", "Say which links of a robot touch, and what its SRDF file hides")
TOUCHSTONE_COMMAND(touchstone_more, shards, "plan|status|merge ...", "Scenes and clusters", "Cut work into shards for many machines, and join them")
TOUCHSTONE_NESTED(shards, plan, "FILE --shards N --out DIR", "Cut a campaign, a trade or a check into shards")
TOUCHSTONE_NESTED(shards, status, "DIR", "How far the shards of a plan are, and which failed")
TOUCHSTONE_NESTED(shards, merge, "DIR --out RESULTS", "Join the shards of a plan")
TOUCHSTONE_COMMAND(launcher, setup, "[--tests]", "Scenes and clusters", "Install the packages that are missing, and build nothing")

TOUCHSTONE_RENAMED(stress, "check --axes ...")
TOUCHSTONE_RENAMED(soak, "check --count ...")
TOUCHSTONE_RENAMED_OPTION(soak, "--pairs --count")
TOUCHSTONE_RENAMED(trade, "advise ... --front")
TOUCHSTONE_RENAMED(tables, "show RESULTS --tables`; without RESULTS or with --check it is `reproduce")
TOUCHSTONE_RENAMED(plot, "show ... --figures")
TOUCHSTONE_RENAMED(draw, "scene draw ...")
TOUCHSTONE_RENAMED(record, "scene record ...")
TOUCHSTONE_RENAMED(represent, "scene represent ...")
TOUCHSTONE_RENAMED(plan, "shards plan ...")
TOUCHSTONE_RENAMED(status, "shards status ...")
TOUCHSTONE_RENAMED(merge, "shards merge ...")

// clang-format on
#undef TOUCHSTONE_COMMAND
#undef TOUCHSTONE_FILES
#undef TOUCHSTONE_NESTED
#undef TOUCHSTONE_RENAMED
#undef TOUCHSTONE_RENAMED_OPTION
