#include "io/rexs/archive.h"

#include <zip.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/tool.h"

namespace whine {
namespace {

using Archive = std::unique_ptr<zip_t, void (*)(zip_t*)>;

// Every entry has a header of its own in the central directory; libzip reads all of them when it opens an archive.
void require_few_entries(const std::string& path, const std::string& bytes) {
  size_t entries = 0;
  for (size_t at = bytes.find("PK\x01\x02"); at != std::string::npos; at = bytes.find("PK\x01\x02", at + 4))
    ++entries;
  if (entries > kMostRexsEntries)
    reject_rexs(path, text("its zip archive has ", entries, " entries, more than ", kMostRexsEntries));
}

// Not more nodes than this come out of a text: elements and attributes of XML, values of JSON.
size_t most_nodes(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  const bool xml = first != std::string::npos && text[first] == '<';
  size_t nodes = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool end_tag = i + 1 < text.size() && text[i + 1] == '/';
    nodes += xml ? (c == '<' && !end_tag) || c == '=' : c == ',' || c == '[' || c == '{';
  }
  return nodes;
}

// The source keeps what is written to it as long as it is held by the caller.
Archive opened(const std::string& path, zip_source_t* source, int flags) {
  zip_error_t error;
  zip_error_init(&error);
  zip_t* archive = source ? zip_open_from_source(source, flags, &error) : nullptr;
  const std::string why = archive ? "" : zip_error_strerror(&error);
  zip_error_fini(&error);
  if (!archive) {
    if (source) zip_source_free(source);
    reject_rexs(path, "its zip archive cannot be opened: " + why);
  }
  return {archive, zip_discard};
}

zip_source_t* source_of(const std::string& bytes) {
  return zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr);
}

// Of the archive the only entry that may be a model: gearbox models come with pictures and meshes beside them.
zip_uint64_t model_entry(const std::string& path, zip_t* archive) {
  std::vector<zip_uint64_t> models;
  const zip_int64_t entries = zip_get_num_entries(archive, 0);
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(std::max<zip_int64_t>(entries, 0)); ++i) {
    const char* given = zip_get_name(archive, i, 0);
    const std::string name = given ? given : "";
    for (const char* end : {".rexs", ".rexsj", ".xml", ".json"})
      if (name.ends_with(end)) models.push_back(i);
  }
  if (models.size() != 1)
    reject_rexs(path, text("its zip archive holds ", models.size(), " models instead of one"));
  return models[0];
}

std::string bytes_of(zip_source_t* source) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_stat(source, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) || zip_source_open(source) != 0)
    return "";
  std::string bytes(stat.size, '\0');
  const bool whole =
      zip_source_read(source, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size());
  zip_source_close(source);
  return whole ? bytes : "";
}

}  // namespace

void reject_rexs(const std::string& path, const std::string& why) {
  fail(Failure::input, path, ": ", printable(why, 800),
       "; a REXS model of version 1.0 to 2.0 is wanted (.rexs, .rexsj or .rexsz)");
}

bool is_rexs_archive(const std::string& bytes) {
  return bytes.starts_with("PK");
}

std::string model_in_archive(const std::string& path, const std::string& bytes) {
  require_few_entries(path, bytes);
  const Archive archive = opened(path, source_of(bytes), ZIP_RDONLY);
  const zip_uint64_t index = model_entry(path, archive.get());
  zip_stat_t entry;
  zip_stat_init(&entry);
  if (zip_stat_index(archive.get(), index, 0, &entry) != 0 || !(entry.valid & ZIP_STAT_SIZE))
    reject_rexs(path, "its zip archive does not say how long the model is");
  if (entry.size > kMostRexsBytes)
    reject_rexs(path, text("the model in it has ", entry.size, " bytes, more than 64 MB"));
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive.get(), index, 0),
                                                               zip_fclose);
  std::string model(entry.size, '\0');
  char beyond = 0;
  // libzip compares checksum and length where the data end: in the read that returns 0.
  if (!file || zip_fread(file.get(), model.data(), entry.size) != static_cast<zip_int64_t>(entry.size) ||
      zip_fread(file.get(), &beyond, 1) != 0)
    reject_rexs(path, "the model in its zip archive is damaged or encrypted");
  return model;
}

std::string rexs_text(const std::string& path, std::string bytes) {
  if (bytes.size() > kMostRexsBytes)
    reject_rexs(path, text("it has ", bytes.size(), " bytes, more than 64 MB"));
  if (is_rexs_archive(bytes)) bytes = model_in_archive(path, bytes);
  if (bytes.starts_with(kByteOrderMark)) bytes.erase(0, 3);
  if (const size_t nodes = most_nodes(bytes); nodes > kMostRexsNodes)
    reject_rexs(path,
                text("it has up to ", nodes, " elements, attributes and values, more than ", kMostRexsNodes));
  return bytes;
}

std::string archive_with_model(const std::string& path, const std::string& bytes, const std::string& model) {
  zip_source_t* whole = source_of(bytes);
  Archive archive = opened(path, whole, 0);
  const zip_uint64_t index = model_entry(path, archive.get());
  zip_stat_t entry;
  zip_stat_init(&entry);
  zip_source_t* replacement = zip_source_buffer(archive.get(), model.data(), model.size(), 0);
  // Without the time of the entry before it the archive would hold the time of this run.
  const bool known =
      zip_stat_index(archive.get(), index, 0, &entry) == 0 && (entry.valid & ZIP_STAT_MTIME) && replacement;
  if (!known || zip_file_replace(archive.get(), index, replacement, 0) != 0 ||
      zip_file_set_mtime(archive.get(), index, entry.mtime, 0) != 0)
    reject_rexs(path, "the model in its zip archive cannot be replaced");
  zip_source_keep(whole);
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(whole, zip_source_free);
  if (zip_close(archive.get()) != 0) reject_rexs(path, "its zip archive cannot be written anew");
  static_cast<void>(archive.release());
  const std::string out = bytes_of(whole);
  if (out.empty()) reject_rexs(path, "its zip archive cannot be written anew");
  return out;
}

}  // namespace whine
