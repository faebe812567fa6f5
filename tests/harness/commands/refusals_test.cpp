// Requests that would be done otherwise than asked, or that would lose a file, are refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

class Refusals : public ::testing::Test {
 protected:
  Refusals() {
    folder.write("boxes.jsonl", std::string(boxes) + "\n");
    folder.write("mesh.jsonl", std::string("\n") + boxes + "\n" + mesh + "\n");
  }

  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  void refuse(const std::string& arguments, const std::string& text) {
    expect_refusal(arguments, text, folder);
  }
  // Expects that the second file is refused beside the first, and another one taken.
  void expect_two_files(const std::string& command, const std::string& first,
                        const std::string& second) {
    refuse(command + " " + first + path("same.csv") + " " + second + path("same.csv"),
           "name the same file");
    const Ran ran =
        run_program(command + " " + first + path("one.csv") + " " + second + path("two.csv"));
    EXPECT_EQ(ran.status, 0) << ran.text;
  }

  static constexpr const char* boxes =
      R"({"id":"x","a":{"shape":{"type":"box","half_extents":[1,1,1]}},)"
      R"("b":{"shape":{"type":"box","half_extents":[1,1,1]},"translation":[3,0,0]}})";
  static constexpr const char* mesh =
      R"({"id":"m","a":{"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]]}},)"
      R"("b":{"shape":{"type":"box","half_extents":[1,1,1]},"translation":[3,0,0]}})";
  TemporaryFolder folder;
};

TEST_F(Refusals, QueryOptionsThatNothingHeeds) {
  const std::string out = " --out " + path("out.csv");
  const std::string concave =
      "query " + path("mesh.jsonl") + " --narrow fused --task distance" + out;
  for (const std::string option : {"--margin", "--duality-gap"}) {
    refuse(concave + " " + option + " 1",
           option + " was given; expected it with questions of the kind pair, and not mesh");
    for (const std::string task : {"intersect", "penetration"}) {
      refuse("query " + path("boxes.jsonl") + " --narrow gjk --task " + task + out + " " + option +
                 " 1",
             option + " was given; expected it with --task distance");
    }
  }
  const std::string convex = "query " + path("boxes.jsonl") + " --narrow gjk --task distance" + out;
  refuse(convex + " --mid wide-bvh",
         "--mid was given; expected it with questions of the kind mesh, and not pair");
  refuse(convex + " --parts certified",
         "--parts was given; expected it with questions of the kind mesh, and not pair");
  refuse(convex + " --tolerance 1e-3 --duality-gap 1e-3", "excludes");
  for (const std::string& heeded :
       {concave + " --mid naive --parts certified --tolerance 1e-3 --max-iterations 90",
        convex + " --margin 1 --tolerance 1e-3 --max-iterations 90"}) {
    const Ran ran = run_program(heeded);
    EXPECT_EQ(ran.status, 0) << ran.text;
  }
}

TEST_F(Refusals, QueryTasksOfOtherPhases) {
  const std::string more = " --narrow fused --task signed --out " + path("out.csv");
  refuse("query " + path("boxes.jsonl") + more, "--with fused names concave phases");
  refuse("query " + path("mesh.jsonl") + more, "mesh.jsonl:3: case 'm' has a mesh or a compound");
}

TEST_F(Refusals, UnknownShapes) {
  const auto file = folder.write(
      "odd.jsonl",
      R"({"id":"x","a":{"shape":{"type":"ball","radius":1}},"b":{"shape":{"type":"sphere","radius":1}}})");
  refuse("query " + file.string() + " --narrow gjk --task intersect --out " + path("out.csv"),
         "halfspace, mesh, compound");
}

TEST_F(Refusals, ThreadsOfFilesThatHaveTheirOwn) {
  for (const std::string table : {"cells", "trade"}) {
    const auto file = folder.write("work.toml", "[" + table + "]\nof = \"rays\"\n");
    refuse("run " + file.string() + " --threads 2 --out " + path("out"),
           "--threads was given; expected it with a shard");
  }
}

TEST_F(Refusals, OptionsOfCampaignsWithOtherWork) {
  const auto file = folder.write("work.toml", "[cells]\nof = \"rays\"\n");
  for (const std::string option : {"--quick", "--dry-run", "--strict", "--depth-error 0.1"}) {
    refuse("run " + file.string() + " " + option + " --out " + path("out"),
           "is no campaign of scenes, and " + option.substr(0, option.find(' ')) + " was given");
    refuse("run --plan " + path("plan") + " --shard 0 " + option, " excludes ");
  }
}

TEST_F(Refusals, OutputsThatWouldBeOneFile) {
  folder.write("pairs.csv", "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n0,0,0,0,0,1,1,1\n");
  const std::string query = "query " + path("mesh.jsonl") + " --narrow fused --task contacts ";
  expect_two_files(query, "--out ", "--pairs ");
  expect_two_files(query + "--out " + path("out.csv"), "--pairs ", "--contacts ");
  expect_two_files("query " + path("boxes.jsonl") + " --kind cast --cast exact", "--out ",
                   "--save-certificates ");
  expect_two_files("query " + path("pairs.csv") + " --broad sweep-three-axes", "--out ",
                   "--moved ");
  std::filesystem::create_symlink(path("one.csv"), path("link.csv"));
  refuse(query + "--out " + path("one.csv") + " --pairs " + path("link.csv"), "name the same file");
  const Ran ran = run_program(query + "--out /dev/null --pairs /dev/null --contacts /dev/null");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_EQ(run_program(query + "--out /dev/stdout --pairs /dev/stdout").status, 0);
}

