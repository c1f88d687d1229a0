/* Loaded before the C library: the system call named by FAULT ends as it does on bad days, for files whose name holds
   ".h5". rename-kill: the process is killed before the rename; rename-io, fsync-io: EIO; write-full: no room for the
   second half; write-short: a byte at a time and interrupted, which is no failure. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int wanted(const char* fault) {
  const char* asked = getenv("FAULT");
  return asked && strcmp(asked, fault) == 0;
}

static int is_artifact(int number) {
  char link[64], name[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", number);
  const ssize_t size = readlink(link, name, sizeof name - 1);
  if (size < 0) return 0;
  name[size] = 0;
  return strstr(name, ".h5") != 0;
}

int rename(const char* from, const char* to) {
  if (strstr(to, ".h5")) {
    if (wanted("rename-kill")) kill(getpid(), SIGKILL);
    if (wanted("rename-io")) return errno = EIO, -1;
  }
  return ((int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename"))(from, to);
}

int fsync(int number) {
  if (wanted("fsync-io") && is_artifact(number)) return errno = EIO, -1;
  return ((int (*)(int))dlsym(RTLD_NEXT, "fsync"))(number);
}

ssize_t write(int number, const void* data, size_t size) {
  static ssize_t (*real)(int, const void*, size_t);
  if (!real) real = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  if (size > 1 && is_artifact(number)) {
    static int calls;
    ++calls;
    if (wanted("write-full")) {
      if (calls > 1) return errno = ENOSPC, -1;
      return real(number, data, size / 2);
    }
    if (wanted("write-short")) {
      if (calls % 2) return errno = EINTR, -1;
      return real(number, data, size > 4096 ? 4095 : 1);
    }
  }
  return real(number, data, size);
}
