// libFuzzer: any bytes as a transfer function. They are read or rejected by an Error; what is read has rows of finite numbers,
// frequencies ascending.
#include <cstdlib>

#include "base/error.h"
#include "file_of.h"
#include "io/transfer_function.h"

using namespace whine;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileOf file(data, size);
  rejected_or_read([&] {
    const TransferFunction rows = read_transfer_function(file.path());
    const auto n = rows.frequency.size();
    if (n < 2 || rows.magnitude.size() != n || rows.phase.size() != n) std::abort();
    if (!rows.frequency.allFinite() || !rows.phase.allFinite() || !rows.magnitude.allFinite()) std::abort();
    if (!((rows.frequency.tail(n - 1) - rows.frequency.head(n - 1)).minCoeff() > 0)) std::abort();
  });
  return 0;
}
