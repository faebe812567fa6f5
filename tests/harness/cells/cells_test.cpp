// Tests of cells: small ones of each kind, graded and timed; files that are wrong; a run that was stopped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "harness/base/error.h"
#include "harness/cells/motion.h"
#include "harness/cells/read_cells.h"
#include "harness/record/raw_row.h"
#include "harness/stats/cell_results.h"
#include "harness/stats/cell_rows.h"
#include "harness/stats/cell_tables.h"
#include "tests/harness/columns_page.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::Not;

cells::CellRequest request_of(const TemporaryFolder& folder, const std::string& keys,
                              const std::string& algorithms = "\"ours\"") {
  return cells::read_cells(folder.write(
      "cells.toml", "name = \"small\"\n[[group]]\n" + keys +
                        "rounds = 6\nsample_seconds = 1e-5\nalgorithms = " + algorithms + "\n"));
}

struct Ran {
  cells::CellRunResult result;
  std::vector<stats::GradeRow> grades;
  std::vector<stats::CellTimeRow> times;
  std::vector<stats::CellBestRow> best;
};
Ran run(const cells::CellRequest& request, const std::filesystem::path& out) {
  Ran ran;
  ran.result = cells::run_cells(request, out, record::FolderStart::overwrite, [](const auto&) {});
  stats::write_cell_tables(out, request.name, out);
  ran.grades = record::read_rows<stats::GradeRow>(out / "set_grades.csv");
  ran.times = record::read_rows<stats::CellTimeRow>(out / "set_times.csv");
  ran.best = record::read_rows<stats::CellBestRow>(out / "set_best.csv");
  return ran;
}

// Every one of ours is right or says that it is approximate, and every cell has a fastest one.
void expect_sound(const Ran& ran, std::size_t cells) {
  EXPECT_FALSE(ran.result.ours_wrong);
  EXPECT_EQ(ran.best.size(), cells);
  ASSERT_EQ(ran.times.size(), ran.grades.size());
  for (const stats::GradeRow& row : ran.grades) {
    EXPECT_EQ(row.status, "ok") << row.algorithm;
    EXPECT_TRUE(row.approximate || row.is_right()) << row.cell << " " << row.algorithm;
    EXPECT_GT(row.graded, 0);
  }
  for (const stats::CellTimeRow& row : ran.times) {
    EXPECT_EQ(row.grade.status, "ok") << row.grade.cell << " " << row.grade.algorithm;
    EXPECT_GE(row.samples, 3) << row.grade.algorithm;  // a disturbed round may be left out
    EXPECT_GT(row.seconds, 0);
  }
}

TEST(Cells, OfRays) {
  const TemporaryFolder folder;
  const auto request = request_of(
      folder, "kind = \"rays\"\nmeshes = [\"torus-200\", \"terrain-200\"]\nqueries = 64\n");
  ASSERT_EQ(request.cells.size(), 2U * 4 * 2);
  expect_sound(run(request, folder.path() / "out"), request.cells.size());
}

TEST(Cells, OfPoints) {
  const TemporaryFolder folder;
  const auto request =
      request_of(folder, "kind = \"points\"\nmeshes = [\"torus-200\"]\nqueries = 64\n");
  ASSERT_EQ(request.cells.size(), 2U * 2);
  expect_sound(run(request, folder.path() / "out"), request.cells.size());
  try {
    request_of(folder, "kind = \"points\"\nmeshes = [\"terrain-200\"]\n");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("expected a closed surface"));
  }
}

// Embree begins threads when a mesh of this size is bound, and a process with threads cannot fork.
TEST(Cells, OfLibrariesThatBeginThreads) {
  const TemporaryFolder folder;
  for (const std::string kind : {"ray", "point"}) {
    const auto request = cells::read_cells(folder.write(
        "cells.toml", "[[group]]\nkind = \"" + kind +
                          "\"\nmeshes = \"trefoil-10000\"\nqueries = 64\ntasks = \"closest\"\n"
                          "rounds = 6\nsample_seconds = 1e-5\n"));
    EXPECT_EQ(request.query_kind, kind);
    const Ran ran = run(request, folder.path() / kind);
    EXPECT_FALSE(ran.times.empty());
    for (const stats::CellTimeRow& row : ran.times) {
      EXPECT_EQ(row.grade.status, "ok") << row.grade.algorithm;
      EXPECT_GT(row.seconds, 0) << row.grade.algorithm;
    }
  }
}

