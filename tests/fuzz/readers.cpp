// The list of readers.
#include "tests/fuzz/readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>

#include "algorithms/oracle/certificates/cast_certificate_check.h"
#include "algorithms/oracle/certificates/certificate_check.h"
#include "algorithms/oracle/certificates/parts/mesh_certificate_check.h"
#include "algorithms/oracle/certificates/parts/parts_certificate_check.h"
#include "algorithms/oracle/certificates/parts/scene_ray_check.h"
#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/campaign/campaign.h"
#include "harness/cells/read_cells.h"
#include "harness/files/callgrind.h"
#include "harness/files/cases.h"
#include "harness/files/ccd_queries.h"
#include "harness/files/certificates.h"
#include "harness/files/concave_cases.h"
#include "harness/files/height_grid.h"
#include "harness/files/packed_files.h"
#include "harness/files/parts_certificates.h"
#include "harness/files/ray_certificates.h"
#include "harness/geometry/mesh.h"
#include "harness/models/model.h"
#include "harness/peer/link.h"
#include "harness/record/machine.h"
#include "harness/scene/box_frames.h"
#include "harness/scene/scene.h"
#include "harness/stats/samples.h"

namespace touchstone::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view crane = R"(<robot name="crane">
  <link name="foot"><collision><geometry><box size="1 1 0.2"/></geometry></collision></link>
  <link name="boom"><collision><geometry><cylinder radius="0.1" length="1"/></geometry></collision></link>
  <link name="hook"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="boom"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="2"/></joint>
  <joint name="rise" type="prismatic"><parent link="boom"/><child link="hook"/><origin xyz="0 0 1"/>
    <limit lower="0" upper="0.5"/></joint>
</robot>
)";
constexpr std::string_view tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

// Some files are read for a scene alone. The scene beside them names them.
void read_scene_beside(const fs::path& file) {
  scene::load_scene(file.parent_path() / "scene.toml");
}

void check_pairs(const fs::path& file) {
  files::read_certificates(file, [](const files::StoredCertificate& one, std::int64_t) {
    const oracle::Solid a(one.shape_a), b(one.shape_b);
    const auto body = [](const oracle::Solid& solid, const Pose& pose, const auto& quaternion) {
      return quaternion ? oracle::Body(solid, *quaternion, pose.translation)
                        : oracle::Body(solid, pose);
    };
    oracle::fault(one.certificate, body(a, one.pose_a, one.quaternion_a),
                  body(b, one.pose_b, one.quaternion_b));
  });
}

void check_casts(const fs::path& file) {
  files::read_cast_certificates(file, [](const files::StoredCastCertificate& one, std::int64_t) {
    const oracle::Solid a(one.of.shape_a), b(one.of.shape_b);
    oracle::fault(one.certificate, {{a, one.of.pose_a}, one.of.motion_a},
                  {{b, one.of.pose_b}, one.of.motion_b});
  });
}

void check_parts(const fs::path& file) {
  files::read_parts_certificates(file, [](const files::StoredPartsCertificate& one, std::int64_t) {
    oracle::fault(one.certificate, {one.of.a, one.of.pose_a}, {one.of.b, one.of.pose_b});
  });
}

void check_rays(const fs::path& file) {
  std::optional<TriangleMesh> mesh;
  std::vector<files::PlacedConcave> bodies;
  files::read_ray_certificates(
      file, {.mesh = [&](const TriangleMesh& read) { mesh = read; },
             .at_mesh = [&](const files::StoredRayCertificate& one,
                            std::int64_t) { oracle::CheckedMesh(*mesh).fault(one.certificate); },
             .scene = [&](std::vector<files::PlacedConcave> read) { bodies = std::move(read); },
             .at_scene =
                 [&](const files::StoredSceneRayCertificate& one, std::int64_t) {
                   std::vector<oracle::PlacedBody> placed;
                   for (const auto& [body, pose] : bodies) placed.push_back({body, pose});
                   oracle::CheckedScene(placed).fault(one.certificate);
                 }});
}

void check_points(const fs::path& file) {
  std::optional<TriangleMesh> mesh;
  files::read_point_certificates(
      file, [&](const TriangleMesh& read) { mesh = read; },
      [&](const files::StoredPointCertificate& one, std::int64_t) {
        oracle::CheckedMesh(*mesh).fault(one.certificate);
      });
}

// What the process that reads models writes.
void read_model_stream(const fs::path& file) {
  const std::string text = base::read_whole(file, base::largest_file);
  const models::Model model = models::parse_model(file.string(), text);
  models::whole_mesh(file.string(), model);
}

void read_answers(const fs::path& file) {
  files::for_each_json_line(file, "answer", [](const files::JsonNode& answer) {
    peer::known_outcome(answer);
    peer::known_count(answer, "triangle");
    for (const char* key : {"toi", "t", "u", "v"}) peer::known_number(answer, key);
    for (const char* key : {"closest", "point"}) peer::known_vector(answer, key);
  });
}

void read_lines(const fs::path& file) {
  files::LineReader lines(file);
  while (lines.next()) {
  }
}

