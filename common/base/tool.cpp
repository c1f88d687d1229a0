#include "base/tool.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>

#include "base/error.h"
#include "base/visible.h"

namespace whine {
namespace {

// The last place up to `i` at which a character of UTF-8 begins.
size_t character_begin(const std::string& text, size_t i) {
  while (i > 0 && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80) --i;
  return i;
}

std::string without_end(std::string message) {
  while (!message.empty() && (message.back() == ' ' || message.back() == '\n' || message.back() == '\r'))
    message.pop_back();
  return message;
}

std::string shell_quoted(const std::string& word) {
  static const std::string plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=/.,:@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string out = "'";
  for (char c : word) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

// OpenBLAS reads its environment when it is loaded, before main, so it must be told by a call; it is looked
// up by name because most programs do not link a BLAS at all.
void one_blas_thread() {
  setenv("OPENBLAS_NUM_THREADS", "1", 1);  // for programs started by this one
  setenv("OMP_NUM_THREADS", "1", 1);
  if (void* found = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
    reinterpret_cast<void (*)(int)>(found)(1);
}

// OpenBLAS asks for its buffers, 32 MB to 128 MB each by processor, when they are first needed, and where the system refuses
// one it asks for ever. They are taken at the start, after as much memory has been got in another way; it keeps them.
void reserve_blas_memory() {
  rlimit limit{};
  if (!dlsym(RTLD_DEFAULT, "openblas_get_config") || ::getrlimit(RLIMIT_AS, &limit) != 0 ||
      limit.rlim_cur == RLIM_INFINITY)
    return;
  constexpr size_t kBuffers = 2, kMegabyte = 1 << 20, kNeeded = (kBuffers + 1) * 128 * kMegabyte;
  void* const room = ::mmap(nullptr, kNeeded, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED)
    fail(Failure::numerical, "the address space is limited to ", limit.rlim_cur / kMegabyte,
         " MB, which leaves linear algebra less than the ", kNeeded / kMegabyte,
         " MB that it needs; raise the limit (ulimit -v unlimited)");
  ::munmap(room, kNeeded);
  using Allocate = void* (*)(int);
  using Free = void (*)(void*);
  const auto allocate = reinterpret_cast<Allocate>(dlsym(RTLD_DEFAULT, "blas_memory_alloc"));
  const auto release = reinterpret_cast<Free>(dlsym(RTLD_DEFAULT, "blas_memory_free"));
  if (!allocate || !release) return;
  void* buffers[kBuffers];
  for (void*& buffer : buffers) buffer = allocate(0);
  for (void* buffer : buffers) release(buffer);
}

}  // namespace

double number_option(const std::string& name, const std::string& word) {
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [rest, code] = std::from_chars(word.data(), end, value);
  if (code != std::errc() || rest != end || !std::isfinite(value)) {
    fail(Failure::usage, name, " = '", word, "': must be a finite decimal number, such as 150 or 62.5");
  }
  return value;
}

std::string program_name(const char* argv0) {
  return argv0 ? std::filesystem::path(argv0).filename().string() : "whine";
}

std::string recorded_path(const std::string& path) {
  const std::filesystem::path given(path);
  if (!given.is_absolute()) return path;
  std::error_code ignored;
  const auto here = std::filesystem::current_path(ignored);
  std::string below = given.lexically_normal().lexically_relative(here).generic_string();
  if (!below.empty() && below != ".." && below.rfind("../", 0) != 0) return below;
  return ".../" + given.filename().string();
}

std::string command_line(int argc, char** argv) {
  std::string out = program_name(argc > 0 ? argv[0] : nullptr);
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    const auto equals = word.find('=');
    // --output=/home/x, and pinion=/home/x of --body.
    const bool is_path = equals != std::string::npos && word[0] != '/' && word[equals + 1] == '/';
    if ((word.rfind("--", 0) == 0 && equals != std::string::npos) || is_path) {
      word = word.substr(0, equals + 1) + recorded_path(word.substr(equals + 1));
    } else {
      word = recorded_path(word);
    }
    out += ' ' + shell_quoted(word);
  }
  return out;
}

std::string blas_name() {
  void* found = dlsym(RTLD_DEFAULT, "openblas_get_config");
  if (!found) return "none or not OpenBLAS";
  std::string name = reinterpret_cast<char* (*)()>(found)();
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return name + ", 1 thread";
}

std::string printable(const std::string& text, size_t most) {
  std::string out = visible(text);
  for (char& c : out)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  if (out.size() <= most) return out;
  // Between characters: half of one would be no UTF-8.
  const size_t end = most / 2;
  return out.substr(0, character_begin(out, most - end)) + " ... " +
         out.substr(character_begin(out, out.size() - end));
}

void write_log(const std::string& line) {
  std::fputs((printable(without_end(line)) + "\n").c_str(), stderr);
  std::fflush(stderr);
}

namespace {

// Fields of elements and strips are of programs that read stage parameters; others hold no more than their files.
std::string memory_words(int argc, char** argv) {
  const bool discretised = std::any_of(argv + std::min(argc, 1), argv + argc, [](const char* word) {
    return std::string(word).starts_with("--params") || std::string(word).starts_with("--static-params");
  });
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  rlimit limit{};
  const bool limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return text(
      "out of memory: the system gives no more than the ", used.ru_maxrss / 1024, " MB that are taken",
      limited ? text(" (address space is limited to ", limit.rlim_cur >> 20, " MB by ulimit -v)") : "",
      discretised ? "; a coarser [discretisation] of the scene needs less" : "; give it more memory");
}

// What body returns, or what its error says.
int run_body(const std::function<void(const std::string&)>& say, int argc, char** argv,
             const std::function<int(int, char**)>& body) {
  try {
    reserve_blas_memory();
    return body(argc, argv);
  } catch (const Answered&) {
    return 0;
  } catch (const Error& error) {
    say(error.what());
    return static_cast<int>(error.kind());
  } catch (const std::bad_alloc&) {
    say(memory_words(argc, argv));
  } catch (const std::exception& error) {
    say(error.what());
  } catch (...) {
    say("unknown exception");
  }
  return 1;
}

}  // namespace

int run_tool_status(int argc, char** argv, const std::function<int(int, char**)>& body) {
  const std::string program = program_name(argc > 0 ? argv[0] : nullptr);
  const auto say = [&](const std::string& message) { write_log(program + ": error: " + message); };
  // A file-size limit must come back from write() as an error, not end the program without a word.
  std::signal(SIGXFSZ, SIG_IGN);
  one_blas_thread();
  const int status = run_body(say, argc, argv, body);
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::cout && !std::ferror(stdout)) return status;
  say(std::string("standard output cannot be written") +
      (errno ? std::string(": ") + std::strerror(errno) : "") + "; what was printed is not whole");
  return status != 0 ? status : static_cast<int>(Failure::io);
}

}  // namespace whine