TEST(Cells, OfCasts) {
  const TemporaryFolder folder;
  const auto request =
      request_of(folder,
                 "kind = \"casts\"\nshapes = [\"sphere\", \"box\"]\nqueries = 16\n"
                 "ways = [\"hit\", \"miss by 1e-3\", \"overlapping at the start\", "
                 "\"grazing by 1e-6\", \"going in from a touch\"]\n");
  ASSERT_EQ(request.cells.size(), 10U);
  expect_sound(run(request, folder.path() / "out"), request.cells.size());
}

TEST(Cells, OfMovingFeatures) {
  const TemporaryFolder folder;
  const auto request = request_of(folder, "kind = \"ccd\"\nqueries = 32\n");
  ASSERT_EQ(request.cells.size(), 12U);
  expect_sound(run(request, folder.path() / "out"), request.cells.size());
}

TEST(Cells, OfMeshes) {
  const TemporaryFolder folder;
  const auto request =
      request_of(folder, "kind = \"concave\"\nmeshes = \"torus-200\"\nqueries = 6\n");
  ASSERT_EQ(request.cells.size(), 12U);
  expect_sound(run(request, folder.path() / "out"), request.cells.size());
}

// Whoever does not take a query is not timed on the others.
TEST(Cells, OfAContestantThatTakesNotAllQueries) {
  const TemporaryFolder folder;
  auto request = request_of(folder, "kind = \"points\"\nmeshes = [\"torus-200\"]\nqueries = 64\n");
  const auto contestant = [](const char* name, kinds::Grade of_second) {
    return kinds::TimedContestant{.name = name,
                                  .origin = Origin::peer,
                                  .answer = [] {},
                                  .grade =
                                      [=] {
                                        kinds::TimedGrade sum;
                                        sum.add({kinds::Grade::right, false}, 0);
                                        sum.add({of_second, false}, 1);
                                        return sum;
                                      },
                                  .hash = [] { return std::uint64_t{1}; }};
  };
  request.cells = {{.group = "some", .name = "two", .make = [=] {
                      return kinds::TimedSet{
                          .queries = 2,
                          .graded = 2,
                          .contestants = {contestant("all", kinds::Grade::right),
                                          contestant("one", kinds::Grade::not_asked)}};
                    }}};
  const Ran ran = run(request, folder.path() / "out");
  EXPECT_THAT(stats::write_cell_tables(folder.path() / "out", "some", folder.path() / "out"),
              HasSubstr("No answer is wrong.\n"));
  ASSERT_EQ(ran.times.size(), 2U);
  for (const stats::CellTimeRow& row : ran.times) {
    const bool takes_all = row.grade.algorithm == "all";
    EXPECT_EQ(row.grade.status, takes_all ? "ok" : "unsupported");
    EXPECT_EQ(row.samples > 0, takes_all);
  }
}

// A cell each: who missed a contact, who crashed, and nobody.
TEST(Cells, OfWhoIsWrongOrCrashes) {
  const TemporaryFolder folder;
  auto request = request_of(folder, "kind = \"points\"\nmeshes = [\"torus-200\"]\nqueries = 64\n");
  const auto contestant = [](const char* name, kinds::Grade grade, bool crashes) {
    return kinds::TimedContestant{.name = name,
                                  .origin = Origin::peer,
                                  .answer =
                                      [=] {
                                        if (crashes) std::abort();
                                      },
                                  .grade =
                                      [=] {
                                        kinds::TimedGrade sum;
                                        sum.add({grade, true}, 0);
                                        return sum;
                                      },
                                  .hash = [] { return std::uint64_t{1}; }};
  };
  request.cells = {{.group = "some", .name = "one", .make = [=] {
                      return kinds::TimedSet{
                          .queries = 1,
                          .graded = 1,
                          .contestants = {contestant("right", kinds::Grade::right, false),
                                          contestant("blind", kinds::Grade::missed, false),
                                          contestant("frail", kinds::Grade::right, true)}};
                    }}};
  run(request, folder.path() / "out");
  const std::string text =
      stats::write_cell_tables(folder.path() / "out", "some", folder.path() / "out");
  EXPECT_THAT(text, testing::ContainsRegex("\nblind +1 +1 +0 +0 +1\n"));
  EXPECT_THAT(text, HasSubstr("frail: crashed in 1 cell\n"));
  EXPECT_THAT(text, Not(HasSubstr("No answer is wrong")));
}

