// Where the project's files are, from the path of the program, and which file of a name is taken.
#include "harness/base/data_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

// A prefix in which a program is installed, and a scene.
struct Prefix {
  TemporaryFolder folder;
  fs::path data = folder.path() / "share/touchstone";

  Prefix() {
    fs::create_directories(data / "datasets");
    std::ofstream(data / "datasets/kept.toml") << "frames = 1\n";
  }
  base::DataFolder found() const { return base::data_folder_of(folder.path() / "bin/touchstone"); }
};

TEST(DataFolder, OfAnInstallationIsBesideItsPrograms) {
  const Prefix prefix;
  EXPECT_EQ(prefix.found().path, prefix.data);
  EXPECT_TRUE(prefix.found().is_installed);
}

TEST(DataFolder, OfABuildIsTheSourceTree) {
  const TemporaryFolder build, source;
  std::ofstream(source.path() / "CMakeLists.txt") << "project(x)\n";
  fs::create_directories(build.path() / "share");
  fs::create_directory_symlink(source.path(), build.path() / "share/touchstone");
  const base::DataFolder found = base::data_folder_of(build.path() / "harness/touchstone");
  EXPECT_EQ(found.path, source.path());
  EXPECT_FALSE(found.is_installed);
}

// As programs do that make links into the folders of many installations.
TEST(DataFolder, OfAnInstallationMayBeALink) {
  const Prefix prefix;
  const TemporaryFolder other;
  fs::create_directories(other.path() / "share");
  fs::create_directory_symlink(prefix.data, other.path() / "share/touchstone");
  EXPECT_TRUE(base::data_folder_of(other.path() / "bin/touchstone").is_installed);
}

TEST(DataFolder, OfThisProgramIsTheSourceTree) {
  EXPECT_EQ(base::data_folder().path, fs::path(project_folder));
  EXPECT_FALSE(base::data_folder().is_installed);
}

TEST(DataFolder, NeedNotBeThere) {
  const base::DataFolder none = base::data_folder_of("/nowhere/bin/touchstone");
  EXPECT_EQ(none.path, "/nowhere/share/touchstone");
  EXPECT_EQ(base::found("datasets/kept.toml", none), "datasets/kept.toml");
}

TEST(Found, AUsersFileComesFirst) {
  const Prefix prefix;
  const TemporaryFolder here;
  const fs::path before = fs::current_path();
  fs::current_path(here.path());
  EXPECT_EQ(base::found("datasets/kept.toml", prefix.found()), prefix.data / "datasets/kept.toml");
  EXPECT_EQ(base::found("datasets", prefix.found()), prefix.data / "datasets");
  EXPECT_EQ(base::found("datasets/none.toml", prefix.found()), "datasets/none.toml");
  EXPECT_EQ(base::found("", prefix.found()), "");
  EXPECT_EQ(base::found("/datasets/kept.toml", prefix.found()), "/datasets/kept.toml");
  fs::create_directory("datasets");
  std::ofstream("datasets/kept.toml") << "frames = 2\n";
  EXPECT_EQ(base::found("datasets/kept.toml", prefix.found()), "datasets/kept.toml");
  fs::current_path(before);
}

}  // namespace
}  // namespace touchstone
