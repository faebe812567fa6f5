// Grades answers about configurations.
#include "harness/kinds/configuration/configuration_grade.h"

#include <algorithm>
#include <cmath>

#include "harness/kinds/grading.h"

namespace touchstone::kinds {

double configuration_reach(const ConfigurationModel& model, std::span<const Pose> links) {
  double reach = 1;
  for (const Pose& link : links) reach = std::max(reach, link.translation.norm());
  for (const ModelPart& part : model.parts) {
    if (part.link == ModelPart::world) reach = std::max(reach, part.pose.translation.norm());
  }
  return reach;
}

Graded grade_configuration(ConfigurationTask task, const ConfigurationAnswer& answer,
                           const ConfigurationAnswer& exact, bool names_pair, double reach) {
  const bool is_contact = exact.answer == Answer::overlapping;
  const auto with = [&](Grade grade) { return Graded{grade, is_contact}; };
  if (const auto by_status = grade_of_status(answer.status, answer.answer == Answer::unknown)) {
    return with(*by_status);
  }
  if (exact.answer == Answer::unknown) return with(Grade::unresolved);
  const bool contact = answer.answer != Answer::separated;
  if (const auto by_verdict = grade_of_verdict(contact, is_contact)) return with(*by_verdict);
  if (task == ConfigurationTask::motion && contact && answer.step != exact.step) {
    return with(answer.step < exact.step ? Grade::false_hit : Grade::missed);
  }
  if (!names_pair) return with(Grade::inexact);
  if (task == ConfigurationTask::distance) {
    const bool is_same = answer.distance == exact.distance;  // infinite without pairs
    const bool is_near = std::abs(answer.distance - exact.distance) <= configuration_margin * reach;
    if (!is_same && !is_near) return with(Grade::inexact);
  }
  return with(Grade::right);
}

}  // namespace touchstone::kinds