TEST_F(Refusals, OutputsThatWouldReplaceInputs) {
  const auto expect_kept = [&](const std::string& command, const std::string& file) {
    const std::string before = folder.read(file);
    for (const std::string& name : {path(file), path("./" + file),
                                    path("../") + folder.path().filename().string() + "/" + file}) {
      refuse(command + " --out " + name, "--out would overwrite");
    }
    EXPECT_EQ(folder.read(file), before);
    const Ran ran = run_program(command + " --out " + path("out.csv"));
    EXPECT_EQ(ran.status, 0) << ran.text;
    std::filesystem::remove(path("out.csv"));
  };
  folder.write("pairs.csv", "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n0,0,0,0,0,1,1,1\n");
  folder.write("two.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
  folder.write("rays.csv",
               "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,t_max\n"
               "0.5,0.25,3,0,0,-1,inf\n");
  folder.write("points.csv", "x,y,z\n0,0,1\n");
  folder.write("ccd.csv", "0,0,1\n-1,-1,0\n1,-1,0\n0,1,0\n0,0,-1\n-1,-1,0\n1,-1,0\n0,1,0\n");
  expect_kept("query " + path("boxes.jsonl") + " --narrow gjk --task distance", "boxes.jsonl");
  expect_kept("query " + path("mesh.jsonl") + " --narrow fused --task distance", "mesh.jsonl");
  expect_kept("query " + path("boxes.jsonl") + " --kind cast --cast exact", "boxes.jsonl");
  expect_kept("query " + path("ccd.csv") + " --features vertex-face --ccd exact", "ccd.csv");
  expect_kept("query " + path("pairs.csv") + " --broad sweep-three-axes", "pairs.csv");
  const std::string rays =
      "query " + path("rays.csv") + " --in " + path("two.obj") + " --cast exact --task closest";
  expect_kept(rays, "two.obj");
  expect_kept(rays, "rays.csv");
  const std::string points = "query " + path("points.csv") + " --in " + path("two.obj");
  expect_kept(points, "two.obj");
  expect_kept(points, "points.csv");
}

TEST_F(Refusals, MeshesWithoutFaces) {
  folder.write("cloud.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\n");
  folder.write("rays.csv",
               "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,t_max\n"
               "0.5,0.25,3,0,0,-1,inf\n");
  folder.write("points.csv", "x,y,z\n0,0,1\n");
  const std::string out = " --out " + path("out.csv");
  refuse(
      "query " + path("rays.csv") + " --in " + path("cloud.obj") + " --cast exact --task any" + out,
      "cloud.obj: the mesh has no faces");
  refuse("query " + path("points.csv") + " --in " + path("cloud.obj") + out,
         "cloud.obj: the mesh has no faces");
}

TEST_F(Refusals, PairsSayWhatTheyRound) {
  const std::string columns = "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n";
  const std::string rest = " --broad sweep-three-axes --out " + path("out.csv");
  const auto exact = folder.write("exact.csv", columns + "0,0,0,0,0.5,1,1,1\n");
  EXPECT_EQ(run_program("query " + exact.string() + rest).text.find("rounded"), std::string::npos);
  const auto other =
      folder.write("other.csv", columns + "0,0,0.1,0,0.5,1,1.3,1\n1,0,0,0,0,1,1,16777217\n");
  const Ran ran = run_program("query " + other.string() + rest);
  EXPECT_EQ(ran.status, 0);
  EXPECT_NE(ran.text.find("3 coordinates are not floats, and were rounded outwards"),
            std::string::npos);
}

// The scene's own file, the mesh that it names, and the scene that it imports.
TEST_F(Refusals, OutputsOverAScenesFiles) {
  const std::string surface =
      "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const std::vector<std::string> names = {"mesh.obj", "listed.toml", "scene.toml"};
  const std::vector<std::string> texts = {surface, "[[body]]\nmesh = \"mesh.obj\"\n",
                                          "import = \"listed.toml\"\n"};
  for (std::size_t i = 0; i < 3; ++i) folder.write(names[i], texts[i]);
  folder.write("rays.csv",
               "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,t_max\n"
               "0,0,9,0,0,-1,inf\n");
  const std::string scene = path("scene.toml");
  for (const std::string& command :
       {"scene represent " + scene + " --forms sphere",
        "query " + path("rays.csv") + " --in " + scene + " --task any --cast exact"}) {
    for (std::size_t i = 0; i < 3; ++i) {
      refuse(command + " --out " + path(names[i]), "would overwrite");
      EXPECT_EQ(folder.read(names[i]), texts[i]);
    }
    EXPECT_EQ(run_program(command + " --out " + path("out.csv")).status, 0) << command;
  }
  // Others write only names that end otherwise than a mesh's.
  std::filesystem::create_symlink(path("mesh.obj"), path("mesh.png"));
  std::filesystem::create_symlink(path("mesh.obj"), path("mesh.csv"));
  refuse("scene draw " + scene + " --out " + path("mesh.png"), "would overwrite");
  refuse("scene record " + scene + " --out " + path("mesh.csv"), "would overwrite");
  for (const std::string command : {"advise --front", "advise"}) {
    const std::string own = command == "advise --front" ? "trade.toml" : "advice.toml";
    folder.write(own, texts[1]);
    refuse(command + " " + path(own) + " --out " + folder.path().string() +
               (command == "advise --front" ? "" : " --max-error 0"),
           "would overwrite");
    EXPECT_EQ(folder.read(own), texts[1]);
  }
}

}  // namespace
}  // namespace touchstone
