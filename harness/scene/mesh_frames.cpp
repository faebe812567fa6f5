// Reads PLY files step by step, and the lists of known pairs beside them.
#include "harness/scene/mesh_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/geometry/mesh.h"

namespace touchstone::scene {
namespace {

namespace fs = std::filesystem;

// Ends of an edge: the greater vertex, and the lesser one.
using Edge = std::array<std::uint32_t, 2>;

struct FrameFile {
  std::int64_t number = 0;
  fs::path path;
};

// The number at the end of the name; none if there is none.
std::optional<std::int64_t> number_of(const fs::path& file) {
  constexpr std::size_t most_digits = 18;
  const std::string stem = file.stem().string();
  const std::string digits = stem.substr(stem.find_last_not_of("0123456789") + 1);
  if (digits.empty() || digits.size() > most_digits) return std::nullopt;
  return std::stoll(digits);
}

// The frames of a folder, by their numbers.
std::vector<FrameFile> frames_in(const fs::path& folder) {
  std::vector<FrameFile> frames;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".ply") continue;
    if (const auto number = number_of(entry.path())) frames.push_back({*number, entry.path()});
  }
  std::ranges::sort(frames, {},
                    [](const FrameFile& frame) { return std::pair(frame.number, frame.path); });
  const auto twice = std::ranges::adjacent_find(frames, {}, &FrameFile::number);
  if (twice != frames.end()) {
    throw base::InputError(twice->path.string(), 0,
                           fmt::format("has the number of {}; expected one file a frame",
                                       std::next(twice)->path.filename().string()));
  }
  return frames;
}

std::vector<Edge> edges_of(const geometry::Mesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [less, greater] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      if (less != greater) edges.push_back({greater, less});
    }
  }
  std::ranges::sort(edges);
  const auto rest = std::ranges::unique(edges);
  edges.erase(rest.begin(), rest.end());
  return edges;
}

// Returns how many coordinates no float holds. Throws InputError beyond the range of float.
std::size_t grow(Aabb& box, const Vec3d& point, const fs::path& file) {
  std::size_t rounded = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = point[static_cast<Eigen::Index>(i)];
    if (!(std::abs(value) <= double{std::numeric_limits<float>::max()})) {
      throw base::InputError(
          file.string(), 0,
          fmt::format("found the coordinate {}; expected one in the range of float", value));
    }
    box.min[i] = std::min(box.min[i], round_down(value));
    box.max[i] = std::max(box.max[i], round_up(value));
    rounded += double{static_cast<float>(value)} == value ? 0 : 1;
  }
  return rounded;
}

Aabb joined(const Aabb& a, const Aabb& b) {
  Aabb both;
  for (std::size_t i = 0; i < 3; ++i) {
    both.min[i] = std::min(a.min[i], b.min[i]);
    both.max[i] = std::max(a.max[i], b.max[i]);
  }
  return both;
}

// Reads a list of pairs of ids, if it is there, and appends them.
void read_known(const fs::path& file, const std::vector<Aabb>& boxes,
                std::vector<IndexPair>& known) {
  if (!fs::exists(file)) return;
  const auto fail = [&](const std::string& what) {
    throw base::InputError(file.string(), 0, what);
  };
  const std::string text = base::read_whole(file, base::longest_text, "known pairs of boxes");
  const auto list = nlohmann::json::parse(text, nullptr, false);
  if (!list.is_array()) fail("no array; expected pairs of ids, such as [[0, 12], [3, 40]]");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& pair = list[i];
    const bool is_pair = pair.is_array() && pair.size() == 2 && pair[0].is_number_unsigned() &&
                         pair[1].is_number_unsigned();
    if (!is_pair) fail(fmt::format("entry {}: expected a pair of ids", i));
    const auto first = pair[0].get<std::uint64_t>(), second = pair[1].get<std::uint64_t>();
    const auto [a, b] = std::minmax(first, second);
    if (a == b || b >= boxes.size()) {
      fail(fmt::format(
          "entry {}: found {} and {}; expected two of the {} ids of vertices, edges and faces", i,
          a, b, boxes.size()));
    }
    if (!overlap(boxes[a], boxes[b])) {
      fail(fmt::format(
          "entry {}: the boxes {} and {} are apart; expected two that meet. Ids are the "
          "vertices, the edges by their greater vertex, the faces",
          i, a, b));
    }
    known.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
  }
}

}  // namespace

