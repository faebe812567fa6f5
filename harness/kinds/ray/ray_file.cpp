// Writes rays.
#include "harness/kinds/ray/ray_file.h"

#include <fmt/format.h>

#include "harness/files/text_file.h"

namespace touchstone::kinds {

void write_ray(const std::filesystem::path& file, const Ray& ray) {
  const Vec3d &o = ray.origin, &d = ray.direction;
  files::write_text(file,
                    fmt::format("origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,"
                                "t_max\n{},{},{},{},{},{},{}\n",
                                o.x(), o.y(), o.z(), d.x(), d.y(), d.z(), ray.t_max));
}

}  // namespace touchstone::kinds
