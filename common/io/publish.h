// Files that are either the old one or the whole new one, never a part: temporary name
// `<path>.tmp.<host>.<pid>` in the same folder, every write checked, fsync, rename, fsync of the folder. On any failure
// the temporary file is removed, the earlier file stays, and Error(io) says what the system said. What a killed process
// has left beside the file is removed by the next write of it on the same host.
#pragma once
#include <string>
#include <vector>

namespace whine {

// Writes bytes to path; makes the parent folders.
void publish(const std::string& path, const std::string& bytes);

struct FileBytes {
  std::string path, bytes;
};
// Files that belong together, such as a page and its table: all are written and synced beside their places before the first of
// them replaces an earlier one, so that a full disk or a wrong path leaves all as they were.
void publish_all(const std::vector<FileBytes>& files);

// A file that grows beside its place before it is published; removed if it is not.
class StagedFile {
 public:
  // Makes an empty file beside `path`, and the parent folders.
  explicit StagedFile(std::string path);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  const std::string& temporary() const { return temporary_; }
  void write(const std::string& bytes);
  // Puts the 64 digits of the SHA-256 of the file in the place of the 64 zeros behind `mark`. Error(numerical) if they are
  // not there.
  void seal(const std::string& mark);
  void sync() const;
  void publish();  // syncs as well

 private:
  [[noreturn]] void reject(const char* deed, int code) const;

  std::string path_, temporary_;
};

// As publish, but leaves a file with the same content alone (make then sees no change). True if it was
// replaced.
bool publish_if_changed(const std::string& path, const std::string& bytes);

// Makes `link` a symbolic link to `target` (relative to the link's folder), atomically; leaves a right one
// alone. True if it was made or replaced. Error(io) if a file or folder that is no link stands there.
bool publish_link(const std::string& link, const std::string& target);

// Files below `folders` whose times lie in the future, because the clock was set back, get times just before now, in
// the same order: make would take them for newer than what changes from now on. The number of them.
int bring_to_present(const std::vector<std::string>& folders);

// The whole content of a regular file. Error(io) if it cannot be read; `hint` is appended to the message.
std::string read_bytes(const std::string& path, const std::string& hint = "");

// A path for a comment of a make fragment: what could end the comment or be expanded in it becomes '?'.
std::string in_comment(const std::string& path);

// SHA-256 in lower-case hexadecimal: of bytes, of a file's content.
std::string sha256(const std::string& bytes);
std::string sha256_of_file(const std::string& path);

// Bytes as text, in one line.
std::string base64(const std::string& bytes);

}  // namespace whine
