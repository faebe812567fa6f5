// Tests of the flags of noisy rounds.
#include "harness/measure/noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

// Returns the flags of a second with these seconds waited and stolen.
std::string flags(std::optional<double> waited, std::optional<double> stolen,
                  double preempted = 0) {
  measure::NoiseReading before{.waited = 100, .stolen = 7};
  measure::NoiseReading after;
  if (waited) after.waited = 100 + *waited;
  if (stolen) after.stolen = 7 + *stolen;
  return measure::noise_flags(before, after, 1, preempted);
}

TEST(NoiseFlags, EachBeyondItsLimit) {
  EXPECT_EQ(flags(0, 0), "");
  EXPECT_EQ(flags(0.49, 0), "");
  EXPECT_EQ(flags(0.51, 0), "pressure");
  EXPECT_EQ(flags(0, 0.009), "");
  EXPECT_EQ(flags(0, 0.011), "steal");
  EXPECT_EQ(flags(0, 0, 0.049), "");
  EXPECT_EQ(flags(0, 0, 0.051), "preempted");
  EXPECT_EQ(flags(1, 1, 0.5), "pressure+steal+preempted");
  EXPECT_EQ(flags(0, 1, 0.5), "steal+preempted");
}

TEST(NoiseFlags, LimitsGrowWithTheTime) {
  EXPECT_EQ(
      measure::noise_flags({.waited = 0, .stolen = 0}, {.waited = 0.5, .stolen = 0.05}, 10, 0.1),
      "");
  EXPECT_EQ(
      measure::noise_flags({.waited = 0, .stolen = 0}, {.waited = 0.5, .stolen = 0.05}, 0.1, 0.1),
      "pressure+steal+preempted");
}

TEST(NoiseFlags, WhatIsUnknownRaisesNone) {
  EXPECT_EQ(flags({}, {}), "");
  EXPECT_EQ(flags({}, 1), "steal");
  EXPECT_EQ(flags(1, {}), "pressure");
  EXPECT_EQ(measure::noise_flags({}, {.waited = 1e9, .stolen = 1e9}, 1, 0), "");
  EXPECT_EQ(measure::noise_flags({}, {}, 1, 0.06), "preempted");
}

class NoiseFiles : public testing::Test {
 protected:
  void write(const std::string& pressure, const std::string& load, const std::string& stat) {
    std::filesystem::create_directories(proc_.path() / "pressure");
    proc_.write("pressure/cpu", pressure);
    proc_.write("loadavg", load);
    proc_.write("stat", stat);
  }
  std::string objection() const { return measure::MachineLoad::now(proc_.path()).objection(); }

  static constexpr const char* quiet_pressure =
      "some avg10=1.50 avg60=0.88 avg300=0.77 total=2500000\n"
      "full avg10=99.00 avg60=0.00 avg300=0.00 total=9\n";
  static constexpr const char* quiet_load = "0.20 0.18 0.12 1/80 11206\n";
  static constexpr const char* some_stat = "cpu  10 20 30 40 50 60 70 300 0 0\ncpu0 1 1 1 1\n";
  TemporaryFolder proc_;
};

TEST_F(NoiseFiles, AreReadAsTheSystemWritesThem) {
  write(quiet_pressure, quiet_load, some_stat);
  const measure::NoiseReading reading = measure::NoiseReading::now(proc_.path());
  EXPECT_EQ(reading.waited, 2.5);
  EXPECT_EQ(reading.stolen, 300.0 / static_cast<double>(sysconf(_SC_CLK_TCK)));
  const measure::MachineLoad load = measure::MachineLoad::now(proc_.path());
  EXPECT_EQ(load.pressure, 1.5);
  EXPECT_EQ(load.running, 1);
  EXPECT_EQ(load.objection(), "");
}

TEST_F(NoiseFiles, ThatAreNotThereOrOddAreUnknown) {
  EXPECT_FALSE(measure::NoiseReading::now(proc_.path()).waited);
  EXPECT_FALSE(measure::NoiseReading::now(proc_.path()).stolen);
  EXPECT_THAT(objection(), HasSubstr("/proc/pressure/cpu cannot be read"));
  write("", "", "");
  EXPECT_FALSE(measure::NoiseReading::now(proc_.path()).waited);
  EXPECT_FALSE(measure::NoiseReading::now(proc_.path()).stolen);
  EXPECT_THAT(objection(), HasSubstr("unknown"));
  write("some avg10=x total=\n", "none\n", "cpu 1 2 3\n");
  EXPECT_FALSE(measure::NoiseReading::now(proc_.path()).waited);
  EXPECT_FALSE(measure::NoiseReading::now(proc_.path()).stolen);
  EXPECT_THAT(objection(), HasSubstr("/proc/pressure/cpu cannot be read"));
  write(quiet_pressure, "0.20 0.18\n", some_stat);
  EXPECT_THAT(objection(), HasSubstr("/proc/loadavg cannot be read"));
}

TEST_F(NoiseFiles, ABusyMachineIsObjectedTo) {
  write("some avg10=5.01 avg60=0.88 avg300=0.77 total=1\n", quiet_load, some_stat);
  EXPECT_THAT(objection(), HasSubstr("5.0 % of the last ten seconds"));
  write("some avg10=5.00 avg60=0.88 avg300=0.77 total=1\n", quiet_load, some_stat);
  EXPECT_EQ(objection(), "");
  write(quiet_pressure, "0.20 0.18 0.12 2/80 11206\n", some_stat);
  EXPECT_THAT(objection(), HasSubstr("1 other task is at work"));
  write(quiet_pressure, "0.20 0.18 0.12 4/80 11206\n", some_stat);
  EXPECT_THAT(objection(), HasSubstr("3 other tasks are at work"));
}

TEST(NoiseReadings, OfThisMachineNeverGoBack) {
  const measure::NoiseReading first = measure::NoiseReading::now();
  const measure::NoiseReading second = measure::NoiseReading::now();
  EXPECT_GE(second.waited.value_or(0), first.waited.value_or(0));
  EXPECT_GE(second.stolen.value_or(0), first.stolen.value_or(0));
}

}  // namespace
}  // namespace touchstone
