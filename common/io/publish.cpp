#include "io/publish.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <filesystem>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"

namespace whine {
namespace {

namespace fs = std::filesystem;

std::string system_says(int code) {
  return std::strerror(code);
}

fs::path folder_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

void make_folder_of(const std::string& path) {
  std::error_code code;
  fs::create_directories(folder_of(path), code);
  if (code) {
    fail(Failure::io, path, ": cannot make the folder '", folder_of(path).string(), "': ", code.message(),
         "; check the path and its permissions");
  }
}

// A process has its number on one machine only, and a file system may be many machines': a temporary file is named
// <path>.tmp.<host>.<process>.
std::string own_suffix() {
  char host[256] = {};
  if (::gethostname(host, sizeof host - 1) != 0 || !*host) return ".tmp.unnamed.";
  std::replace(std::begin(host), std::end(host), '/', '_');
  return text(".tmp.", host, ".");
}

std::string temporary_name(const std::string& path) {
  return text(path, own_suffix(), ::getpid());
}

// Temporary files that killed runs have left for this very path: of this host, their process is gone. One whose process
// lives, or whose number now belongs to another user, stays, and so does another host's, whose processes cannot be seen.
void remove_stale_temporaries(const std::string& path) {
  const std::string stem = fs::path(path).filename().string() + own_suffix();
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder_of(path), code)) {
    const std::string name = entry.path().filename().string();
    if (name.compare(0, stem.size(), stem) != 0) continue;
    pid_t process = 0;
    const char* end = name.data() + name.size();
    const auto [rest, wrong] = std::from_chars(name.data() + stem.size(), end, process);
    if (wrong != std::errc() || rest != end || process <= 0) continue;
    if (::kill(process, 0) != 0 && errno == ESRCH) ::unlink(entry.path().c_str());
  }
}

// Removes the temporary file unless the rename has happened.
class Temporary {
 public:
  explicit Temporary(std::string path) : path_(std::move(path)) {}
  ~Temporary() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  void keep() { path_.clear(); }

 private:
  std::string path_;
};

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  int close() {
    const int status = number_ >= 0 ? ::close(number_) : 0;
    number_ = -1;
    return status;
  }

 private:
  int number_;
};

// A folder that cannot be opened or synced (some network file systems) does not undo the rename: what is lost
// is durability over a power failure only.
void sync_folder(const std::string& path) {
  const Descriptor folder(::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.number() >= 0) ::fsync(folder.number());
}

std::string hexadecimal(const unsigned char* digest, unsigned int length) {
  static const char* hex = "0123456789abcdef";
  std::string out;
  for (unsigned int i = 0; i < length; ++i) {
    out += hex[digest[i] >> 4];
    out += hex[digest[i] & 15];
  }
  return out;
}

}  // namespace