// Casts miss nothing, substeps do; answers do not depend on the threads.
TEST(Cells, OfMotion) {
  const TemporaryFolder folder;
  folder.write("bullets.toml", "generator = \"bullets\"\ncount = 80\nframes = 1\n");
  folder.write("spinners.toml", "generator = \"spinners\"\ncount = 24\nframes = 1\n");
  const auto request = cells::read_cells(
      folder.write("cells.toml",
                   "[[group]]\nkind = \"motion\"\nscenes = [\"bullets.toml\", \"spinners.toml\"]\n"
                   "threads = [1, 2]\nsubsteps = [1, 16]\nrounds = 6\nsample_seconds = 1e-5\n"
                   "casts = [\"gjk-ray-cast\", \"closed-form+gjk-ray-cast+rigid-advancement\"]\n"));
  ASSERT_EQ(request.cells.size(), 4U);
  const Ran ran = run(request, folder.path() / "out");
  EXPECT_FALSE(ran.result.ours_wrong);
  ASSERT_EQ(ran.grades.size(), 4U * 4);
  std::map<std::string, std::string> hash_of;
  std::int64_t missed = 0;
  for (const stats::GradeRow& row : ran.grades) {
    if (row.status == "unsupported") {
      EXPECT_EQ(row.algorithm, "gjk-ray-cast");
      EXPECT_EQ(row.group, "spinners");
      continue;
    }
    EXPECT_EQ(row.status, "ok");
    EXPECT_GT(row.true_hits, 0) << row.group;
    EXPECT_LT(row.true_hits, row.graded) << row.group;
    EXPECT_EQ(row.inexact, 0);
    const auto [known, is_new] = hash_of.emplace(row.group + row.algorithm, row.hit_hash);
    EXPECT_EQ(known->second, row.hit_hash) << row.algorithm;
    if (row.algorithm.find("substep") == std::string::npos) {
      EXPECT_EQ(row.missed + row.false_hits + row.gave_up, 0) << row.group << row.algorithm;
      EXPECT_EQ(row.hits, row.true_hits);
    } else {
      missed += row.missed;
    }
  }
  EXPECT_GT(missed, 0);
}

// Every question has answers, of fewer pairs than all of them; bodies come and go.
TEST(Cells, OfFramesOfBroadPhases) {
  const TemporaryFolder folder;
  folder.write("resting.toml",
               "generator = \"uniform\"\ncount = 300\noverlaps = 5\nstep = 0.3\nmoving = 1\n");
  folder.write("churn.toml",
               "generator = \"uniform\"\ncount = 300\noverlaps = 5\nstep = 0.3\nchurn = 0.2\n");
  const auto request = request_of(
      folder,
      "kind = \"frames\"\nscenes = [\"resting.toml\", \"churn.toml\"]\nmoving = [0.1, 0.5]\n"
      "frames = 5\nthreads = [1, 2]\n",
      R"(["naive", "sweep-and-prune", "packed-rtree", "verlet-list", "dynamic-bvh", "auto"])");
  ASSERT_EQ(request.cells.size(), 2U * 2 * 2 * 4);
  const Ran ran = run(request, folder.path() / "out");
  expect_sound(ran, request.cells.size());
  std::map<std::string, std::int64_t> told;
  for (const stats::GradeRow& row : ran.grades) {
    EXPECT_EQ(row.hits, row.true_hits) << row.algorithm;
    EXPECT_GT(row.hits, 0) << row.group << " " << row.cell;
    told[row.cell] += row.hits;
  }
  EXPECT_LT(told["changes"], told["moved"]);
  EXPECT_LT(told["moved"], told["pairs"]);
  EXPECT_EQ(told["moved"], told["moved, 2 threads"]);
  EXPECT_EQ(told["built"], told["pairs"]);
  // Both widths share their rounds.
  const std::filesystem::path out = folder.path() / "out";
  std::set<std::int64_t> places, blocks;
  std::map<std::string, int> twins;
  std::size_t samples = 0;
  for (const auto& row : record::read_rows<record::RawRow>(out / "raw.csv")) {
    if (row.square != 0 || row.round != 0 || row.input != ran.grades.front().group) continue;
    if (row.family != "pairs" && row.family != "pairs, 2 threads") continue;
    ++samples;
    EXPECT_EQ(row.threads, row.family == "pairs" ? 1 : 2);
    places.insert(row.position);
    blocks.insert(row.block);
    twins[row.family] += row.is_twin() ? 1 : 0;
  }
  EXPECT_GT(samples, 10U);
  EXPECT_EQ(places.size(), samples);
  EXPECT_EQ(blocks.size(), 1U);
  EXPECT_EQ(twins, (std::map<std::string, int>{{"pairs", 1}, {"pairs, 2 threads", 1}}));
  EXPECT_EQ(record::read_rows<stats::CellSpeedUpRow>(out / "set_speed_ups.csv").size(),
            ran.grades.size() / 2);
}

