#include "report/plot_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace whine {

PlotFile::PlotFile(const Figure& figure) : file_(memfd_create("figure", 0)) {
  if (file_ < 0) fail(Failure::io, "no file in memory for the data of a figure: ", std::strerror(errno));
  // Of the program that opens it, which has inherited the descriptor.
  path_ = "/proc/self/fd/" + std::to_string(file_);
  const std::string data = plot_data(figure);
  for (size_t done = 0; done < data.size();) {
    const ssize_t n = ::write(file_, data.data() + done, data.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int reason = errno;
      close(file_);
      fail(Failure::io, "the data of a figure do not fit into memory: ", std::strerror(reason));
    }
    done += static_cast<size_t>(n);
  }
}

PlotFile::~PlotFile() {
  close(file_);
}

}  // namespace whine
