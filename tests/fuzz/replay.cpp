// What a fuzzer's target does with the files of a folder and with files made from them by damage: bits that flip, bytes that
// go, come or move, numbers that grow, halves of two files. For compilers without libFuzzer, and the same inputs every time.
//
//   whine-replay-<target> COUNT SEED FOLDER
//
// A target that crashes, takes more than 10 s or asks for more than 1 GiB at once ends the program; `replayed.bin` in the
// working folder is then the input.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
// A target may know of other damage.
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                                                     std::size_t room, unsigned int seed);
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t*, std::size_t size, std::size_t) {
  return size;
}

namespace {

std::string input;

// Only what a signal handler may call.
void keep(int signal) {
  const int file = ::creat("replayed.bin", 0644);
  if (file >= 0 && ::write(file, input.data(), input.size()) < 0) ::_exit(3);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}
  std::string of(const std::vector<std::string>& files) {
    std::string bytes = pick(files);
    if (LLVMFuzzerCustomMutator && below(2)) {
      const std::size_t size = bytes.size();
      bytes.resize(1 << 20);
      bytes.resize(LLVMFuzzerCustomMutator(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size(),
                                           random_()));
      return bytes;
    }
    for (int times = 1 + below(4); times > 0 && !bytes.empty(); --times) {
      const std::size_t at = below(bytes.size());
      const std::size_t length = 1 + below(std::min<std::size_t>(bytes.size() - at, 1u << below(10)));
      switch (below(8)) {
        case 0:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
          break;
        case 1:
          bytes[at] = static_cast<char>(below(256));
          break;
        case 2:
          bytes.erase(at, length);
          break;
        case 3:
          bytes.insert(at, bytes.substr(below(bytes.size()), length));
          break;
        case 4:
          bytes.resize(at);
          break;
        case 5:
          std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, below(2) ? '\xff' : '\0');
          break;
        case 6: {
          const std::string& other = pick(files);
          if (!other.empty()) bytes = bytes.substr(0, at) + other.substr(below(other.size()));
          break;
        }
        default: {
          static const char* const words[] = {
              "-",  "1e308",   "nan",  "inf", "\"", "[[",   "]", "{", "=", "99999999999999999999",
              "\n", "like = ", "\xc3", "'''", "0x", "true", "#", ".", "e", "gear"};
          bytes.insert(at, words[below(std::size(words))]);
        }
      }
    }
    return bytes;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  const std::string& pick(const std::vector<std::string>& files) { return files[below(files.size())]; }
  std::mt19937 random_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: COUNT SEED FOLDER\n", stderr), 2;
  const rlimit room{2ul << 30, 2ul << 30};  // the program itself, and 1 GiB
  ::setrlimit(RLIMIT_AS, &room);
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) std::signal(signal, keep);
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(argv[3])) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  if (files.empty()) return std::fputs("no files\n", stderr), 2;
  Damage damage(static_cast<unsigned>(std::atol(argv[2])));
  const long count = std::atol(argv[1]);
  for (long i = 0; i < count + static_cast<long>(files.size()); ++i) {
    input = i < static_cast<long>(files.size()) ? files[static_cast<std::size_t>(i)] : damage.of(files);
    ::alarm(10);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  }
  ::alarm(0);
  std::printf("%ld inputs from %zu files\n", count + static_cast<long>(files.size()), files.size());
  return 0;
}