// Alone, triangles push bodies aside; welded, none does.
TEST(Cells, OfSlidingBodies) {
  const TemporaryFolder folder;
  const auto request = request_of(
      folder,
      "kind = \"sliding\"\nqueries = 12\ngrounds = \"fine\"\nbodies = [\"sphere\", \"box\"]\n");
  ASSERT_EQ(request.cells.size(), 2U);
  const Ran ran = run(request, folder.path() / "out");
  expect_sound(ran, request.cells.size());
  std::int64_t ghosts = 0;
  for (const stats::GradeRow& row : ran.grades) {
    const bool is_welded = row.algorithm.ends_with(" welded");
    if (!is_welded) ghosts += row.false_hits;
  }
  EXPECT_GT(ghosts, 0);
}

TEST(Cells, OfConvexBodiesAndMeshes) {
  const TemporaryFolder folder;
  const auto request =
      request_of(folder,
                 "kind = \"concave\"\nmeshes = \"torus-100\"\nqueries = 6\ntasks = \"contacts\"\n"
                 "convex_meshes = \"terrain-100\"\nconvex = [\"box\", \"hull-32\"]\n");
  ASSERT_EQ(request.cells.size(), 10U);
  expect_sound(run(request, folder.path() / "out"), request.cells.size());
}

TEST(Cells, AFinishedRunIsNotBegunAgain) {
  const TemporaryFolder folder;
  const auto request =
      request_of(folder, "kind = \"ccd\"\nqueries = 16\nfamilies = \"crossing\"\n");
  const std::filesystem::path out = folder.path() / "out";
  run(request, out);
  int said = 0;
  const auto resumed =
      cells::run_cells(request, out, record::FolderStart::resume, [&](const auto&) { ++said; });
  EXPECT_FALSE(resumed.interrupted);
  EXPECT_EQ(said, 0);
}

std::string error_of(const TemporaryFolder& folder, const std::string& keys) {
  try {
    request_of(folder, keys);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Cells, WrongFilesAreRefusedWithTheirLine) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of(folder, "kind = \"stars\"\n"), HasSubstr("cells.toml:3"));
  EXPECT_THAT(error_of(folder, "kind = \"rays\"\nmeshes = \"nothing.obj\"\n"),
              HasSubstr("nothing.obj"));
  EXPECT_THAT(error_of(folder, "kind = \"rays\"\nqueries = 1\n"), HasSubstr("cells.toml:4"));
  EXPECT_THAT(error_of(folder, "kind = \"ccd\"\nstars = 1\n"), HasSubstr("stars"));
  EXPECT_THAT(error_of(folder, "kind = \"motion\"\n"), HasSubstr("scenes"));
  folder.write("listed.toml", "frames = 3\nbody = [{shape = {type = \"sphere\", radius = 1}}]\n");
  folder.write("one.toml", "generator = \"uniform\"\ncount = 3\n");
  const std::string frames = "kind = \"frames\"\n";
  EXPECT_THAT(error_of(folder, frames), HasSubstr("scenes"));
  EXPECT_THAT(error_of(folder, frames + "scenes = \"one.toml\"\nmoving = 2\n"),
              HasSubstr("0 to 1"));
  EXPECT_THAT(error_of(folder, frames + "scenes = \"one.toml\"\nframes = 1\n"),
              HasSubstr("frames"));
  EXPECT_THAT(
      error_of(folder,
               frames + "scenes = \"one.toml\"\nframes = 2\nasks = [\"pairs\", \"pairs\"]\n"),
      HasSubstr("two cells are called 'one, pairs'"));
  folder.write("five.toml", "generator = \"uniform\"\ncount = 100\noverlaps = 5\n");
  EXPECT_THAT(error_of(folder, frames + "scenes = \"five.toml\"\nframes = 2\ncounts = [100, 1]\n"),
              HasSubstr("five.toml"));
  EXPECT_THAT(error_of(folder, frames + "scenes = \"listed.toml\"\nmoving = 0.5\n"),
              HasSubstr("listed.toml"));
  EXPECT_THAT(error_of(folder, "kind = \"ccd\"\nvertex_face = \"nothing.csv\"\n"),
              HasSubstr("nothing.csv"));
}

