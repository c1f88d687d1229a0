// libFuzzer: any bytes as each kind of artifact. They are read or rejected by an Error.
//
// -DSEALED: the content hash is put right first, so that the bytes reach HDF5 and the readers behind it; no accident makes
// such a file.
#include "io/artifact.h"
#include "base/error.h"
#include "file_of.h"
#include "io/body_codec.h"
#include "io/branch_codec.h"
#include "io/error_budget_codec.h"
#include "io/fold_curves_codec.h"
#include "io/harris_map_codec.h"
#include "io/impact_codec.h"
#include "io/jump_map_codec.h"
#include "io/loaded_codec.h"
#include "io/mesh_codec.h"
#include "io/modes_codec.h"
#include "io/provenance.h"
#include "io/response_codec.h"
#include "io/runup_codec.h"
#include "io/static_codec.h"
#include "io/study.h"
#include "io/study_codec.h"
#include "io/summary.h"
#include "io/sweep_codec.h"
#include "io/system_branch_codec.h"
#include "io/system_impact_codec.h"
#include "io/system_static_codec.h"
#include "io/system_sweep_codec.h"
#include "io/variant_codec.h"

using namespace whine;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
#ifdef SEALED
  std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    bytes = sealed(std::move(bytes));
  } catch (const Error&) {
    return -1;  // nothing to put right: of no use in a corpus
  }
  const FileOf file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
#else
  const FileOf file(data, size);
#endif
  const std::string path = file.path();
  rejected_or_read([&] { require_fresh(path); });
  rejected_or_read([&] { summary(path, read_origin(path).schema); });
  rejected_or_read([&] { read_mesh(path); });
  rejected_or_read([&] { read_body(path); });
  rejected_or_read([&] { read_static(path); });
  rejected_or_read([&] { read_error_budget(path); });
  rejected_or_read([&] { read_loaded(path); });
  rejected_or_read([&] { read_impact(path); });
  rejected_or_read([&] { read_sweep(path); });
  rejected_or_read([&] { read_response(path); });
  rejected_or_read([&] { read_runup(path); });
  rejected_or_read([&] { read_branch(path); });
  rejected_or_read([&] { read_fold_curves(path); });
  rejected_or_read([&] { read_modes(path); });
  rejected_or_read([&] { read_system_static(path); });
  rejected_or_read([&] { read_system_sweep(path); });
  rejected_or_read([&] { read_system_impact(path); });
  rejected_or_read([&] { read_system_branch(path); });
  rejected_or_read([&] { read_jump_map(path); });
  rejected_or_read([&] { read_harris_map(path); });
  rejected_or_read([&] { read_variant(path); });
  rejected_or_read([&] { read_study_artifact(path); });
  return 0;
}
