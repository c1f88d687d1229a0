// Runs of CalculiX: a folder for the files of one, ccx in it on one thread, and what it took.
#pragma once
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "base/error.h"

namespace whine {

// What a child process took.
struct Usage {
  double seconds = 0;    // CPU, user and system
  double megabytes = 0;  // largest resident set
};

// Waits for a child; throws Error(numerical) with `what` if it did not end with status 0.
inline Usage wait_for(pid_t child, const std::string& what) {
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail(Failure::numerical, what, " ended with status ", WIFEXITED(status) ? WEXITSTATUS(status) : -1);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), double(usage.ru_maxrss) / 1024};
}

inline bool calculix_installed() {
  return std::system("command -v ccx > /dev/null 2>&1") == 0;
}

// Removed with its files, unless an error is on its way: its message names the folder.
class CalculixFolder {
 public:
  CalculixFolder() : path_((std::filesystem::temp_directory_path() / "whine-bench-XXXXXX").string()) {
    if (!mkdtemp(path_.data())) fail(Failure::io, "no folder ", path_, " for the deck of CalculiX");
  }
  ~CalculixFolder() {
    if (std::uncaught_exceptions() == errors_) std::filesystem::remove_all(path_);
  }
  CalculixFolder(const CalculixFolder&) = delete;
  CalculixFolder& operator=(const CalculixFolder&) = delete;

  std::string file(const std::string& name) const { return path_ + "/" + name; }

  // ccx with the deck <job>.inp of the folder. Throws Error(numerical) if it does not end with status 0.
  Usage run(const char* job) const {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      setenv("OMP_NUM_THREADS", "1", 1);
      setenv("CCX_NPROC_EQUATION_SOLVER", "1", 1);
      if (chdir(path_.c_str()) == 0 && std::freopen("ccx.log", "w", stdout) &&
          std::freopen("ccx.err", "w", stderr))
        execlp("ccx", "ccx", "-i", job, static_cast<char*>(nullptr));
      _exit(127);
    }
    return wait_for(child, "ccx in " + path_);
  }

 private:
  std::string path_;
  int errors_ = std::uncaught_exceptions();
};

}  // namespace whine
