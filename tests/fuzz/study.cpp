// libFuzzer: any bytes as a study, as the plan that a study becomes and as the stage parameters of a variant. They are read or
// rejected by an Error; a study that is read draws values for each of its keys, and its plan is read and says the same again.
#include <algorithm>
#include <cstdlib>

#include "base/error.h"
#include "file_of.h"
#include "io/study.h"

namespace {

using namespace whine;

std::string again(const std::string& text) {
  const FileOf file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  const auto [study, variants] = read_plan(file.path());
  return plan_text(study, variants);
}

void require_plan(const Study& study) {
  std::vector<GatheredVariant> variants;
  // Some at both ends: a study may have 200 000.
  for (long i = 0; i < study.variants; i = i < 8 ? i + 1 : std::max(i + 1, study.variants - 4)) {
    variants.push_back({"0123456789abcdef", variant_values(study, i)});
    if (variants.back().values.size() != study.keys.size()) std::abort();
  }
  const std::string text = plan_text(study, variants);
  if (again(text) != text) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileOf file(data, size);
  const std::string path = file.path();
  Study study;
  bool valid = false;
  rejected_or_read([&] {
    study = read_study(path);
    valid = true;
  });
  if (valid) require_plan(study);
  rejected_or_read([&] { read_plan(path); });
  rejected_or_read([&] { read_variant_parameters(path); });
  return 0;
}