const std::vector<Reader>& list() {
  constexpr std::string_view of_robot =
      "import = \"crane.urdf\"\nmoving = false\nconfigurations = ";
  constexpr std::string_view with_obstacles =
      "import = \"crane.urdf\"\nmoving = false\nobstacles = \"world.yaml\"\nconfigurations = "
      "{random = 2}\n";
  constexpr std::string_view two_balls =
      "poses = \"log.csv\"\n[[body]]\nname = \"one\"\nshape = {type = \"sphere\", radius = 1}\n"
      "[[body]]\nname = \"two\"\nshape = {type = \"sphere\", radius = 1}\n";
  constexpr std::string_view generated = "generator = \"uniform\"\ncount = 4\n";
  static const std::string with_random = std::string(of_robot) + "{random = 2}\n";
  static const std::string with_path = std::string(of_robot) + "\"path.csv\"\n";
  static const std::string with_request =
      std::string(of_robot) + "{file = \"request.yaml\", steps = 2}\n";
  static const std::vector<Reader> all = {
      {"scene",
       "scene.toml",
       [](const fs::path& file) { scene::load_scene(file); },
       {{"part.obj", tetrahedron}}},
      {"rigid-ipc",
       "scene.json",
       [](const fs::path& file) { scene::load_scene(file); },
       {{"part.obj", tetrahedron}}},
      {"urdf",
       "crane.urdf",
       read_scene_beside,
       {{"scene.toml", with_random}, {"part.obj", tetrahedron}}},
      {"srdf",
       "crane.srdf",
       read_scene_beside,
       {{"scene.toml", with_random}, {"crane.urdf", crane}}},
      {"configurations",
       "path.csv",
       read_scene_beside,
       {{"scene.toml", with_path}, {"crane.urdf", crane}}},
      {"request",
       "request.yaml",
       read_scene_beside,
       {{"scene.toml", with_request}, {"crane.urdf", crane}}},
      {"planning-scene",
       "world.yaml",
       read_scene_beside,
       {{"scene.toml", with_obstacles}, {"crane.urdf", crane}}},
      {"poses", "log.csv", read_scene_beside, {{"scene.toml", two_balls}}},
      {"obj", "mesh.obj", [](const fs::path& file) { geometry::read_mesh(file); }},
      {"stl", "mesh.stl", [](const fs::path& file) { geometry::read_mesh(file); }},
      {"ply", "mesh.ply", [](const fs::path& file) { geometry::read_mesh(file); }},
      {"off", "mesh.off", [](const fs::path& file) { geometry::read_mesh(file); }},
      {"model-streams", "model.bin", read_model_stream},
      {"heights", "heights.png", [](const fs::path& file) { files::read_heights(file); }},
      {"aabbs", "boxes.aabbs", [](const fs::path& file) { scene::read_aabbs(file); }},
      {"boxes", "boxes.csv", [](const fs::path& file) { scene::read_box_frames(file); }},
      {"cases", "cases.jsonl", [](const fs::path& file) { files::read_cases(file); }},
      {"casts", "casts.jsonl", [](const fs::path& file) { files::read_cast_cases(file); }},
      {"concave-cases", "cases.jsonl",
       [](const fs::path& file) { files::read_concave_cases(file); }},
      {"features", "features.csv", [](const fs::path& file) { files::read_ccd_queries(file); }},
      {"pair-proofs", "proofs.jsonl", check_pairs},
      {"cast-proofs", "proofs.jsonl", check_casts},
      {"parts-proofs", "proofs.jsonl", check_parts},
      {"ray-proofs", "proofs.jsonl", check_rays},
      {"point-proofs", "proofs.jsonl", check_points},
      {"callgrind", "callgrind.out", [](const fs::path& file) { files::read_callgrind(file); }},
      {"campaign",
       "campaign.toml",
       [](const fs::path& file) { campaign::description(campaign::read_campaign(file)); },
       {{"scene.toml", generated}}},
      {"sets", "sets.toml", [](const fs::path& file) { cells::read_cells(file); }},
      {"raw", "raw.csv", [](const fs::path& file) { stats::read_results(file); }},
      {"facts", "machine.csv", [](const fs::path& file) { record::read_facts(file); }},
      {"answers", "answers.jsonl", read_answers},
      {"zstd", "rows.csv.zst", read_lines},
  };
  return all;
}

}  // namespace

std::span<const Reader> readers() { return list(); }

const Reader& reader_named(std::string_view name) {
  const auto at = std::ranges::find(list(), name, &Reader::name);
  if (at != list().end()) return *at;
  std::string names;
  for (const Reader& reader : list()) names += fmt::format(" {}", reader.name);
  throw std::invalid_argument(
      fmt::format("no reader is named \"{}\"; expected one of{}", name, names));
}

Trial::Trial(const Reader& reader, fs::path folder) : reader_(reader), folder_(std::move(folder)) {
  for (const auto& [file, text] : reader.beside) {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
}

std::string Trial::fault(std::string_view bytes) const {
  const fs::path file = folder_ / reader_.file;
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw std::logic_error(file.string() + " cannot be written");
  try {
    reader_.read(file);
  } catch (const base::InputError& error) {
    const std::string said = error.what();
    if (said.find(folder_.string()) == std::string::npos) {
      throw std::logic_error("names no file: " + said);
    }
    return said;
  }
  return "";
}

}  // namespace touchstone::fuzz
