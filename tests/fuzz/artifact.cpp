// libFuzzer: any bytes as each kind of artifact. They are read or rejected by an Error.
//
// -DSEALED: the content hash is put right first, so that the bytes reach HDF5 and the readers behind it; no accident makes
// such a file.
#include "io/artifact.h"
#include "base/error.h"
#include "file_of.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/provenance.h"
#include "io/study.h"
#include "io/summary.h"

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
  for_each_kind([&]<class A>(const ArtifactKind<A>&) { rejected_or_read([&] { read<A>(path); }); });
  return 0;
}
