// Runs the request of a file and says what came out.
#include "harness/check/requests/case_run.h"

#include <memory>

#include "harness/base/table.h"
#include "harness/check/axes/stress_run.h"
#include "harness/check/check_run.h"
#include "harness/check/soak/soak_text.h"

namespace touchstone::check {
namespace {

CaseEnd end_of(const CheckRequest& request) {
  const std::unique_ptr<CheckResult> result = run_check(request);
  if (request.part || result->interrupted) return {.text = {}, .interrupted = result->interrupted};
  return {summary_text(result->report, base::page_width()), !result->report.ours_wrong().empty()};
}

CaseEnd end_of(const StressRequest& request) {
  const StressResult result = run_stress(request);
  if (request.part || result.interrupted) return {.text = {}, .interrupted = result.interrupted};
  return {stress_text(request, result, base::page_width()), !result.broken.empty()};
}

CaseEnd end_of(const SoakRequest& request) {
  const SoakResult result = run_soak(request);
  if (request.part || result.interrupted) return {.text = {}, .interrupted = result.interrupted};
  return {soak_text(request, result, base::page_width()), result.ours_are_wrong(request)};
}

}  // namespace

CaseEnd run_case_file(CaseFile& file) {
  return std::visit([](const auto& request) { return end_of(request); }, file.request);
}

}  // namespace touchstone::check
