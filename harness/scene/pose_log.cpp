// Reads and writes logs of poses.
#include "harness/scene/pose_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/reproducible_math.h"
#include "harness/files/csv.h"
#include "harness/scene/kinematics.h"

namespace touchstone::scene {
namespace {

constexpr std::size_t log_frame = 0, log_body = 1, log_first = 2, quaternion_numbers = 7,
                      matrix_numbers = 12;

const std::vector<std::string>& log_columns() {
  static const std::vector<std::string> columns = {
      "frame", "body", "x",   "y",   "z",   "qw",  "qx",  "qy",  "qz",  "m00", "m01",
      "m02",   "m03",  "m10", "m11", "m12", "m13", "m20", "m21", "m22", "m23"};
  return columns;
}

class PoseLogReader {
 public:
  PoseLogReader(const std::filesystem::path& file, Scene& scene) : file_(file), scene_(scene) {
    for (std::uint32_t i = 0; i < scene.names.size(); ++i) {
      if (scene.names[i].empty()) continue;
      const auto [at, is_new] = named_.try_emplace(scene.names[i], i);
      if (!is_new) at->second = std::nullopt;
    }
  }

  void read() {
    const std::vector<std::string>& columns = log_columns();
    const files::CsvReader reader(file_, {columns[log_frame], columns[log_body]}, columns,
                                  files::CsvReader::Others::refused);
    reader.read([&](const files::CsvReader::Row& row) { read_row(row); });
    if (frames_ == 0) {
      throw base::InputError(file_.string(), 1, "no row behind the header; expected at least one");
    }
    fill();
  }

 private:
  struct Seen {
    std::int64_t frame;
    Pose pose;
  };

  void read_row(const files::CsvReader::Row& row) {
    const std::int64_t frame = row.integer(log_frame);
    if (frame != frames_ - 1 && frame != frames_) {
      row.fail(frames_ == 0 ? fmt::format("frame {}; expected 0 first", frame)
                            : fmt::format("frame {} after frame {}; expected that or the next one",
                                          frame, frames_ - 1));
    }
    frames_ = frame + 1;
    std::vector<Seen>& all = seen_[body_of(row)];
    if (!all.empty() && all.back().frame == frame) {
      row.fail("a second row for this body and frame; expected one");
    }
    all.push_back({frame, pose_of(row)});
  }

  std::uint32_t body_of(const files::CsvReader::Row& row) const {
    const std::string_view text = row.text(log_body);
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size() && number < scene_.bodies.size()) {
      return number;
    }
    const auto named = named_.find(text);
    if (named == named_.end()) {
      row.fail(fmt::format("body \"{}\"; expected a name, or a number below {}",
                           base::shortened(text), scene_.bodies.size()));
    }
    if (!named->second) row.fail("several bodies have this name; expected the number of one");
    return *named->second;
  }

  static Pose pose_of(const files::CsvReader::Row& row) {
    const bool is_matrix = !row.is_absent(log_first + quaternion_numbers);
    const std::size_t first = log_first + (is_matrix ? quaternion_numbers : 0);
    std::array<double, matrix_numbers> numbers{};
    for (std::size_t i = 0; i < (is_matrix ? matrix_numbers : quaternion_numbers); ++i) {
      if (row.is_absent(first + i)) {
        row.fail(fmt::format("no column '{}'; expected x,y,z,qw,qx,qy,qz or m00 to m23",
                             row.name(first + i)));
      }
      numbers[i] = row.number(first + i);
      if (!std::isfinite(numbers[i])) {
        row.fail(
            fmt::format("{}: found {}; expected a finite number", row.name(first + i), numbers[i]));
      }
    }
    Pose pose;
    if (!is_matrix) {
      pose.translation = {numbers[0], numbers[1], numbers[2]};
      const std::optional<Mat3d> rotation =
          base::rotation_of_any({numbers[3], numbers[4], numbers[5], numbers[6]});
      if (!rotation) row.fail("the quaternion is 0; expected one that is not");
      pose.rotation = *rotation;
      return pose;
    }
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k)
        pose.rotation(i, k) = numbers[static_cast<std::size_t>(4 * i + k)];
      pose.translation[i] = numbers[static_cast<std::size_t>(4 * i + 3)];
    }
    if (!base::is_rotation(pose.rotation)) {
      row.fail("the matrix is no rotation; expected orthonormal columns, right-handed");
    }
    return pose;
  }

  void fill() {
    Tracks& tracks = scene_.tracks;
    if (!tracks.bodies.empty()) {
      throw base::InputError(file_.string(), 0, "poses beside a robot's; expected one of the two");
    }
    for (const auto& [body, unused] : seen_) {
      tracks.bodies.push_back(body);
      scene_.bodies[body].moving = true;
    }
    const std::size_t width = tracks.bodies.size();
    tracks.poses.resize(width * static_cast<std::size_t>(frames_));
    std::size_t column = 0;
    for (const auto& [body, all] : seen_) {
      Pose pose = scene_.bodies[body].pose;
      auto next = all.begin();
      for (std::int64_t frame = 0; frame < frames_; ++frame) {
        if (next != all.end() && next->frame == frame) pose = (next++)->pose;
        tracks.poses[static_cast<std::size_t>(frame) * width + column] = pose;
      }
      scene_.bodies[body].pose = tracks.poses[column];
      ++column;
    }
    scene_.frames = static_cast<int>(frames_);
  }

  std::filesystem::path file_;
  Scene& scene_;
  std::map<std::string, std::optional<std::uint32_t>, std::less<>> named_;
  std::map<std::uint32_t, std::vector<Seen>> seen_;
  std::int64_t frames_ = 0;
};

}  // namespace

void read_pose_log(const std::filesystem::path& file, Scene& scene) {
  PoseLogReader(file, scene).read();
}

PoseMatrixWriter::PoseMatrixWriter(const std::filesystem::path& file)
    : csv_(file, [] {
        const std::vector<std::string>& all = log_columns();
        std::vector<std::string> columns = {all[log_frame], all[log_body]};
        columns.insert(columns.end(), all.begin() + log_first + quaternion_numbers, all.end());
        return columns;
      }()) {}

void PoseMatrixWriter::add(std::size_t frame, std::size_t body, const Pose& pose) {
  csv_.field(frame).field(body);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) csv_.field(pose.rotation(i, k));
    csv_.field(pose.translation[i]);
  }
  csv_.end_row();
}

int write_pose_log(const Scene& scene, const std::filesystem::path& file) {
  PoseMatrixWriter log(file);
  Kinematics kinematics(scene);
  for (int frame = 0; frame < scene.frames; ++frame) {
    if (frame > 0) kinematics.next();
    for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
      if (!kinematics.is_present(body) || !scene.bodies[body].moving) continue;
      log.add(static_cast<std::size_t>(frame), body, kinematics.poses()[body]);
    }
  }
  log.close();
  return scene.frames;
}

PoseLogWriter::PoseLogWriter(const std::filesystem::path& file)
    : csv_(file, {log_columns().begin(),
                  log_columns().begin() + std::ptrdiff_t{log_first + quaternion_numbers}}) {}

void PoseLogWriter::add(int frame, std::span<const LoggedPose> poses) {
  for (const LoggedPose& pose : poses) {
    csv_.field(frame).field(std::size_t{pose.body});
    for (const float x : pose.translation) csv_.field(fmt::format("{}", x));
    for (const float x : pose.quaternion_wxyz) csv_.field(fmt::format("{}", x));
    csv_.end_row();
  }
}

}  // namespace touchstone::scene
