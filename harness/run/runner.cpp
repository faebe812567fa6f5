#include "harness/run/runner.h"

#include <fmt/core.h>

#include <csignal>
#include <map>
#include <random>
#include <set>
#include <system_error>
#include <utility>

#include "harness/error.h"
#include "harness/run/broad_runner.h"
#include "harness/run/machine.h"
#include "harness/run/narrow_runner.h"
#include "harness/run/progress.h"
#include "harness/scene/player.h"

namespace touchstone {
namespace {

volatile std::sig_atomic_t interrupt = 0;

// Lets the frame at hand end on SIGINT; a second one ends the program as usual.
class InterruptGuard {
 public:
  InterruptGuard() {
    interrupt = 0;
    previous_ = std::signal(SIGINT, [](int) {
      interrupt = 1;
      std::signal(SIGINT, SIG_DFL);
    });
  }
  ~InterruptGuard() { std::signal(SIGINT, previous_); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*previous_)(int);
};

std::vector<Block> blocks_of(const Campaign& campaign) {
  std::vector<Block> blocks;
  for (const CampaignGroup& group : campaign.groups) {
    for (const std::filesystem::path& scene : group.scenes) {
      for (const std::int64_t count : group.counts) {
        for (const std::int64_t seed : group.seeds) {
          for (const BoxKind boxes : group.boxes) {
            for (const int threads : group.threads) {
              blocks.push_back({&group, scene, {count, seed, group.frames}, boxes, threads});
            }
          }
        }
      }
    }
  }
  return blocks;
}

std::string label(const Block& block, const Scene& scene) {
  return fmt::format("{}, {} bodies, {} frames, {} boxes, {} thread{}", scene.name, scene.size(),
                     scene.frames, to_string(block.boxes), block.threads,
                     block.threads == 1 ? "" : "s");
}

// Appends the findings' new rows to the file.
class RowWriter {
 public:
  RowWriter(const Campaign& campaign, const std::filesystem::path& file)
      : campaign_(campaign.name), file_(file, raw_header(), CsvWriter::Keep::flushed_rows) {}
  void write_new(const Findings& findings) {
    for (; written_ < findings.rows().size(); ++written_) {
      write(file_, findings.rows()[written_], campaign_);
    }
    file_.flush();
  }
  void close() { file_.close(); }

 private:
  std::string campaign_;
  CsvWriter file_;
  std::size_t written_ = 0;
};

void run_block(const RunContext& context, std::mt19937_64& shuffle, Progress& progress,
               RowWriter& rows) {
  const Block& block = *context.block;
  Executor executor(block.threads);
  BroadRunner broad(context, executor);
  NarrowRunner narrow(context, executor);
  ScenePlayer player(*context.scene, block.boxes);
  std::span<const Aabb> before;
  do {
    const std::vector<IndexPair> truth = broad.truth(player.boxes());
    broad.run_frame(player, truth, before, shuffle);
    if (!block.group->narrow.empty() && context.scene->recording.empty()) {
      narrow.compare(player.frame(), player.poses(), truth);
      if (block.group->pairing == Pairing::separate) {
        narrow.time(player.frame(), player.poses(), truth, "", shuffle);
      } else {
        for (const BroadRunner::Found& found : broad.found()) {
          narrow.time(player.frame(), player.poses(), found.pairs, found.entry->info.name, shuffle);
        }
      }
    }
    rows.write_new(*context.findings);
    progress.part((player.frame() + 1.0) / context.scene->frames);
    before = player.boxes();
  } while (interrupt == 0 && player.next());
}

}  // namespace

RunResult run_campaign(const Campaign& campaign, const std::filesystem::path& folder) {
  const std::vector<Block> blocks = blocks_of(campaign);
  if (blocks.empty()) throw InputError("the campaign has no scene");

  // Each distinct scene once, all before the first row is written.
  using SceneKey = std::tuple<std::filesystem::path, std::int64_t, std::int64_t, int>;
  const auto key = [](const Block& block) {
    return SceneKey{block.scene_file, block.overrides.count, block.overrides.seed,
                    block.overrides.frames};
  };
  struct Loaded {
    Scene scene;
    std::string hash;
  };
  std::map<SceneKey, Loaded> scenes;
  for (const Block& block : blocks) {
    if (scenes.contains(key(block))) continue;
    Scene scene = load_scene(block.scene_file, block.overrides);
    std::string hash = scene_hash(scene);
    scenes.emplace(key(block), Loaded{std::move(scene), std::move(hash)});
  }

  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), 0, "cannot be made: " + error.message());
  const std::filesystem::path reproductions = folder / "reproductions";
  std::filesystem::remove_all(reproductions, error);

  RunResult result;
  RowWriter rows(campaign, folder / "raw.csv");
  std::mt19937_64 shuffle(campaign.seed);
  std::map<std::string, std::string> hashes;
  {
    const InterruptGuard guard;
    Progress progress(blocks.size());
    for (const Block& block : blocks) {
      if (interrupt != 0) break;
      const Loaded& loaded = scenes.at(key(block));
      hashes[fmt::format("{}, {} bodies", loaded.scene.name, loaded.scene.size())] = loaded.hash;
      progress.start(label(block, loaded.scene));
      run_block({&block, &loaded.scene, loaded.hash, reproductions, &result.findings}, shuffle,
                progress, rows);
    }
    result.interrupted = interrupt != 0;
  }
  rows.close();
  write_machine(campaign, hashes, folder / "machine.csv");
  return result;
}

}  // namespace touchstone
