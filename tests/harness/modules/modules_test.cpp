// Tests of loading modules.
#include "harness/modules/modules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/files/text_file.h"
#include "harness/modules/file_word.h"
#include "harness/modules/shared_object.h"
#include "tests/harness/modules/built_module.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

void expect_fault(const std::filesystem::path& file, const std::string& text) {
  try {
    modules::load(file);
    ADD_FAILURE() << file << " was loaded";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(file.filename().string() + ": "));
    EXPECT_THAT(error.what(), HasSubstr(text));
  }
}

std::size_t mappings() {
  std::ifstream maps("/proc/self/maps");
  return static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(maps), std::istreambuf_iterator<char>(), '\n'));
}

TEST(Modules, WhatIsNoModuleIsRefused) {
  const TemporaryFolder folder;
  expect_fault(folder.path() / "none.so",
               "No such file or directory; expected the file of a module");
  files::write_text(folder.path() / "text.so", "no shared object\n");
  expect_fault(folder.path() / "text.so", "cannot be loaded: ");
  const auto expect_refused = [&](const std::string& fault, const std::string& text) {
    expect_fault(built_module(folder.path(), fault), text);
  };
  expect_refused("no_symbol", "has no symbol touchstone_module");
  expect_refused("wrong_version", "is of version 77 of touchstone_module.h; expected version 1");
  expect_refused("no_offer", "touchstone_module() returned NULL; expected tables of version 1");
  expect_refused("tiny", "TouchstoneModule has the struct_size 4; expected sizeof, which is 64");
  expect_refused("empty", "offers no algorithm; expected at least one");
  expect_refused("starts_thread", "starts threads when it is loaded");
}

TEST(Modules, WrongTablesAreRefused) {
  const TemporaryFolder folder;
  const auto expect_refused = [&](const std::string& fault, const std::string& text) {
    expect_fault(built_module(folder.path(), fault), text);
  };
  expect_refused("small", "broad phases has the struct_size 12");
  expect_refused("cut", "has the struct_size");
  expect_refused("null_function", "'mine-boxes': its function find_pairs is NULL");
  expect_refused("bad_name", "the name of one of its broad phases: found 'My Boxes'");
  expect_refused("group_name", "found 'ours', which means several algorithms");
  expect_refused("taken", "an algorithm is called 'naive' already");
  expect_refused("no_citation", "mine-boxes, citation: found ''");
}

TEST(Modules, AFileThatFailsWhenItIsLoadedCostsAMessage) {
  const TemporaryFolder folder;
  const auto expect_refused = [&](const std::string& fault, const std::string& text) {
    expect_fault(built_module(folder.path(), fault), text);
  };
  expect_refused("crashes_at_load", "killed by signal 11");
  expect_refused("exits_at_load", "left by exit(0)");
  expect_refused("crashes_at_call", "killed by signal 11");
  expect_refused("throws_at_call", "touchstone_module() threw: thrown by the module");
  expect_refused("throws_number_at_call", "threw something that is no std::exception");
  expect_refused("hangs_at_call", "no answer in time");
  expect_refused("wild_table", "killed by signal 11");
  expect_refused("crashes_at_supports", "killed by signal 11");
  expect_refused("exits_at_supports", "left by exit(0)");
  expect_refused("throws_at_supports", "throws when it is asked what it supports");
}

TEST(Modules, AWordWithASlashOrAnEndingIsAFile) {
  EXPECT_TRUE(modules::is_file("./libmine.so"));
  EXPECT_TRUE(modules::is_file("libmine.so"));
  EXPECT_TRUE(modules::is_file("/usr/lib/mine"));
  EXPECT_FALSE(modules::is_file("gjk"));
  EXPECT_FALSE(modules::is_file(""));
}

TEST(Modules, AThousandLoadsLeakNothing) {
  const TemporaryFolder folder;
  const std::filesystem::path file = built_module(folder.path(), "none");
  const auto load = [&] {
    const modules::SharedObject object(file);
    EXPECT_NE(object.offer().boxes, nullptr);
  };
  for (int i = 0; i < 10; ++i) load();
  const std::size_t mapped = mappings(), bytes = mallinfo2().uordblks;
  for (int i = 0; i < 1000; ++i) load();
  EXPECT_LE(mappings(), mapped + 2);
  EXPECT_LE(mallinfo2().uordblks, bytes + 4096);
}

TEST(Modules, EntriesAreTimedAndOfAModule) {
  const TemporaryFolder folder;
  const std::filesystem::path file = built_module(folder.path(), "none");
  modules::load(file);
  modules::load(file);  // changes nothing
  modules::load_named("gjk,," + file.string());
  const BroadPhaseEntry* const boxes = registry::find<BroadPhaseEntry>("mine-boxes");
  ASSERT_NE(boxes, nullptr);
  EXPECT_TRUE(is_timed(boxes->info));
  EXPECT_EQ(boxes->info.origin, Origin::module);
  EXPECT_EQ(registry::module_of(boxes->info), modules::file_of(file.string()));
  const NarrowPhaseEntry* const pairs = registry::find<NarrowPhaseEntry>("mine-spheres");
  ASSERT_NE(pairs, nullptr);
  EXPECT_TRUE(offers(*pairs, ShapeKind::sphere, ShapeKind::sphere, Task::distance));
  EXPECT_FALSE(offers(*pairs, ShapeKind::sphere, ShapeKind::box, Task::distance));
  EXPECT_FALSE(offers(*pairs, Precision::float32));
  ASSERT_EQ(modules::facts().size(), 1u);
  EXPECT_EQ(modules::facts()[0].first, "module none.so");
}

}  // namespace
}  // namespace touchstone
