#include "io/wav.h"

#include <sndfile.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "base/error.h"

namespace whine {
namespace {

// A file in memory for libsndfile.
struct Memory {
  std::string bytes;
  size_t at = 0;
};
Memory& memory(void* user) {
  return *static_cast<Memory*>(user);
}
sf_count_t memory_length(void* user) {
  return static_cast<sf_count_t>(memory(user).bytes.size());
}
sf_count_t memory_seek(sf_count_t offset, int whence, void* user) {
  Memory& m = memory(user);
  const sf_count_t base = whence == SEEK_SET   ? 0
                          : whence == SEEK_CUR ? static_cast<sf_count_t>(m.at)
                                               : memory_length(user);
  m.at = static_cast<size_t>(std::max<sf_count_t>(0, base + offset));
  return static_cast<sf_count_t>(m.at);
}
sf_count_t memory_read(void* to, sf_count_t count, void* user) {
  Memory& m = memory(user);
  const size_t left = m.at < m.bytes.size() ? m.bytes.size() - m.at : 0,
               taken = std::min(left, static_cast<size_t>(count));
  std::memcpy(to, m.bytes.data() + m.at, taken);
  m.at += taken;
  return static_cast<sf_count_t>(taken);
}
sf_count_t memory_write(const void* from, sf_count_t count, void* user) {
  Memory& m = memory(user);
  m.bytes.resize(std::max(m.bytes.size(), m.at + static_cast<size_t>(count)));
  std::memcpy(m.bytes.data() + m.at, from, static_cast<size_t>(count));
  m.at += static_cast<size_t>(count);
  return count;
}
sf_count_t memory_tell(void* user) {
  return static_cast<sf_count_t>(memory(user).at);
}

}  // namespace

std::string wav_bytes(const Eigen::Ref<const Eigen::VectorXd>& signal, int rate) {
  if (!(signal.size() == 0 || signal.cwiseAbs().maxCoeff() <= 1))
    fail(Failure::input, "sound: a sample is ", signal.cwiseAbs().maxCoeff(),
         " of the full scale; it must not exceed 1");
  Memory file;
  SF_VIRTUAL_IO io{memory_length, memory_seek, memory_read, memory_write, memory_tell};
  SF_INFO info{};
  info.samplerate = rate;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_24;
  std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> out(sf_open_virtual(&io, SFM_WRITE, &info, &file), sf_close);
  if (!out) fail(Failure::numerical, "sound: ", sf_strerror(nullptr));
  const Eigen::VectorXd samples = signal;
  if (sf_write_double(out.get(), samples.data(), samples.size()) != samples.size())
    fail(Failure::numerical, "sound: ", sf_strerror(out.get()));
  out.reset();
  return std::move(file.bytes);
}

}  // namespace whine
