// Runs Qhull's reentrant library and chains the edges of its facets.
#include "algorithms/hull/qhull_loops.h"

#include <fmt/core.h>
#include <libqhull_r/qhull_ra.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace touchstone {
namespace {

template <class T, class Visit>
void for_each(const setT* set, Visit visit) {
  if (set == nullptr) return;
  for (const setelemT* e = set->e; e->p != nullptr; ++e) visit(static_cast<const T*>(e->p));
}

// One run of Qhull's reentrant library. Its errors jump back into qh_new_qhull and become a status.
// The functions that are called afterwards cannot fail.
class QhullRun {
 public:
  QhullRun(std::vector<Vec3d>& points, double merge_distance) {
    std::FILE* messages = open_memstream(&text_, &text_size_);  // Qhull requires a file
    if (messages == nullptr) return;
    std::string options = "qhull Pp";
    if (merge_distance > 0) options += fmt::format(" C-{}", merge_distance);
    qh_zero(&qh_, messages);
    status_ = qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), points.front().data(), False,
                           options.data(), nullptr, messages);
    std::fflush(messages);
    messages_ = messages;
  }
  ~QhullRun() {
    if (messages_ != nullptr) {
      qh_.NOerrexit = True;
      qh_freeqhull(&qh_, !qh_ALL);
      int current = 0, total = 0;
      qh_memfreeshort(&qh_, &current, &total);
      std::fclose(messages_);
    }
    std::free(text_);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  bool ok() const { return messages_ != nullptr && status_ == 0; }

  // Chains the directed edges of each facet, independent of Qhull's orientation. Returns an empty
  // list if the edges of a facet do not form one loop.
  std::vector<Loop> loops() const {
    std::vector<Loop> result;
    for (const facetT* f = qh_.facet_list; f != nullptr && f->next != nullptr; f = f->next) {
      std::optional<Loop> loop = f->simplicial ? corners(f) : boundary(f);
      if (!loop) return {};
      result.push_back(std::move(*loop));
    }
    return result;
  }

 private:
  std::uint32_t index(const vertexT* v) const {
    return static_cast<std::uint32_t>((v->point - qh_.first_point) / 3);
  }
  Loop corners(const facetT* f) const {
    Loop loop;
    for_each<vertexT>(f->vertices, [&](const vertexT* v) { loop.push_back(index(v)); });
    return loop;
  }
  std::optional<Loop> boundary(const facetT* f) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> next;
    for_each<ridgeT>(f->ridges, [&](const ridgeT* r) {
      std::vector<std::uint32_t> ends;
      for_each<vertexT>(r->vertices, [&](const vertexT* v) { ends.push_back(index(v)); });
      next[ends.front()].push_back(ends.back());
      next[ends.back()].push_back(ends.front());
    });
    if (next.empty()) return std::nullopt;
    Loop loop{next.begin()->first};
    std::uint32_t before = loop.front();
    for (std::uint32_t at = next.begin()->second.front(); at != loop.front();) {
      const std::vector<std::uint32_t>& sides = next[at];
      if (sides.size() != 2 || loop.size() > next.size()) return std::nullopt;
      loop.push_back(at);
      before = std::exchange(at, sides[sides[0] == before ? 1 : 0]);
    }
    if (loop.size() != next.size()) return std::nullopt;
    return loop;
  }

  qhT qh_;
  char* text_ = nullptr;
  std::size_t text_size_ = 0;
  std::FILE* messages_ = nullptr;
  int status_ = -1;
};

}  // namespace

std::vector<Loop> qhull_loops(std::vector<Vec3d>& points, double merge_distance) {
  const QhullRun run(points, merge_distance);
  return run.ok() ? run.loops() : std::vector<Loop>{};
}

}  // namespace touchstone
