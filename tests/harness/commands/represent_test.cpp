// Tests of touchstone scene represent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/files/csv.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

class Represent : public testing::Test {
 protected:
  Represent()
      : scene_(
            folder_.write("s.toml",
                          "body = [{shape = {type = \"sphere\", radius = 2}},\n"
                          "{shape = {type = \"hull\", vertices = [[0,0,0],[1,0,0],[0,1,0]]}},\n"
                          "{shape = {type = \"halfspace\", normal = [0,0,1], offset = 0}},\n"
                          "{mesh = \"t.obj\"}, {mesh = \"t.obj\", translation = [1, 2, 3]}]\n")) {
    folder_.write("t.obj",
                  "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  }

  struct Row {
    std::string kind, form, status;
    double bodies, triangles, parts;
  };
  std::string out() const { return (folder_.path() / "errors.csv").string(); }
  int status_of(std::vector<std::string> arguments) {
    commands::CommandLine line("");
    commands::add_scene_represent(line.add_command("represent", ""));
    arguments.insert(arguments.begin(), {"represent", scene_.string(), "--out", out()});
    return line.run(arguments);
  }
  std::vector<Row> run(const std::vector<std::string>& arguments,
                       int status = commands::exit_done) {
    EXPECT_EQ(status_of(arguments), status);
    std::vector<Row> rows;
    files::CsvReader(out(), {"kind", "form", "status", "bodies", "triangles", "parts"})
        .read([&](const files::CsvReader::Row& row) {
          rows.push_back({std::string(row.text(0)), std::string(row.text(1)),
                          std::string(row.text(2)), row.number(3), row.number(4), row.number(5)});
        });
    return rows;
  }

  TemporaryFolder folder_;
  std::filesystem::path scene_;
};

TEST_F(Represent, OneRowForEachShapeAndForm) {
  const std::vector<Row> rows =
      run({"--forms", "sphere,hull-8,mesh"}, commands::exit_measured_wrong);
  ASSERT_EQ(rows.size(), 9u);
  EXPECT_EQ(rows[0].kind, "sphere");
  EXPECT_EQ(rows[0].form, "sphere");
  EXPECT_EQ(rows[0].status, "ok");
  EXPECT_THAT(rows[2].status, testing::HasSubstr("without a mesh"));
  EXPECT_EQ(rows[8].form, "mesh");
  EXPECT_EQ(rows[8].status, "ok");
  EXPECT_EQ(rows[8].bodies, 2);
  EXPECT_EQ(rows[8].triangles, 4);
  EXPECT_EQ(rows[8].parts, 4);
}

TEST_F(Represent, ASideIsForAllForms) {
  const std::vector<Row> rows =
      run({"--forms", "sphere,box", "--side", "inner"}, commands::exit_measured_wrong);
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[1].form, "box inner");
  EXPECT_EQ(rows[1].status, "ok");
  EXPECT_NE(rows[2].status, "ok") << "of a flat body";
  EXPECT_EQ(rows[4].status, "ok");
}

TEST_F(Represent, AsGivenIsTheShapeIfItIsConvex) {
  const std::vector<Row> rows = run({"--forms", "as-given"}, commands::exit_measured_wrong);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].status, "ok");
  EXPECT_EQ(rows[1].status, "ok");
  EXPECT_THAT(rows[2].status, testing::HasSubstr("not convex"));
  scene_ = folder_.write("h.toml", "body = [{mesh = \"t.obj\", as = \"hull\"}]\n");
  const std::vector<Row> hull = run({"--forms", "as-given"});
  ASSERT_EQ(hull.size(), 1u);
  EXPECT_EQ(hull[0].status, "ok");
}

TEST_F(Represent, HasEveryUsualFormOfARing) {
  scene_ = folder_.write(
      "r.toml",
      "body = [{shape = {type = \"torus\", around = 16, across = 8, tube_radius = 0.2}}]\n");
  for (const Row& row : run({})) EXPECT_EQ(row.status, "ok") << row.form;
}

TEST_F(Represent, RefusesWhatIsNone) {
  EXPECT_THROW(run({"--forms", "ball"}), base::InputError);
  EXPECT_THROW(run({"--forms", "sphere inner"}), base::InputError);
  EXPECT_EQ(status_of({"--side", "left"}), commands::exit_bad_request);
}

}  // namespace
}  // namespace touchstone