TEST(Cells, OfFeaturesWithASeparation) {
  const TemporaryFolder folder;
  const auto request = request_of(
      folder, "kind = \"ccd\"\nqueries = 32\nfamilies = \"crossing\"\nseparations = [0, 0.5]\n");
  ASSERT_EQ(request.cells.size(), 4U);
  EXPECT_EQ(request.cells[1].name, "crossing, within 0.5");
  expect_sound(run(request, folder.path() / "out"), request.cells.size());
  EXPECT_THAT(error_of(folder, "kind = \"ccd\"\nseparations = -1\n"), HasSubstr("separations"));
}

TEST(Cells, FilesOfQueriesOfOneNameAreToldApart) {
  const TemporaryFolder folder;
  std::string query;
  for (int row = 0; row < 8; ++row)
    query += std::to_string(row % 4) + ",1," + std::to_string(row / 4) + ",1,0,1,0\n";
  std::filesystem::create_directories(folder.path() / "a/one");
  std::filesystem::create_directories(folder.path() / "a/two");
  folder.write("a/one/x.csv", query);
  folder.write("a/two/x.csv", query);
  const auto request = request_of(folder,
                                  "kind = \"ccd\"\nfamilies = \"crossing\"\n"
                                  "vertex_face = [\"a/one/x.csv\", \"a/two/x.csv\"]\n"
                                  "edge_edge = \"a/two/x.csv\"\n");
  std::vector<std::string> names;
  for (const auto& cell : request.cells) names.push_back(cell.name);
  EXPECT_THAT(names,
              ::testing::ElementsAre("crossing", "one/x.csv", "two/x.csv", "crossing", "x.csv"));
}

TEST(Cells, OfTheProjectsFilesAreRead) {
  for (const char* name :
       {"rays", "casts", "ccd", "concave", "motion", "sliding", "frames", "frames_two_threads"}) {
    const auto request = cells::read_cells(std::filesystem::path(project_folder) /
                                           "datasets/campaigns" / (std::string(name) + ".toml"));
    EXPECT_EQ(request.name, name);
    EXPECT_GE(request.cells.size(), 8U) << name;
  }
}

// Earlier files had a table [cells], and results of them are compared with those of today's.
TEST(Cells, AreCalledAGroupNow) {
  const TemporaryFolder folder;
  const std::string fault = input_fault([&] {
    cells::read_cells(folder.write("old.toml", "name = \"old\"\n[cells]\nkind = \"rays\"\n"));
  });
  EXPECT_THAT(fault, HasSubstr("old.toml:2"));
  EXPECT_THAT(fault, HasSubstr("is now `[[group]]`"));
  EXPECT_TRUE(cells::has_cells(folder.path() / "old.toml"));
  EXPECT_FALSE(cells::has_cells(folder.write("run.toml", "[[group]]\nscenes = \"x.toml\"\n")));
  const std::filesystem::path rays =
      std::filesystem::path(project_folder) / "datasets/campaigns/rays.toml";
  EXPECT_EQ(record::value_of(cells::read_cells(rays).identity, "cells_hash"), "d9ecf84f26c4fc1c");
}

TEST(Columns, OfCellsAreDocumented) {
  expect_documented("set_grades.csv", record::column_docs<stats::GradeRow>());
  expect_documented("set_times.csv", record::column_docs<stats::CellTimeRow>());
  expect_documented("set_best.csv", record::column_docs<stats::CellBestRow>());
  expect_documented("set_speed_ups.csv", record::column_docs<stats::CellSpeedUpRow>());
  expect_documented("points.csv of motion", record::column_docs<cells::MotionPointRow>());
}

}  // namespace
}  // namespace touchstone