bool are_mesh_frames(const fs::path& file) {
  if (!fs::is_directory(file)) return file.extension() == ".ply";
  return std::ranges::any_of(fs::directory_iterator(file), [](const fs::directory_entry& entry) {
    return entry.path().extension() == ".ply";
  });
}

std::vector<BoxFrame> read_mesh_frames(const fs::path& file) {
  const bool is_folder = fs::is_directory(file);
  const fs::path folder = is_folder ? file : fs::absolute(file).parent_path();
  if (!is_folder) base::check_kind(file, "a frame of a mesh");
  std::vector<FrameFile> files = frames_in(folder);
  if (!is_folder) {
    const auto first = std::ranges::find(
        files, file.filename(), [](const FrameFile& frame) { return frame.path.filename(); });
    files.erase(files.begin(), first);
    files.resize(std::min<std::size_t>(files.size(), 2));
  }
  if (files.size() < 2) {
    throw base::InputError(
        file.string(), 0,
        is_folder ? "fewer than two frames; expected PLY files such as 0.ply, 1.ply"
                  : "no next frame in its folder; expected PLY files such as 0.ply, 1.ply");
  }

  const auto read = [](const FrameFile& frame) { return geometry::read_surface(frame.path); };
  std::vector<BoxFrame> frames;
  geometry::Mesh before = read(files.front());
  const std::vector<Edge> edges = edges_of(before);
  std::uint64_t rows = 0;
  for (std::size_t i = 1; i < files.size(); ++i) {
    geometry::Mesh after = read(files[i]);
    if (after.triangles != before.triangles || after.vertices.size() != before.vertices.size()) {
      throw base::InputError(
          files[i].path.string(), 0,
          fmt::format("other vertices or faces than {}; expected the same mesh, moved",
                      files[i - 1].path.filename().string()));
    }
    BoxFrame& frame = frames.emplace_back();
    frame.number = files[i - 1].number;
    std::vector<Aabb>& boxes = frame.boxes;
    boxes.reserve(before.vertices.size() + edges.size() + before.triangles.size());
    for (std::size_t v = 0; v < before.vertices.size(); ++v) {
      Aabb& box = boxes.emplace_back(Aabb::empty());
      // What is between two steps is counted once.
      const std::size_t rounded = grow(box, before.vertices[v], files[i - 1].path);
      frame.rounded += grow(box, after.vertices[v], files[i].path) + (i == 1 ? rounded : 0);
    }
    for (const Edge& edge : edges) boxes.push_back(joined(boxes[edge[0]], boxes[edge[1]]));
    for (const auto& face : before.triangles) {
      boxes.push_back(joined(joined(boxes[face[0]], boxes[face[1]]), boxes[face[2]]));
    }
    rows += boxes.size();
    if (std::cmp_greater(rows, base::most_rows)) {
      throw base::InputError(
          files[i].path.string(), 0,
          fmt::format("more than {} boxes in all frames up to here; name a file for one step",
                      base::most_rows));
    }
    const fs::path lists = fs::absolute(folder).lexically_normal().parent_path() / "boxes";
    for (const char* kind : {"vf", "ee"}) {
      read_known(lists / fmt::format("{}{}.json", files[i - 1].path.stem().string(), kind), boxes,
                 frame.known_pairs);
    }
    std::ranges::sort(frame.known_pairs);
    const auto again = std::ranges::unique(frame.known_pairs);
    frame.known_pairs.erase(again.begin(), again.end());
    before = std::move(after);
  }
  return frames;
}

}  // namespace touchstone::scene
