// Reads and writes rays, and says what they are asked.
#include "harness/kinds/ray/ray_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "harness/base/file_text.h"
#include "harness/files/csv.h"
#include "harness/files/text_file.h"

namespace touchstone::kinds {

void write_ray(const std::filesystem::path& file, const Ray& ray) {
  const Vec3d &o = ray.origin, &d = ray.direction;
  files::write_text(file,
                    fmt::format("origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,"
                                "t_max\n{},{},{},{},{},{},{}\n",
                                o.x(), o.y(), o.z(), d.x(), d.y(), d.z(), ray.t_max));
}

std::vector<Ray> read_rays(const std::filesystem::path& file) {
  std::vector<Ray> rays;
  const files::CsvReader reader(file, {"origin_x", "origin_y", "origin_z", "direction_x",
                                       "direction_y", "direction_z", "t_max"});
  reader.read([&](const files::CsvReader::Row& row) {
    const auto finite = [&](std::size_t column) {
      const double value = row.number(column);
      if (!std::isfinite(value)) {
        row.fail(fmt::format("column {}: found {}; expected a finite number", row.name(column),
                             base::shortened(row.text(column))));
      }
      return value;
    };
    Ray ray{{finite(0), finite(1), finite(2)}, {finite(3), finite(4), finite(5)}, row.number(6)};
    if (ray.direction.isZero(0)) row.fail("the direction is zero; expected one that is not");
    if (!(ray.t_max >= 0)) {
      row.fail(fmt::format("column t_max: found {}; expected 0 or more, or inf",
                           base::shortened(row.text(6))));
    }
    rays.push_back(std::move(ray));
  });
  return rays;
}

std::string label_of_ray(std::size_t ray) { return fmt::format("ray {}", ray); }

RayTask asked_ray_task(const QuestionInput& input) {
  const std::array names = {to_string(RayTask::closest), to_string(RayTask::any)};
  return static_cast<RayTask>(asked_task(input, names));
}

}  // namespace touchstone::kinds
