// Results folders with made-up times, for tests of their readers.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace touchstone {

struct FakeContestant {
  std::string name;
  double seconds = 1e-3;  // time of a frame, or of a query
  std::string pair_hash = "00000000000000aa";
  std::string status = "ok";
  int disagreements = 0;
  // Columns of its check rows: iterations to allocated_bytes, "" if not counted.
  std::string work = ",,,,,,,";
  std::string worst_error = {};  // the value in each of its check rows
  std::string batch = {};        // pairs of a call
  bool noisy = false;            // true if all its samples were disturbed
};

inline const char* origin_of(const std::string& name) {
  if (name == "limit") return "limit";
  const bool peer = name.starts_with("bullet-") || name.starts_with("fcl-") || name == "some-peer";
  return peer ? "peer" : "ours";
}

struct FakeBlock {
  std::string scene = "uniform", scene_hash = "0123456789abcdef";
  int bodies = 1000;
  int threads = 2;
  std::string task, pair_kind;  // set for a narrow phase, else empty
  std::vector<FakeContestant> contestants;
  bool twin = true;  // true if the first contestant has a twin
  double twin_factor = 1;
  bool suspect = false;  // true if the last row marks the set as suspect
};

struct FakeRun {
  std::vector<FakeBlock> blocks;
  int processes = 3, squares = 4, rounds = 4, frames = 8;
  double spread = 0.002;  // standard deviation of a time's logarithm
  // Standard deviation of the logarithm that all times of a square share.
  double square_spread = 0.05;
  std::uint64_t seed = 1;
  int noisy_squares = 0;  // the first ones of each process, ten times as slow
  std::string isa = "avx2";
  std::map<std::string, std::string> machine = {{"processor", "Test CPU"}, {"compiler", "GNU 12"}};

  std::string raw() const {
    std::string text =
        "campaign,scene,scene_hash,bodies,boxes,frame,broad,narrow,scalar,task,tolerance,threads,"
        "isa,pair_kind,phase,seconds,pair_count,pair_hash,contact_count,outcome_hash,"
        "disagreements,failures,status,kind,block,process,square,round,position,frames,twin,noise,"
        "stop,iterations,support_calls,box_tests,node_visits,candidates,bytes,allocations,"
        "allocated_bytes,worst_error,origin,batch\n";
    std::mt19937_64 random(seed);
    std::normal_distribution<double> draw(0, 1);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const FakeBlock& block = blocks[b];
      const bool narrow = !block.task.empty();
      const auto row = [&](const FakeContestant& c, int frame, const char* phase, double seconds,
                           const std::string& rest) {
        text += fmt::format("fake,{},{},{},tight,{},{},{},{},{},,{},{},{},{},{},{},{},{}\n",
                            block.scene, block.scene_hash, block.bodies, frame,
                            narrow ? "" : c.name, narrow ? c.name : "", narrow ? "double" : "",
                            block.task, block.threads, isa, block.pair_kind, phase,
                            std::isnan(seconds) ? std::string() : fmt::format("{}", seconds), rest,
                            origin_of(c.name), c.batch);
      };
      for (int frame = 0; frame < frames; ++frame) {
        for (const FakeContestant& c : block.contestants) {
          const std::string verdict = fmt::format(
              "50,{},5,77,{},0,{},check,{},,,,,,,,,{},{}", c.pair_hash,
              narrow ? std::to_string(c.disagreements) : "", c.status, b, c.work, c.worst_error);
          row(c, frame, narrow ? "narrow" : "find_pairs", 1e-3, verdict);
        }
      }
      for (int process = 0; process < processes; ++process) {
        for (int square = 0; square < squares; ++square) {
          const bool noisy = square < noisy_squares;
          const double shared = std::exp(square_spread * draw(random)) * (noisy ? 10 : 1);
          for (int round = 0; round < rounds; ++round) {
            for (std::size_t i = 0; i < block.contestants.size() + (block.twin ? 1 : 0); ++i) {
              const bool twin = i == block.contestants.size();
              const FakeContestant& c = block.contestants[twin ? 0 : i];
              if (c.status == "crashed") continue;
              const double seconds = c.seconds * (twin ? block.twin_factor : 1) * shared *
                                     std::exp(spread * draw(random)) * frames * (narrow ? 50 : 1);
              const std::string place = fmt::format(
                  "{},,,,,,{},sample,{},{},{},{},{},{},{},{},,,,,,,,,,", frames * 50, c.status, b,
                  process, square, round, i, frames, twin ? "1" : "",
                  noisy || c.noisy                                                     ? "pressure"
                  : block.suspect && process + 1 == processes && square + 1 == squares ? "canary"
                                                                                       : "");
              if (narrow) {
                row(c, 0, "narrow", seconds, place);
              } else {
                row(c, 0, "update", 0.25 * seconds, place);
                row(c, 0, "find_pairs", 0.75 * seconds, place);
              }
            }
          }
        }
      }
    }
    return text;
  }

  // Makes the folder with raw.csv and machine.csv, and returns it.
  std::filesystem::path write(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "raw.csv") << raw();
    std::ofstream facts(folder / "machine.csv");
    facts << "name,value\n";
    for (const auto& [name, value] : machine) facts << name << ',' << value << '\n';
    return folder;
  }
};

// Returns three broad phases of 1, 2 and 5 ms, and two narrow phases of 100 and 130 ns.
inline FakeRun fake_run() {
  FakeRun run;
  FakeBlock broad;
  broad.contestants = {{"sweep-one-axis", 1e-3}, {"uniform-grid", 2e-3}, {"naive", 5e-3}};
  FakeBlock narrow;
  narrow.task = "distance";
  narrow.pair_kind = "box-sphere";
  narrow.contestants = {{"gjk", 100e-9}, {"mpr", 130e-9}};
  run.blocks = {broad, narrow};
  return run;
}

}  // namespace touchstone
