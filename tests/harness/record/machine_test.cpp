// Tests of the facts of the machine.
#include "harness/record/machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <map>
#include <string>

#include "harness/record/build.h"

namespace touchstone {
namespace {

std::map<std::string, std::string> facts() {
  std::map<std::string, std::string> all;
  for (const auto& [name, value] : record::machine_facts()) {
    EXPECT_TRUE(all.emplace(name, value).second) << name << " twice";
  }
  return all;
}

TEST(Machine, TellsWhatAReaderOfTheTimesNeeds) {
  const auto all = facts();
  for (const char* name : {"processor",
                           "microcode",
                           "cores_online",
                           "cores_physical",
                           "simultaneous_multithreading",
                           "cache_0",
                           "governor",
                           "boost",
                           "frequency_driver",
                           "numa_nodes",
                           "memory",
                           "kernel",
                           "hypervisor",
                           "address_randomisation",
                           "transparent_huge_pages",
                           "affinity",
                           "processor_limit",
                           "memory_limit",
                           "compiler",
                           "flags",
                           "flags_bullet",
                           "flags_fcl",
                           "flags_libccd",
                           "flags_onetbb",
                           "eigen",
                           "onetbb",
                           "bullet",
                           "fcl",
                           "libccd",
                           "ode",
                           "mujoco",
                           "embree",
                           "cgal",
                           "boost_geometry",
                           "c_library",
                           "instructions_in_use",
                           "commit",
                           "tree",
                           "sources",
                           "command_line",
                           "preloaded",
                           "clock_source",
                           "perf_event_paranoid"}) {
    ASSERT_TRUE(all.contains(name)) << name;
  }
  for (const auto& [name, value] : all) {
    EXPECT_FALSE(value.empty()) << name;
    EXPECT_EQ(value.find_first_of("\n\r"), std::string::npos) << name;
  }
  EXPECT_THAT(all.at("flags"), testing::HasSubstr("-ffp-contract=off"));
  EXPECT_THAT(all.at("command_line"), testing::HasSubstr("test_harness_record"));
  EXPECT_EQ(record::shell_line(std::string("/a b/touchstone\0run\0my scene.toml\0it's\0", 39)),
            "touchstone run 'my scene.toml' 'it'\\''s'");
  // What a program puts in front for its second half is no word of the user's.
  EXPECT_EQ(record::shell_line(std::string("/a/touchstone\0--of-build=1\0check\0", 33)),
            "touchstone check");
}

// The programs of the tests are built from what nobody says to them, so this says it.
TEST(Machine, SaysWhatWasBuilt) {
  const std::map<std::string, std::string> before = facts();
  EXPECT_EQ(before.at("commit"), "unknown");
  const std::string program = record::hash_of_program();
  static constexpr record::Build one{"c1", "clean", "s1", "i1"};
  static constexpr record::Build other_commit{"c2", "changed", "s1", "i1"};
  static constexpr record::Build other_sources{"c1", "clean", "s2", "i2"};
  record::set_build(one);
  EXPECT_EQ(facts().at("commit"), "c1");
  EXPECT_EQ(facts().at("tree"), "clean");
  EXPECT_EQ(facts().at("sources"), "s1");
  const std::string of_one = record::hash_of_program();
  EXPECT_NE(of_one, program);
  record::set_build(other_commit);
  EXPECT_EQ(record::hash_of_program(), of_one);
  record::set_build(other_sources);
  EXPECT_NE(record::hash_of_program(), of_one);
  static constexpr record::Build unknown;
  record::set_build(unknown);
}

TEST(Machine, AffinityIsThatOfTheProcess) {
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(facts().at("affinity"), std::to_string(first));
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

// Facts decide whether a run may be resumed, so they must not change by themselves.
TEST(Machine, SaysTheSameTwice) { EXPECT_EQ(record::machine_facts(), record::machine_facts()); }

}  // namespace
}  // namespace touchstone