StagedFile::StagedFile(std::string path) : path_(std::move(path)) {
  make_folder_of(path_);
  std::error_code code;
  const auto kind = fs::status(path_, code);
  if (fs::exists(kind) && !fs::is_regular_file(kind))
    fail(Failure::io, path_, ": is no regular file and is not replaced; give the name of a file");
  remove_stale_temporaries(path_);
  temporary_ = temporary_name(path_);
  // One that an earlier process of this number has left, or a link that somebody has put there, which is not followed.
  ::unlink(temporary_.c_str());
  Descriptor file(::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (file.number() < 0) reject("create a file beside it", errno);
}

StagedFile::~StagedFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void StagedFile::reject(const char* deed, int code) const {
  std::error_code none;
  const auto bytes = temporary_.empty() ? 0 : fs::file_size(temporary_, none);
  fail(Failure::io, path_, ": cannot ", deed, " (", none ? 0 : bytes, " bytes): ", system_says(code),
       "; nothing was changed, an earlier file is whole");
}

void StagedFile::write(const std::string& bytes) {
  Descriptor file(::open(temporary_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
  if (file.number() < 0) reject("open", errno);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(file.number(), bytes.data() + done, bytes.size() - done);
    if (count < 0) {
      if (errno == EINTR) continue;
      reject("write", errno);
    }
    done += static_cast<std::size_t>(count);
  }
}

void StagedFile::seal(const std::string& mark) {
  const std::string zeros(64, '0');
  Descriptor file(::open(temporary_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC));
  if (file.number() < 0) reject("open", errno);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> hash(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  if (!hash || EVP_DigestInit_ex(hash.get(), EVP_sha256(), nullptr) != 1)
    fail(Failure::numerical, "SHA-256 is not available in this OpenSSL");
  constexpr std::size_t kBlock = 1 << 20;
  std::string block(kBlock, '\0'), tail;  // tail: end of the blocks before, in which the mark may begin
  off_t place = -1, seen = 0;
  for (;;) {
    const ssize_t count = ::read(file.number(), block.data(), kBlock);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) reject("read", errno);
    if (count == 0) break;
    const auto length = static_cast<std::size_t>(count);
    EVP_DigestUpdate(hash.get(), block.data(), length);
    if (place < 0) {
      const std::string text = tail + block.substr(0, length);
      const auto at = text.find(mark + zeros);
      if (at != std::string::npos)
        place = seen - static_cast<off_t>(tail.size()) + static_cast<off_t>(at + mark.size());
      tail = text.substr(text.size() - std::min(text.size(), mark.size() + zeros.size()));
    }
    seen += count;
  }
  if (place < 0) fail(Failure::numerical, "the file has no place for its content hash");
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  EVP_DigestFinal_ex(hash.get(), digest, &size);
  const std::string digits = hexadecimal(digest, size);
  if (::pwrite(file.number(), digits.data(), digits.size(), place) != static_cast<ssize_t>(digits.size()))
    reject("write its content hash", errno);
}

void StagedFile::sync() const {
  Descriptor file(::open(temporary_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
  if (file.number() < 0) reject("open", errno);
  if (::fsync(file.number()) != 0) reject("sync", errno);
  if (file.close() != 0) reject("close", errno);
}

void StagedFile::publish() {
  sync();
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) reject("put the new file in place", errno);
  temporary_.clear();
  sync_folder(path_);
}

void publish(const std::string& path, const std::string& bytes) {
  StagedFile file(path);
  file.write(bytes);
  file.publish();
}

void publish_all(const std::vector<FileBytes>& files) {
  std::deque<StagedFile> staged;
  for (const FileBytes& file : files) {
    staged.emplace_back(file.path).write(file.bytes);
    staged.back().sync();
  }
  for (StagedFile& file : staged) file.publish();
}

bool publish_if_changed(const std::string& path, const std::string& bytes) {
  std::error_code code;
  if (fs::is_regular_file(path, code) && read_bytes(path) == bytes) return false;
  publish(path, bytes);
  return true;
}

bool publish_link(const std::string& link, const std::string& target) {
  make_folder_of(link);
  std::error_code code;
  const auto status = fs::symlink_status(link, code);
  if (fs::is_symlink(status)) {
    if (fs::read_symlink(link, code) == fs::path(target) && !code) return false;
  } else if (fs::exists(status)) {
    fail(Failure::io, link, ": a file or folder stands where a link to '", target,
         "' belongs; move it away and run again");
  }
  const std::string temporary = temporary_name(link);
  ::unlink(temporary.c_str());
  if (::symlink(target.c_str(), temporary.c_str()) != 0) {
    fail(Failure::io, link, ": cannot make the link to '", target, "': ", system_says(errno));
  }
  Temporary guard(temporary);
  if (::rename(temporary.c_str(), link.c_str()) != 0) {
    fail(Failure::io, link, ": cannot put the link in place: ", system_says(errno));
  }
  guard.keep();
  return true;
}

int bring_to_present(const std::vector<std::string>& folders) {
  const auto now = fs::file_time_type::clock::now();
  std::vector<std::pair<fs::file_time_type, fs::path>> ahead;
  std::error_code code;
  for (const std::string& folder : folders) {
    if (folder.empty()) continue;
    for (fs::recursive_directory_iterator entry(folder, code), end; !code && entry != end;
         entry.increment(code)) {
      std::error_code gone;  // by another make
      if (entry->is_symlink(gone) || !entry->is_regular_file(gone)) continue;
      const auto time = entry->last_write_time(gone);
      if (!gone && time > now) ahead.emplace_back(time, entry->path());
    }
  }
  std::sort(ahead.begin(), ahead.end());
  auto time = now - std::chrono::milliseconds(ahead.size());
  for (const auto& [was, path] : ahead) fs::last_write_time(path, time += std::chrono::milliseconds(1), code);
  return static_cast<int>(ahead.size());
}

std::string read_bytes(const std::string& path, const std::string& hint) {
  const auto reject = [&](const std::string& reason) {
    fail(Failure::io, path, ": cannot be read: ", reason, hint.empty() ? "" : "; ", hint);
  };
  // A pipe without a writer would hold up the opening itself.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) reject(system_says(errno));
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) reject(system_says(errno));
  if (S_ISDIR(status.st_mode)) reject("it is a folder");
  // Others, such as a pipe or /dev/zero, need not end.
  if (!S_ISREG(status.st_mode)) reject("it is no regular file");
  std::string bytes;
  if (status.st_size > 0) bytes.reserve(static_cast<std::size_t>(status.st_size));
  std::string block(1 << 16, '\0');
  for (;;) {
    const ssize_t count = ::read(file.number(), block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) reject(system_says(errno));
    if (count == 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
}

std::string in_comment(const std::string& path) {
  std::string out = path;
  for (char& c : out)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f || c == '\\' || c == '$') c = '?';
  return out;
}

std::string sha256(const std::string& bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest, &length, EVP_sha256(), nullptr) != 1) {
    fail(Failure::numerical, "SHA-256 is not available from the OpenSSL library of this machine");
  }
  return hexadecimal(digest, length);
}

std::string sha256_of_file(const std::string& path) {
  return sha256(read_bytes(path));
}

std::string base64(const std::string& bytes) {
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // EVP ends it with a zero
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  out.resize(static_cast<std::size_t>(length));
  return out;
}

}  // namespace whine
